#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Rotating patch: pressure at the start, reference, verdict; the cost of a step."""

import csv
import math
import unittest
from pathlib import Path

import numpy as np

import patch
import patch_step

TABLE = Path(__file__).resolve().parents[2] / "tests/reference/square_patch_centre_pressure.csv"


def evaluate(formula, x, y):
    return eval(formula, {"cos": math.cos, "x": x, "y": y})


class Pressure(unittest.TestCase):
    formula = patch.first_pressure(20, 0.01)

    def test_at_the_centre_it_is_that_of_the_reference(self):
        # The series is cut; its terms fall off with the fourth power.
        p = evaluate(self.formula, 0.0, 0.0) / (20 * 0.01)**2
        self.assertAlmostEqual(p, patch.reference(0.0), delta=2e-4)

    def test_is_zero_on_the_edge_and_curved_inside(self):
        self.assertAlmostEqual(evaluate(self.formula, 10.0, 3.0), 0.0, delta=1e-9)
        # the series of the Laplacian converges with its first power only
        formula = patch.first_pressure(20, 0.01, terms=30)
        p = [evaluate(formula, x, y) for x, y in ((0, 0), (1, 0), (-1, 0), (0, 1), (0, -1))]
        self.assertAlmostEqual((sum(p[1:]) - 4 * p[0]) / (2 * 0.01**2), 1.0, delta=1 / 30)

    def test_reference_agrees_with_the_table(self):
        with open(TABLE, encoding="ascii") as lines:
            rows = list(csv.reader(line for line in lines if not line.startswith("#")))[1:]
        t, p = np.array([[float(x) for x in row[:2]] for row in rows]).T
        np.testing.assert_allclose(patch.reference(t[t <= 2]), p[t <= 2], rtol=0, atol=2e-5)


class Verdict(unittest.TestCase):
    t = np.linspace(0, 2, 201)

    def test_a_lost_pressure_is_named_with_its_time(self):
        p = patch.reference(self.t)
        self.assertEqual(patch.verdict(self.t, p), "")
        self.assertEqual(patch.verdict(self.t, p + 2 * (self.t > 0.995)),
                         "fails at omega t = 1")
        self.assertIn("0.5", patch.verdict(self.t, np.where(self.t < 0.495, p, np.nan)))

    def test_only_the_times_of_comparison_count(self):
        p = patch.reference(self.t) + (self.t < 0.09)
        self.assertEqual(np.max(patch.deviation(self.t, p)), 0.0)


class Step(unittest.TestCase):
    log = ("Loop time of 9 on 1 procs for 20 steps with 10 atoms\n99.0% CPU use\n"
           "Loop time of 4e-3 on 1 procs for 100 steps with 10 atoms\n\nx\n50.0% CPU use with\n")

    def test_the_last_run_counts_with_its_share_of_the_core(self):
        self.assertAlmostEqual(patch_step.last_loop(self.log)[0], 2.0)
        with self.assertRaises(ValueError):
            patch_step.last_loop("Loop time of 9 on 1 procs for 20 steps with 10 atoms\n")

    def test_the_ratio_is_that_of_runs_after_one_another(self):
        # the machine is twice as slow in the second round: the ratio is still 3
        runs = {"rheo": [(1.0, 9, 1e-4), (2.0, 9, 1e-4)], "ale": [(3.0, 9, 1e-3), (6.0, 9, 1e-3)]}
        self.assertAlmostEqual(patch_step.rows(runs)[1]["ratio"], 3.0)

    def test_the_example_has_the_part_that_is_left_out(self):
        self.assertNotIn("p-deviation", patch_step.own_script())
        self.assertIn("fix           ppe", patch_step.own_script())


if __name__ == "__main__":
    unittest.main()
