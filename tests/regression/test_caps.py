#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""The tools of the drops on walls: exact caps and Young-Laplace drops against the stored tables, and
the fit of spheres on points and dumps whose shape is known.
"""

import argparse
import math
import re
import unittest
from pathlib import Path

import caps
import pendant
from example import TOP
from series import read_table

REFERENCE = TOP / "tests" / "reference"


def numbers(name):
    return [{k: float(v) for k, v in row.items()} for row in read_table(REFERENCE / name)]


class ExactCaps(unittest.TestCase):
    def test_table(self):
        """Six decimals are stored."""
        rows = numbers("sessile_cap_no_gravity.csv")
        self.assertGreater(len(rows), 5)
        for row in rows:
            angle = math.radians(row["theta_deg"])
            for dim in (2, 3):
                volume = caps.cap_volume(row[f"R_{dim}D"], angle, dim)
                self.assertAlmostEqual(volume, 1.0, delta=6e-6)

    def test_half_cells_belong_to_the_volume(self):
        """90 deg in 2d: pi/2 R^2 = N d^2 + 2 R d/2."""
        radius = caps.exact_cap(300, 0.1, math.pi / 2, 2)
        self.assertAlmostEqual(math.pi / 2 * radius**2, 3.0 + 0.1 * radius, places=10)


class YoungLaplace(unittest.TestCase):
    LENGTH = math.sqrt(0.07 / 5000.0)

    def test_paper_case(self):
        """Four decimals in mm, of an integration with unknown steps: 1e-4 of the height taken."""
        drop = pendant.equilibrium(256e-9 / self.LENGTH**3, 60.0)
        for value, stored in ((drop.height, 4.8642), (drop.contact_radius, 5.6257),
                              (drop.apex_radius, 4.2426)):
            self.assertAlmostEqual(value * self.LENGTH * 1e3, stored, delta=5e-4)
        pressure = drop.ceiling_pressure() * 0.07 / self.LENGTH
        self.assertAlmostEqual(pressure, 8.678, delta=5e-3)

    def test_profile_of_the_paper_case(self):
        points = pendant.equilibrium(256e-9 / self.LENGTH**3, 60.0).points
        for row in numbers("pendant_drop_paper_case_theta60.csv"):
            there = (row["r_mm"] * 1e-3 / self.LENGTH, row["z_mm"] * 1e-3 / self.LENGTH)
            nearest = min(math.dist(there, point) for point in points)
            self.assertLess(nearest, pendant.STEP)    # points are one step apart

    def test_largest_volumes(self):
        """Near a maximum, steps of 1 % in the apex radius cost 1e-3 of the volume or less; the
        stored values are samples, too (their table says 5 % at 120 deg)."""
        for row in numbers("pendant_drop_limits.csv"):
            if row["theta_deg"] in (60.0, 75.0, 90.0):
                drop = pendant.largest(row["theta_deg"])
                self.assertAlmostEqual(drop.volume / row["Vmax_over_l3"], 1.0, delta=2e-3)

    def test_which_hang(self):
        volume = 256e-9 / self.LENGTH**3
        self.assertEqual([pendant.equilibrium(volume, angle) is not None
                          for angle in (60, 75, 90, 120)], [True, True, False, False])

    def test_small_drops_are_caps(self):
        """Weight changes a drop of 0.1 l by (0.1)^2."""
        drop = pendant.equilibrium(1e-3, 90.0)
        radius = (1e-3 / caps.cap_volume(1.0, math.pi / 2, 3))**(1 / 3)
        self.assertAlmostEqual(drop.height / radius, 1.0, delta=0.01)


def cap_points(radius, degrees, dim, shift=0.0):
    """Points of a cap over the wall, evenly by angle."""
    angle = math.radians(degrees)
    low = -radius * math.cos(angle)
    points = []
    for k in range(-60, 61):
        t = angle * k / 60.0
        x, up = radius * math.sin(t), low + radius * math.cos(t)
        if dim == 2:
            points.append([shift + x, up])
        else:
            points += [[shift + x * math.cos(0.3 * j), x * math.sin(0.3 * j), up]
                       for j in range(10)]
    return [p for p in points if p[-1] > 1e-12]


class Fit(unittest.TestCase):
    def test_exact_points(self):
        for dim in (2, 3):
            for degrees in (30, 90, 150):
                with self.subTest(dim=dim, angle=degrees):
                    centre, radius = caps.fit_sphere(cap_points(2.0, degrees, dim, 7.0))
                    self.assertAlmostEqual(radius, 2.0, places=9)
                    self.assertAlmostEqual(centre[0], 7.0, places=9)
                    self.assertAlmostEqual(centre[-1], -2.0 * math.cos(math.radians(degrees)),
                                           places=9)

    def test_strays_are_left_out_and_counted(self):
        points = cap_points(2.0, 120, 2) + [[0.0, 2.0], [0.3, 1.5]]
        centre, radius, errors, strays = caps.fit_surface(points, 0.3)
        self.assertEqual(strays, 2)
        self.assertAlmostEqual(radius, 2.0, places=9)
        self.assertLess(max(map(abs, errors)), 1e-9)

    def test_parts_across_a_boundary_are_joined(self):
        rows = [{"x": x, "y": 0.0, "z": 0.0} for x in (0.5, 0.2, 9.9, 9.6)]
        xs = sorted(row["x"] for row in caps.joined(rows, [10.0, None, None]))
        self.assertAlmostEqual(xs[-1] - xs[0], 0.9)


def dump_text(rows):
    head = "ITEM: UNITS\nsi\nITEM: TIME\n0.5\nITEM: TIMESTEP\n7\nITEM: NUMBER OF ATOMS\n"
    head += f"{len(rows)}\nITEM: BOX BOUNDS pp ff pp\n-9 9\n-9 9\n-9 9\n"
    names = list(rows[0])
    lines = [" ".join(f"{row[name]:.9g}" for name in names) for row in rows]
    return head + "ITEM: ATOMS " + " ".join(names) + "\n" + "\n".join(lines) + "\n"


class Sessile(unittest.TestCase):
    def lattice(self, radius, degrees, d):
        """Particles of a cap; those on the surface lie exactly half a spacing inside it."""
        low = -radius * math.cos(math.radians(degrees))
        rows = []
        for i in range(-60, 61):
            for j in range(1, 80):
                x, y = i * d, j * d
                if math.dist((x, y), (0.0, low)) < radius - d:
                    rows.append({"x": x, "y": y, "surface": 0.0})
        for x, y in cap_points(radius - 0.5 * d, 180, 2):
            y += low - (radius - 0.5 * d)
            if y > 0.5 * d:
                rows.append({"x": x, "y": y, "surface": 1.0})
        return [{"id": k, "type": 1, "z": 0.0, "d_aleisph_p": 5.0, **row}
                for k, row in enumerate(rows)]

    def test_angle_of_a_cap(self):
        for degrees in (60, 120):
            rows = self.lattice(1.0, degrees, 0.05)
            Path("cap.dump").write_text(dump_text(rows), encoding="ascii")
            time, lengths, read = caps.last_frame("cap.dump")
            self.assertEqual((time, lengths[1]), (0.5, None))
            options = argparse.Namespace(dim=2, d=0.05, angle=degrees, sigma=1.0, above=1.5)
            lines, outline = caps.sessile(caps.joined(read, lengths), time, options)
            angle = next(line for line in lines if "quantity=angle" in line)
            self.assertAlmostEqual(float(re.search("value=([0-9.]+)", angle)[1]), degrees, delta=1e-3)
            self.assertAlmostEqual(outline[0][1], 0.0, delta=1e-9)


class Hanging(unittest.TestCase):
    def options(self):
        return argparse.Namespace(d=2e-4, angle=60.0, sigma=0.07, rho=1000.0, g=5.0, copies=1)

    def rows(self, depth, speed):
        return [{"x": 0.0, "y": 0.0, "z": -depth, "vx": speed, "vy": 0.0, "vz": 0.0}
                for _ in range(32000)]

    def test_verdicts(self):
        length = math.sqrt(0.07 / 5000.0)
        for depth, speed, word in ((3e-3, 0.0, "hangs"), (3e-3, 0.1, "moves"), (9e-3, 0.0, "falls")):
            self.assertEqual(caps.verdict(self.rows(depth, speed), self.options(), length)[0],
                             word)

    def test_apex(self):
        """Exact on a paraboloid about another point; one of 25 particles 0.6 d out of place changes
        it by less than 0.1 d."""
        d, rows = 2e-4, [{"surface": 0, "x": 0.0, "y": 0.0, "z": 0.0} for _ in range(40)]
        for i in range(-4, 5):
            for j in range(-4, 5):
                x, y = i * d, j * d
                z = -4e-3 + 100.0 * ((x - 0.3 * d)**2 + y * y)
                rows.append({"surface": 1, "x": x, "y": y, "z": z + 0.5 * d})
        exact = 4e-3 - 100.0 * (0.3 * d)**2
        self.assertAlmostEqual(caps.apex_depth(rows, d, (0.0, 0.0)), exact, delta=1e-12)
        for row in rows:
            if row["surface"] and row["x"] == row["y"] == 0.0:
                row["z"] -= 0.6 * d
        self.assertAlmostEqual(caps.apex_depth(rows, d, (0.0, 0.0)), exact, delta=0.1 * d)

    def test_line_through_the_surface(self):
        """A cone of 60 deg at the ceiling."""
        d, rows = 2e-4, []
        normal = (math.sin(math.radians(60.0)), -math.cos(math.radians(60.0)))
        for k in range(40):
            for j in range(1, 5):
                depth, a = j * d, 0.1 * k
                r = 5e-3 - depth / math.tan(math.radians(60.0))
                r, z = r - 0.5 * d * normal[0], -depth - 0.5 * d * normal[1]
                rows.append({"surface": 1, "x": r * math.cos(a), "y": r * math.sin(a), "z": z,
                             "nx": normal[0] * math.cos(a), "ny": normal[0] * math.sin(a),
                             "nz": normal[1]})
        radius, angle = caps.ceiling_line(rows, d, (0.0, 0.0))
        self.assertAlmostEqual(radius, 5e-3, delta=1e-9)
        self.assertAlmostEqual(angle, 60.0, delta=1e-4)


if __name__ == "__main__":
    unittest.main(verbosity=2)
