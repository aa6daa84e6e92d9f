#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Ratios of one code over another, where we are least ahead, and the lines of it."""

import unittest

import common
import comparison


def row(code, variant, n, seconds, l2, time=1.0):
    return {"case": "flow", "code": code, "variant": variant, "n": n, "time": time,
            "seconds": seconds, "l2": l2}


class Comparison(unittest.TestCase):
    # ours: error = 1/seconds between 1 s and 100 s
    ours = [row("aleisph", "tuned", n, 10.0**k, 10.0**-k) for k, n in enumerate((10, 20, 40))]
    families = {"tuned": "ours"}

    def analysed(self, *peers):
        rows = [*self.ours, *peers]
        return rows, list(comparison.ratios(rows, self.families))

    def test_ratios_at_equal_error_and_equal_time(self):
        _, found = self.analysed(row("sph", "tuned", 15, 50.0, 0.2))
        self.assertAlmostEqual(found[0]["time ratio"], 10.0)    # ours needs 5 s
        self.assertAlmostEqual(found[0]["error ratio"], 10.0)   # ours has 0.02 after 50 s
        self.assertEqual(found[0]["time shown"], "10")

    def test_bounds_and_what_is_out_of_reach(self):
        _, found = self.analysed(row("sph", "tuned", 15, 500.0, 2.0),
                                 row("sph", "tuned", 30, 0.1, 1e-4))
        self.assertEqual((found[0]["time shown"], found[0]["error shown"]), (">500", ">200"))
        self.assertEqual((found[1]["time shown"], found[1]["error shown"]), ("-", "-"))

    def test_other_times_and_failed_runs_do_not_count(self):
        failed = {"case": "flow", "code": "rheo", "variant": "tuned", "n": 15, "time": 1.0,
                  "failure": "lost atoms"}
        rows, found = self.analysed(failed, row("sph", "tuned", 15, 50.0, 0.2, time=2.0))
        self.assertEqual(found, [])
        table = list(comparison.table(rows, found, self.families))
        self.assertEqual([line.get("failure") for line in table], [None, "lost atoms", None])
        lines = list(comparison.result_lines(rows, found, self.families))
        self.assertEqual([common.fields(line)["value"] for line in lines], ["lost-atoms"])

    def test_the_run_where_we_are_least_ahead(self):
        rows, found = self.analysed(row("rheo", "tuned", 15, 50.0, 0.2),
                                    row("rheo", "tuned", 30, 100.0, 0.02))
        least = comparison.least(found, "rheo tuned", 1.0, "tuned")
        self.assertEqual(least["n"], 30)    # 2 and 2, not 10 and 10
        cells = [line.get("ours") for line in comparison.table(rows, found, self.families)]
        self.assertEqual(cells, [None, "2 / 2 (n=30)"])

    def test_result_lines_carry_the_ratio(self):
        rows, found = self.analysed(row("rheo", "tuned", 15, 50.0, 0.2))
        lines = [common.fields(line) for line in
                 comparison.result_lines(rows, found, self.families)]
        self.assertEqual([(line["quantity"], line["of"], line["value"]) for line in lines],
                         [("ratio", "time", 10.0), ("ratio", "error", 10.0)])


if __name__ == "__main__":
    unittest.main()
