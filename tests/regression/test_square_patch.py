#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""What the results of examples/square-patch are measured with: area, edge and distances on shapes
that are known exactly, and the reference pressure in the script against its table."""

import math
import re
import tempfile
import unittest
from pathlib import Path

import square_patch
from example import TOP
from series import read_table


def disc(radius, d):
    """Lattice points in a disc."""
    n = math.ceil(radius / d)
    points = [((a + 0.5) * d, (b + 0.5) * d) for a in range(-n, n) for b in range(-n, n)]
    return [p for p in points if math.hypot(*p) < radius]


def square(n, d):
    return [((a + 0.5) * d, (b + 0.5) * d) for a in range(n) for b in range(n)]


def measure(points, d):
    cells = square_patch.CELLS
    return square_patch.area_and_edge(square_patch.kernel_sum(points, d), d / cells)


class Shape(unittest.TestCase):
    def test_kernel_sum_inside_is_one(self):
        """At a particle of a lattice: 1/h^2 of 10/(7 pi) times the values of the spline at the
        20 + 1 particles within 2 h = 2.4 d, at distances 0, 1, sqrt 2, 2, sqrt 5 spacings."""
        def spline(q):
            return 1 - 1.5 * q**2 + 0.75 * q**3 if q < 1 else 0.25 * (2 - q)**3
        rings = ((1, 0), (4, 1), (4, 2), (4, 4), (8, 5))
        exact = sum(count * spline(math.sqrt(r2) / 1.2) for count, r2 in rings)
        exact *= 10 / (7 * math.pi) / 1.2**2
        self.assertAlmostEqual(exact, 1.0, delta=1e-3)    # the sum is an integral
        total = square_patch.kernel_sum(square(12, 0.1), 0.1)
        place = round(5.5 * square_patch.CELLS)
        self.assertAlmostEqual(total[place, place], exact, places=9)

    def test_square(self):
        """The line 1/2 lies on a straight edge, half a spacing outside the last row; what it cuts
        off at the four corners is of the order of a cell. The count of grid points is uncertain by
        half a grid cell along the edge, 4 n d g/2: 2.5 % of the area for n = 20."""
        n, d = 20, 0.05
        area, edge = measure(square(n, d), d)
        self.assertAlmostEqual(area, 1.0, delta=0.025)
        self.assertAlmostEqual(edge, 4.0, delta=4 * d)

    def test_disc(self):
        """Area V times the number of particles, within half a grid cell along the edge; the steps
        of the lattice at the edge make it longer than a circle by a few per cent."""
        d, radius = 0.05, 0.5
        points = disc(radius, d)
        area, edge = measure(points, d)
        self.assertAlmostEqual(area, len(points) * d * d, delta=math.pi * radius * d / 4)
        self.assertAlmostEqual(edge, 2 * math.pi * radius, delta=0.1 * math.pi)

    def test_pieces_add_up(self):
        d = 0.05
        one = measure(square(6, d), d)
        far = [(x + 100 * d, y + 40 * d) for x, y in square(6, d)]
        for both, single in zip(measure(square(6, d) + far, d), one):
            self.assertAlmostEqual(both, 2 * single, places=9)

    def test_distance_from_a_line(self):
        line = [0j, 1 + 0j, 1 + 1j]
        for z, exact in ((0.5 + 0.25j, 0.25), (-3 + 4j, 5.0), (1.5 + 0.5j, 0.5), (2 - 1j, 2**0.5)):
            self.assertAlmostEqual(square_patch.distance(z, line), exact, places=12)

    def test_outline_of_particles_on_it(self):
        """Surface particles half a spacing inside the outline, and then moved outwards by d."""
        d, time = 0.02, 1.0
        pieces = square_patch.exact_outline(time, 1.0)
        self.assertEqual(len(pieces), 4)
        for shift, exact in ((0.0, 0.0), (1.0, 1.0)):
            rows = []
            for piece in pieces:
                for a, b in zip(piece, piece[1:]):
                    normal = (b - a) / abs(b - a) * -1j
                    if (normal * (a + b).conjugate()).real < 0:
                        normal = -normal
                    z = 0.5 * (a + b) + (shift - 0.5) * d * normal
                    rows.append({"x": z.real, "y": z.imag, "nx": normal.real, "ny": normal.imag,
                                 "surface": 1.0})
            rms, largest = square_patch.outline_error(rows, pieces, d, 0.8)
            # moved by a whole spacing, the nearest point of a curved line is nearer or farther by
            # d^2/(2R); the line is straight but for its waist, R > 0.2
            self.assertAlmostEqual(rms, exact, delta=0.05)
            self.assertAlmostEqual(largest, exact, delta=0.05)
            # particles that are the surface: they are half a spacing inside of it, or outside
            for error in square_patch.outline_error(rows, pieces, d, 0.8, 0.0):
                self.assertAlmostEqual(error, 0.5, delta=0.05)

    def test_volume_of_the_particles(self):
        """A row more: the reference of the area is (n + 1)^2 d^2, and so is the area."""
        n, d = 20, 0.05
        with tempfile.TemporaryDirectory() as folder:
            dump = Path(folder) / "dump"
            atoms = [f"{x - 0.5 - d / 2} {y - 0.5 - d / 2} 0 0 0" for x, y in square(n + 1, d)]
            dump.write_text("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n"
                            f"{len(atoms)}\nITEM: BOX BOUNDS ss ss pp\n-1 1\n-1 1\n-1 1\n"
                            "ITEM: ATOMS x y nx ny surface\n" + "\n".join(atoms) + "\n")
            area = next(square_patch.result_lines(dump, 0.1, d, 1.0, 0.0))
        value, reference = (float(re.search(rf" {key}=(\S+)", area)[1].strip('"'))
                            for key in ("value", "reference"))
        self.assertAlmostEqual(reference, (1 + d)**2, places=5)
        self.assertAlmostEqual(value / reference, 1.0, delta=0.025)


class Reference(unittest.TestCase):
    def formula(self):
        """p_ref of the script as a Python function of omega t."""
        text = (TOP / "examples" / "square-patch" / "in.square-patch").read_text()
        text = text.replace("&\n", "")
        words = re.search(r"^variable +p_ref +equal +(.*)$", text, re.MULTILINE)[1]
        code = words.replace("v_s", "s").replace(" ", "")
        return lambda t: eval(code, {"s": t * t})    # a formula of numbers and s alone

    def test_formula_agrees_with_the_table(self):
        p_ref = self.formula()
        rows = read_table(TOP / "tests" / "reference" / "square_patch_centre_pressure.csv")
        self.assertGreater(len(rows), 80)
        for row in rows:
            self.assertAlmostEqual(p_ref(float(row["t"])), float(row["p0"]), delta=9e-6)


if __name__ == "__main__":
    unittest.main(verbosity=2)
