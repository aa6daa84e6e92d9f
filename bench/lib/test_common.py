#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""The benchmarks' own arithmetic: exact profile, wall fit, envelopes and ratios."""

import csv
import unittest
from pathlib import Path

import numpy as np

import common

REFERENCE = Path(__file__).resolve().parents[2] / "tests/reference/plane_poiseuille_startup.csv"


class PlaneStartUp(unittest.TestCase):
    def test_agrees_with_the_tabulated_series(self):
        with open(REFERENCE, encoding="ascii") as lines:
            table = csv.DictReader(line for line in lines if not line.startswith("#"))
            tau, y, u = np.array([[float(x) for x in row.values()] for row in table]).T
        # The table has h = 2H = 1, u_max = 1; with nu = 1 that is G = 8. It is rounded to 5e-7.
        for t in np.unique(tau):
            here = tau == t
            mine = common.plane_start_up(y[here] - 0.5, 0.5, 8.0, 1.0, t)
            np.testing.assert_allclose(mine, u[here], rtol=0, atol=6e-7)

    def test_starts_from_rest(self):
        y = np.linspace(-1, 1, 41)
        # At nu t/H^2 = 1e-6 the fluid away from the walls has fallen freely: u = G t = 1e-6.
        np.testing.assert_allclose(common.plane_start_up(y, 1, 1, 1, 1e-6)[2:-2], 1e-6, rtol=1e-3)


class WallFit(unittest.TestCase):
    def test_finds_the_wall_of_an_exact_profile(self):
        H, d, G, nu = 0.5, 0.05, 3.0, 0.7
        y = np.arange(-H + d / 2, H, d)
        profiles = [(y, common.plane_start_up(y, H + 0.37 * d, G, nu, t), t) for t in (0.02, 0.3)]
        # The last scan has a step of 1e-4.
        self.assertAlmostEqual(common.fit_wall(profiles, H, G, nu, d), 0.37, delta=1e-4)


class Comparison(unittest.TestCase):
    # error = 1/seconds, and a run that is worse in both and must not count
    points = [(1.0, 1.0), (10.0, 0.1), (100.0, 0.01), (50.0, 0.5)]

    def test_interpolates_in_logarithms(self):
        self.assertAlmostEqual(common.time_for_error(self.points, 0.02)[0], 50.0)
        self.assertAlmostEqual(common.error_at_time(self.points, 20.0)[0], 0.05)

    def test_says_what_is_only_a_bound(self):
        self.assertEqual(common.time_for_error(self.points, 2.0), (1.0, "<"))
        self.assertEqual(common.error_at_time(self.points, 300.0)[1], "<")

    def test_says_what_is_out_of_reach(self):
        self.assertEqual(common.time_for_error(self.points, 1e-3), (None, None))
        self.assertEqual(common.error_at_time(self.points, 0.1), (None, None))


class Errors(unittest.TestCase):
    def test_the_first_error_without_its_line_in_the_source(self):
        text = "Step 1\nERROR: Lost atoms: 9 (src/thermo.cpp:512)\nERROR on proc 0: other\n"
        self.assertEqual(common.error_of(text), "ERROR: Lost atoms: 9")
        self.assertEqual(common.error_of("no ERROR here\n"), "")


class Timing(unittest.TestCase):
    def test_share_of_the_core_is_weighted_with_time(self):
        text = ("Loop time of 3 on 1 procs for 1 steps with 2 atoms\n99.0% CPU use with 1 MPI\n"
                "Loop time of 1 on 1 procs for 1 steps with 2 atoms\n59.0% CPU use with 1 MPI\n")
        self.assertAlmostEqual(common.cpu_share(text), 0.89)

    def test_a_run_without_a_share_does_not_count(self):
        text = ("Loop time of 8 on 1 procs for 0 steps with 2 atoms\n"
                "Loop time of 4 on 1 procs for 1 steps with 2 atoms\n50.0% CPU use with 1 MPI\n"
                "Loop time of 2 on 1 procs for 0 steps with 2 atoms\n")
        self.assertAlmostEqual(common.cpu_share(text), 0.5)


if __name__ == "__main__":
    unittest.main()
