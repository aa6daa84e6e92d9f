#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Tools on scenes that have flown apart: every quantity gets its line, value=nan where there is no
value, and those that can be measured keep theirs. A Python error would lose all of them."""

import argparse
import contextlib
import io
import math
import random
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import caps
import cavity
import drops
import ellipse
import impact
import sloshing
import spheric02
import square_patch
import wave
from star import Star

COLUMNS = "id type x y z vx vy vz surface nx ny nz d_aleisph_p"


def snapshot(time, rows):
    lines = [" ".join(f"{value:.9g}" for value in row) for row in rows]
    return "\n".join(["ITEM: TIME", f"{time}", "ITEM: TIMESTEP", f"{round(10 * time)}",
                      "ITEM: NUMBER OF ATOMS", str(len(rows)), "ITEM: BOX BOUNDS ss ss ss",
                      "-9 9", "-9 9", "-9 9", f"ITEM: ATOMS {COLUMNS}", *lines, ""])


def disc():
    """A lattice of spacing 1 cut to a disc of radius 8, at rest."""
    rows = []
    for i in range(-8, 9):
        for j in range(-8, 9):
            r = math.hypot(i, j)
            if r < 8:
                on = r > 7
                rows.append([len(rows) + 1, 1, i, j, 0, 0, 0, 0, on, i / r if on else 0,
                             j / r if on else 0, 0, 0.125])
    return rows


def cloud(seed=1, surface=1, value=100.0):
    """The same particles anywhere, fast, in every direction."""
    source = random.Random(seed)
    rows = []
    for row in disc():
        x, y, vx, vy = (source.uniform(-value, value) for _ in range(4))
        a = source.uniform(0, 2 * math.pi)
        rows.append(row[:2] + [x, y, 0, vx, vy, 0, surface, math.cos(a), math.sin(a), 0, 0.0])
    return rows


class Tools(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def run_tool(self, tool, *words):
        """(what a tool prints, what stands on stderr)"""
        out, err = io.StringIO(), io.StringIO()
        with mock.patch.object(sys, "argv", [tool.__name__, *map(str, words)]), \
                contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            tool.main()
        return out.getvalue(), err.getvalue()

    def dump(self, *frames):
        path = self.folder / "dump"
        path.write_text("".join(snapshot(k, rows) for k, rows in enumerate(frames)))
        return path

    def quantities(self, text):
        return {line.split("quantity=")[1].split()[0]: line for line in text.splitlines()}


class FreeDrops(Tools):
    def measure(self, *frames):
        series = self.folder / "series"
        text, said = self.run_tool(
            drops, self.dump(*frames), "--case", "x", "--dim", 2, "-d", 1, "--rho", 1, "--sigma", 1,
            "--energy", "--series", series)
        return self.quantities(text), said, series.read_text().splitlines()

    def test_all_that_can_be_measured_is(self):
        for seed in range(5):
            found, said, series = self.measure(disc(), cloud(seed), disc())
            self.assertEqual(set(found), {"p", "velocity", "sphericity", "volume", "energy"})
            self.assertNotIn("nan", "".join(found.values()))
            self.assertNotIn("nan", series[1] + series[3])

    def test_a_drop_that_ends_in_pieces(self):
        for seed in range(5):
            found, said, series = self.measure(disc(), cloud(seed))
            self.assertEqual(set(found), {"p", "velocity", "sphericity", "volume", "energy"})
            self.assertNotIn("nan", series[1])
            self.assertGreater(float(found["velocity"].split("value=")[1].split()[0]), 50)

    def test_no_surface_particle_at_all(self):
        found, said, series = self.measure(disc(), cloud(surface=0))
        for name in ("p", "sphericity", "volume", "energy"):
            self.assertIn("value=nan", found[name])
            self.assertIn(name, said)
        self.assertIn("nan", series[2])

    def test_particles_without_a_place(self):
        rows = disc()
        rows[3][2] = math.nan
        found, said, _ = self.measure(rows)
        self.assertIn("1 of 193 particles have values that are not finite", said)
        self.assertNotIn("nan", found["p"])

    def test_an_outline_with_negative_volume_is_refused(self):
        """Radii below zero had a negative volume, and its power 2/3 is no real number."""
        star = Star(3, 0)
        for radius, good in ((1.0, True), (-1.0, False)):
            with contextlib.nullcontext() if good else self.assertRaises(ValueError):
                star.measures([radius])

    def test_a_series_that_grows_without_end(self):
        path = self.folder / "mode"
        for value in (lambda t: 1e300 * t, lambda t: math.nan, lambda t: math.exp(60 * t)):
            rows = "".join(f"{k} {0.1 * k} {value(0.1 * k)}\n" for k in range(60))
            path.write_text("# TimeStep v_t v_a\n" + rows)
            text, _ = self.run_tool(
                drops, self.dump(disc()), "--case", "x", "--dim", 2, "-d", 1, "--rho", 1,
                "--sigma", 1, "--mode", path, "--nu", 0.01)
            self.assertTrue({"p", "frequency", "damping"} <= set(self.quantities(text)))


class OnWalls(Tools):
    def test_sessile(self):
        for rows in (cloud(), cloud(surface=0), disc()[:3]):
            text, _ = self.run_tool(caps, "sessile", self.dump(rows), "--d", 1, "--angle", 60,
                                    "--sigma", 1, "--dim", 2, "--outline", self.folder / "outline")
            self.assertTrue({"angle", "height", "radius", "p"} <= set(self.quantities(text)))

    def hang(self, change, count=4000, start=()):
        """Verdict on a cube of count particles under the ceiling, 0.2 mm apart, after a change."""
        side, rows = round(count**(1 / 3)), []
        for k in range(side**3):
            place = [2e-4 * a for a in (k % side - side / 2, k // side % side - side / 2,
                                        -(k // side**2) - 1)]
            rows.append(change([k + 1, 1, *place, 0, 0, 0, 0, 0, 0, 0, 0.0], k))
        text, _ = self.run_tool(caps, "pendant", self.dump(*start, rows), "--d", 2e-4, "--angle", 60,
                                "--sigma", 0.07, "--rho", 1000, "--g", 5)
        return self.quantities(text)["verdict"].split("value=")[1].split()[0]

    def test_verdicts(self):
        source = random.Random(1)

        def change(index, value):
            return lambda row, k: row[:index] + [row[index] + value(k)] + row[index + 1:]

        # free fall over 20 mm: v^2/2 = g 20 mm
        fallen = change(4, lambda k: -0.02)
        self.assertEqual(self.hang(lambda row, k: row), "hangs")
        self.assertEqual(self.hang(change(7, lambda k: -0.1)), "moves")
        self.assertEqual(self.hang(lambda row, k: change(7, lambda k: -0.447)(fallen(row, k), k)),
                         "falls")
        # fast, and deep on average as a drop that falls
        self.assertEqual(self.hang(lambda row, k: change(7, lambda k: source.uniform(-9, 9))(
            fallen(row, k), k)), "explodes")
        # slow, but scattered: to the sides, through the ceiling, nowhere
        for index, value in ((2, lambda k: source.uniform(-1, 1)),
                             (4, lambda k: source.uniform(-1, 1)),
                             (4, lambda k: math.nan if k % 5 == 0 else 0.0),
                             (4, lambda k: math.nan)):
            self.assertEqual(self.hang(change(index, value)), "explodes")
        # the same velocity at the same place, without having sunk since the first snapshot
        flat = [[1, 1, 0, 0, -0.02, 0, 0, 0, 0, 0, 0, 0, 0.0]]
        fast = change(7, lambda k: -0.447)
        self.assertEqual(self.hang(lambda row, k: fast(fallen(row, k), k), start=[flat]), "explodes")
        # single particles make no explosion
        self.assertEqual(self.hang(change(4, lambda k: -1.0 if k == 7 else 0.0)), "hangs")


class Others(Tools):
    def test_patch_without_surface(self):
        for rows in (cloud(), cloud(surface=0)):
            path = self.dump(rows)
            with contextlib.redirect_stderr(io.StringIO()):
                lines = list(square_patch.result_lines(path, 1.0, 0.02, 1.0))
            self.assertEqual(set(self.quantities("".join(lines))), {"area", "surface", "outline"})

    def test_exact_flows(self):
        """Of a cavity, an ellipse and an impact without a shape, or with a single particle."""
        for rows in (cloud(), disc()[:1]):
            path = self.dump(rows)
            impacts = self.folder / "impact"
            impacts.write_text(path.read_text().replace("d_aleisph_p", "v_P"))
            plate = argparse.Namespace(scene="plate", height=1.0, impulse=0.5, energy=0.3)
            with contextlib.redirect_stderr(io.StringIO()):
                for lid, Re in (("flat", 400), ("flat", 123), ("smooth", 100), ("smooth", 400)):
                    lines = list(cavity.result_lines(path, lid, Re))
                    names = {"u", "p"} if lid == "smooth" else {"u", "v", "p", *cavity.EXTREMA[100]}
                    self.assertEqual(set(self.quantities("".join(lines))), names)
                lines = list(ellipse.result_lines(path, 1.0, 0.02, math.nan))
                self.assertEqual(set(self.quantities("".join(lines))), {"area", "a", "b", "p"})
                lines = list(impact.result_lines(impacts, plate))
                self.assertEqual(set(self.quantities("".join(lines))), {"P", "impulse"})

    def test_runs_that_end_at_once(self):
        tank = argparse.Namespace(L=1.0, H=0.5, A=0.002, omega=3.0, g=9.81)
        with contextlib.redirect_stderr(io.StringIO()):
            lines = list(wave.result_lines({"t": [0.0], "c": [1.0]}, wave.Wave(1, 1, 0.02, 1, 0.0)))
            self.assertEqual(["nan" in line for line in lines], [True, True, True])
            lines = list(sloshing.result_lines({"t": [0.0], "eta0": [0.0], "etaL": [0.0]}, tank))
            self.assertEqual(["nan" in line for line in lines], [True, True, True])
            heights, _ = spheric02.experiment()
            series = {"t": [-1.0], **{name: [0.0] for name in spheric02.HEIGHTS}}
            lines = list(spheric02.height_lines(series, heights))
        self.assertEqual(["nan" in line for line in lines], [True] * 4)


if __name__ == "__main__":
    unittest.main()
