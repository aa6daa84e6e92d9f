#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""The tools of these tests: a check that cannot fail would be worth nothing, so dumps are spoilt in
every way that matters. And the pictures of the examples: their exact profiles and their drawing.
"""

import contextlib
import csv
import io
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

import dump_check
import profiles
import render
import series
from PIL import Image
from dumps import read_frames
from example import HERE, TOP

DUMP = """ITEM: TIMESTEP
10
ITEM: TIME
0.5
ITEM: NUMBER OF ATOMS
3
ITEM: BOX BOUNDS pp pp pp
0 1
0 1
0 1
ITEM: ATOMS id type x vx
1 1 0.0 2.0
2 1 0.5 3.0
3 2 1.0 4.0
"""
TABLE = """# column tolerance reason
id exact the same particles
type exact types never change
x 1e-9 a reason
vx 1e-3 another reason
"""


class DumpCheck(unittest.TestCase):
    def check(self, dump, table=TABLE):
        for name, text in (("a.dump", dump), ("b.dump", DUMP), ("table.txt", table)):
            Path(name).write_text(text)
        return dump_check.compare("a.dump", "b.dump", "table.txt")

    def test_equal_dumps_agree(self):
        self.assertTrue(self.check(DUMP)[1])

    def test_order_of_lines_does_not_matter(self):
        lines = DUMP.splitlines(keepends=True)
        self.assertTrue(self.check("".join(lines[:-3] + lines[-1:] + lines[-3:-1]))[1])

    def test_difference_within_tolerance(self):
        self.assertTrue(self.check(DUMP.replace("3.0", "3.0009"))[1])

    def test_worst_atom_is_named(self):
        report, good = self.check(DUMP.replace("2.0", "2.0005").replace("3.0", "3.0011"))
        self.assertFalse(good)
        self.assertRegex(report, r"vx .*0\.0011 of 0\.001 allowed: atom 2 has 3\.0011.*too far")

    def test_spoilt_dumps(self):
        for what, spoilt in {
                "a value that is not a number": DUMP.replace("3.0", "nan"),
                "another type": DUMP.replace("3 2 1.0", "3 1 1.0"),
                "another atom": DUMP.replace("3 2 1.0", "4 2 1.0"),
                "an atom less": DUMP.replace("3 2 1.0 4.0\n", "").replace("ATOMS\n3", "ATOMS\n2"),
                "an atom twice": DUMP.replace("3 2 1.0", "2 2 1.0"),
                "another step": DUMP.replace("\n10\n", "\n11\n"),
                "a column less": DUMP.replace(" vx", "").replace(" 2.0", "").replace(
                    " 3.0", "").replace(" 4.0", "")}.items():
            with self.subTest(what):
                self.assertFalse(self.check(spoilt)[1])

    def test_files_that_are_not_whole(self):
        for text in ("", DUMP[:-20], DUMP.replace("id type", "type"), "nonsense\n"):
            with self.assertRaises(ValueError):
                self.check(text)

    def test_tolerances_need_a_number_and_a_reason(self):
        for table in (TABLE.replace("another reason", ""), TABLE.replace("1e-3", "nan"),
                      TABLE.replace("1e-3", "-1")):
            with self.assertRaises(ValueError):
                self.check(DUMP, table)

    def test_column_without_tolerance(self):
        self.assertFalse(self.check(DUMP, TABLE.replace("vx", "# vx"))[1])


class Profiles(unittest.TestCase):
    """Against the stored series, written with six digits and for another normalisation."""

    def compare(self, name, function, place, scale):
        with open(TOP / "tests" / "reference" / name, encoding="ascii") as lines:
            rows = np.array([row for row in csv.reader(line for line in lines if line[0] != "#")
                             if row[0] != "tau"], dtype=float)
        self.assertGreater(len(rows), 20)
        for tau, s, u in rows:
            self.assertAlmostEqual(function(place(s), tau * scale), u, delta=1e-6)

    def test_pipe(self):
        self.compare("hagen_poiseuille_startup.csv",
                     lambda r, t: profiles.pipe(r, t, 1.0, 4.0, 1.0), lambda s: s, 1.0)

    def test_plane(self):    # there: plates at 0 and 1, tau by their distance; here: at -1 and 1
        self.compare("plane_poiseuille_startup.csv",
                     lambda y, t: profiles.plane(y, t, 1.0, 2.0, 1.0), lambda s: 2 * s - 1, 4.0)

    def test_couette(self):
        self.compare("couette_startup.csv",
                     lambda y, t: profiles.couette(y, t, 1.0, 1.0, 1.0), lambda s: s, 1.0)


class Render(unittest.TestCase):
    def draw(self, case, *options):
        picture = Path(f"{case}.png")
        picture.unlink(missing_ok=True)
        dump = str(HERE / "reference" / f"{case}.dump.gz")
        with mock.patch("sys.argv", ["render.py", dump, str(picture), *options]):
            render.main()
        self.assertEqual(picture.read_bytes()[:8], b"\x89PNG\r\n\x1a\n")

    def test_pictures(self):
        self.draw("poiseuille", "--fields", "vx", "--slice", "z=0",
                  "--profile", "pipe", "5e-4", "0.5", "1e-6")
        self.draw("stokes-box", "--fields", "speed", "p", "--arrows", "5")

    def test_slice_takes_one_layer(self):
        frame = read_frames(HERE / "reference" / "poiseuille.dump.gz")[-1]
        near = render.slice_mask(frame, "x=0")
        self.assertEqual(set(np.round(frame["x"][near], 9)), {0.0})

    def test_unknown_option_is_refused(self):
        with contextlib.redirect_stderr(io.StringIO()), self.assertRaises(SystemExit):
            self.draw("poiseuille", "--no-such-option")

    def test_particles_that_coincide_in_projection(self):
        """In the plane z = 0 of the pipe, seen along z, pairs of particles lie on each other; the
        discs are as large as the spacing all the same, and stderr has their number."""
        with contextlib.redirect_stderr(io.StringIO()) as said:
            self.draw("poiseuille", "--fields", "vx", "--axes", "xy", "--slice", "z=0")
        self.assertIn("15 of 90 particles lie on others", said.getvalue())
        colors = np.asarray(Image.open("poiseuille.png").convert("RGB")).astype(int)
        # neither white, grey nor black: 60 of 75 places in this panel, a disc covers pi/4 of a cell
        self.assertGreater(np.mean(np.ptp(colors, axis=2) > 30), 0.1)


class Factors(unittest.TestCase):
    def picture(self, columns, rows, d, u):
        """The figure of a lattice with a few values far off the colors."""
        size = columns * rows
        lines = [f"{k + 1} 1 {d * (k % columns)} {d * (k // columns)} 0 {u * (k if k % 7 else 1e4)} 0 0"
                 for k in range(size)]
        Path("factors.dump").write_text("\n".join(
            ["ITEM: TIMESTEP", "0", "ITEM: TIME", "0.1234", "ITEM: NUMBER OF ATOMS", str(size),
             "ITEM: BOX BOUNDS pp pp pp", "0 2", "0 2", "0 2", "ITEM: ATOMS id type x y z vx vy vz",
             *lines, ""]))
        words = ["render.py", "factors.dump", "factors.png", "--fields", "vx", "--units", "m/s",
                 "--limits", "vx", "0", str(u * size)]
        with mock.patch("sys.argv", words), mock.patch.object(render, "save") as save, \
                contextlib.redirect_stderr(io.StringIO()):
            render.main()
        return save.call_args.args[0]

    def test_nothing_lies_on_the_factor_of_an_axis(self):
        for columns, rows in ((4, 40), (20, 20), (40, 8)):
            for d in (1e-4, 1.0):
                for u in (1.0, 1e5, 1e-9):
                    figure = self.picture(columns, rows, d, u)
                    figure.canvas.draw()
                    words = [text for axes in figure.axes for text in
                             (axes.title, axes.xaxis.label, axes.yaxis.label) if text.get_text()]
                    factors = [axis.offsetText for axes in figure.axes
                               for axis in (axes.xaxis, axes.yaxis) if axis.offsetText.get_text()]
                    self.assertIn("off the colors", words[0].get_text())
                    on = [(one.get_text(), other.get_text()) for one in words for other in factors
                          if render.overlap(one, other)]
                    self.assertEqual(on, [], (columns, rows, d, u))
                    render.plt.close(figure)


class Strays(unittest.TestCase):
    """A picture of 400 particles on a lattice, u = x, to which some are added."""

    def draw(self, *more):
        """(stderr, limits of the colors, of x)"""
        grid = [(0.1 * i, 0.1 * j, 0.1 * i) for i in range(20) for j in range(20)]
        lines = [f"{k} 1 {x} {y} 0 {u} 0 0" for k, (x, y, u) in enumerate(grid + list(more), 1)]
        Path("stray.dump").write_text("\n".join(
            ["ITEM: TIMESTEP", "0", "ITEM: NUMBER OF ATOMS", str(len(lines)),
             "ITEM: BOX BOUNDS pp pp pp", "0 2", "0 2", "0 2", "ITEM: ATOMS id type x y z vx vy vz",
             *lines, ""]))
        figure = render.plt.figure()
        axes = figure.subplots()
        with mock.patch("sys.argv", ["render.py", "stray.dump", "stray.png"]), \
                contextlib.redirect_stderr(io.StringIO()) as said:
            render.draw_field(figure, axes, read_frames("stray.dump")[0], "vx", render.parse())
        colors = axes.collections[-1].get_clim()
        render.plt.close(figure)
        return said.getvalue(), colors, axes.get_xlim()

    def test_none(self):
        said, colors, x = self.draw()
        self.assertEqual(said, "")
        np.testing.assert_allclose(colors, (0.0, 1.9))
        np.testing.assert_allclose(x, (-0.1, 2.0))

    def test_a_value_far_off_does_not_change_the_colors(self):
        for value in (1e9, -1e9):
            said, colors, _ = self.draw((0.95, 0.95, value))
            np.testing.assert_allclose(colors, (0.0, 1.9))
            self.assertIn("1 of 401 values lie outside of the colors, 0 to 1.9", said)

    def test_a_particle_far_off_does_not_change_the_axes(self):
        said, colors, x = self.draw((1e6, 0.5, 0.5))
        np.testing.assert_allclose(x, (-0.1, 2.0))
        self.assertIn("1 of 401 particles lie outside of the picture", said)

    def test_not_a_number(self):
        said, colors, x = self.draw((0.95, 0.95, "nan"), ("nan", 0.5, 0.5))
        np.testing.assert_allclose(colors, (0.0, 1.9))
        self.assertIn("2 of 402 particles have values that are not finite", said)

    def test_near_values_count(self):
        """What is no farther off than the others are apart: a jet, spray."""
        said, colors, _ = self.draw((0.95, 0.95, 3.6))
        np.testing.assert_allclose(colors, (0.0, 3.6))
        self.assertEqual(said, "")

    def test_few_values(self):
        for values in ([1.0], [1.0, 5.0], [2.0] * 9 + [3.0]):
            self.assertEqual(render.limits_without_strays(np.array(values)), (min(values), max(values)))


class Missing(unittest.TestCase):
    def test_what_is_missing_is_named(self):
        with mock.patch.dict("sys.modules", {"matplotlib": None}), \
                self.assertRaisesRegex(SystemExit, "need matplotlib for .*python3-matplotlib"):
            series.pyplot()

    def test_errors_are_one_line(self):
        for words, text in (
                (["--frame", "7"], "there is no snapshot 7: the dump has 1"),
                (["--fields", "vz7"], "no column vz7; it has id type"),
                (["--slice", "z=9"], "no fluid particle is near the plane z=9"),
                (["--walls", "1", "2", "3", "4"], "all particles are walls")):
            dump = str(HERE / "reference" / "poiseuille.dump.gz")
            with mock.patch("sys.argv", ["render.py", dump, "error.png", *words]), \
                    self.assertRaisesRegex(SystemExit, text):
                render.main()


if __name__ == "__main__":
    unittest.main(verbosity=2)
