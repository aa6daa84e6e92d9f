#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Scripts of the cost over N, and what is concluded from their rows."""

import unittest

import cost_series as series
import sizes


def rows(ranks=1, peak=None):
    """A step of 2 us per particle at 1e3 and 20 at 1e5; 500 bytes per particle."""
    return [{"case": "3d-tank", "N": N, "total": total, "ranks": ranks, "cpu share": 1.0,
             "peak [MB]": 30 + 5e-4 * N if peak is None else peak}
            for N, total in ((1000, 2.0), (100000, 20.0))]


class Series(unittest.TestCase):
    def test_script_measures_steps_without_output_after_a_warm_up(self):
        text = series.script(sizes.TANK_3D, 1e4)
        self.assertIn("thermo 0\nrun 5\nrun 100 pre no\n", text)
        self.assertNotIn("\ndump ", text)

    def test_few_steps_of_many_particles(self):
        self.assertEqual([series.steps(N) for N in (1e2, 1e5, 1e6)], [100, 20, 3])
        self.assertIn("run 3\nrun 3 pre no\n", series.script(sizes.PATCH, 1e6))

    def test_slope_and_memory(self):
        slope, memory = series.summary(rows())
        self.assertAlmostEqual(slope["value"], 1.5)
        self.assertAlmostEqual(memory["value"], 500)

    def test_memory_is_not_stated_where_it_is_not_known(self):
        for unknown in (rows(ranks=2), rows(peak=0)):
            self.assertEqual([x["quantity"] for x in series.summary(unknown)], ["slope"])

    def test_a_faster_memory_would_be_in_proportion(self):
        line, *_ = series.summary([{**rows()[1], series.BANDWIDTH: 5.0}])
        self.assertAlmostEqual(line["value"], 10.0)
        self.assertAlmostEqual(line["measured"], 20.0)

    def test_the_stated_case_is_one_of_the_sizes(self):
        case, nominal = series.STATED
        self.assertIn(nominal, series.CASES[case].sizes)


if __name__ == "__main__":
    unittest.main()
