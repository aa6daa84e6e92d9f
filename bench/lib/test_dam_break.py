#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""The curve of a front against points, and what is read from files and logs."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

import dam_break


class Front(unittest.TestCase):
    T = np.linspace(0.0, 4.0, 401)
    points = np.array([0.5, 1.0, 2.0, 3.0])

    def test_a_constant_distance_is_its_rms(self):
        curve = self.T, 1.0 + self.T
        self.assertAlmostEqual(dam_break.rms(curve, self.points, 1.25 + self.points), 0.25)

    def test_finds_the_delay(self):
        curve = self.T, 1.0 + self.T**2
        late = 1.0 + (self.points - 0.15)**2
        # The scan has a step of 0.002; the curve bends by less than that between its points.
        self.assertAlmostEqual(dam_break.best_shift(curve, self.points, late), 0.15, delta=0.0021)

    def test_the_table_of_the_experiment(self):
        T, Z = dam_break.experiment()
        self.assertEqual((T[0], Z[0], T[-1], Z[-1]), (0.41, 1.11, 3.33, 4.11))
        self.assertLess(T[-1], dam_break.END)

    def test_an_incomplete_line_is_left_out(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "series"
            path.write_text("# t x\n0 0.0 1.0\n5 0.5 1.5\n10 1.0", encoding="ascii")
            T, x = dam_break.columns(path, 1, 2)
        self.assertEqual((list(T), list(x)), ([0.0, 0.5], [1.0, 1.5]))

    def test_steps_of_all_runs(self):
        text = ("Loop time of 1e-6 on 1 procs for 0 steps with 9 atoms\n"
                "Loop time of 2.5 on 1 procs for 30 steps with 9 atoms\n"
                "Loop time of 0.5 on 2 procs for 12 steps with 9 atoms\n")
        self.assertEqual(dam_break.steps(text), 42)


class Rheo(unittest.TestCase):
    def test_numbers_of_the_example(self):
        # 57 high: g = MACH^2/(2 H) = 1e-3 and eta = H sqrt(g H)/REYNOLDS = 0.1 again
        g = dam_break.MACH**2 / (2 * dam_break.HEIGHT)
        self.assertAlmostEqual(g, 1e-3)
        H = dam_break.HEIGHT
        self.assertAlmostEqual(H * np.sqrt(g * H) / dam_break.REYNOLDS, 0.1)


if __name__ == "__main__":
    unittest.main()
