#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Runs of the stability report: their scripts, what is read from them, the verdict."""

import tempfile
import unittest
from pathlib import Path

import trial
from trial import CASES, Trial

FRAME = """ITEM: TIME
{time}
ITEM: TIMESTEP
{step}
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS mm mm pp
0 1
0 1
0 1
ITEM: ATOMS id type x y surface
1 1 0.25 0.5 1
2 2 {x} 0.5 0
"""


class Scripts(unittest.TestCase):
    def test_every_factor_changes_what_it_is_about(self):
        for case, setup in CASES.items():
            base = trial.script(Trial(case, "base", ""))
            self.assertIn("fix bench all ave/time", base)
            kernel = trial.script(Trial(case, "kernel", "wendland-c2"))
            self.assertIn(" kernel wendland-c2", kernel)
            self.assertIn(" h/d 1.3", trial.script(Trial(case, "h/d", 1.3)))
            self.assertEqual(trial.variables(Trial(case, "cfl", 0.05))["cfl"], 0.05)
            self.assertEqual(trial.variables(Trial(case, "jitter", 0.1))["jitter"], 0.1)
            self.assertEqual(Trial(case, "ranks", 2).ranks(), 2)
            if setup.guards:
                self.assertIn(" aleisph/guard\n", trial.script(Trial(case, "guards", "none")))

    def test_spacings_divide_the_width(self):
        for case in CASES:
            for factor in (0.5, 1, 2):
                count = 1 / Trial(case, "d x", factor).spacing()
                self.assertAlmostEqual(count, round(count))

    def test_small_steps_are_run_for_a_short_time(self):
        self.assertLess(Trial("patch", "cfl", 0.02).end(), Trial("patch", "cfl", 0.05).end())


class Frames(unittest.TestCase):
    def read(self, text):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "dump"
            path.write_text(text, encoding="ascii")
            return list(trial.frames(path))

    def test_all_snapshots(self):
        first, last = (FRAME.format(time=t, step=10 * t, x=x) for t, x in ((0, 0.5), (1, 1.5)))
        frames = self.read(first + last)
        self.assertEqual([list(frame["x"]) for frame in frames], [[0.25, 0.5], [0.25, 1.5]])

    def test_one_that_is_not_complete_is_left_out(self):
        whole = FRAME.format(time=0, step=0, x=0.5)
        self.assertEqual(len(self.read(whole + whole[:-20])), 1)


class Verdict(unittest.TestCase):
    good = {"failure": "", "energy": 1.0, "volume": 0.0, "beyond": 0}

    def test_finished(self):
        self.assertEqual(trial.verdict(self.good), "finished")

    def test_what_has_not_held_is_named(self):
        for change, word in (({"energy": 1.1}, "energy"), ({"volume": -0.1}, "volume"),
                             ({"beyond": 1}, "penetration"), ({"energy": float("nan")}, "energy"),
                             ({"failure": "ERROR: lost"}, "ERROR: lost")):
            self.assertIn(word, trial.verdict({**self.good, **change}))


if __name__ == "__main__":
    unittest.main()
