#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""The table of results: what is read from a log and what is shown."""

import tempfile
import unittest

from result_table import read_results, short, table

LOG = """print "ALEISPH-RESULT case=pipe quantity=u l2=${e}"
ALEISPH-RESULT case=pipe quantity=u time=0.02 l2=1.23456789e-05 N=12800
ALEISPH-RESULT case=pipe quantity=p time=0.02 value=1.0 N=12800
Total wall time: 0:00:01
"""


class ResultTable(unittest.TestCase):
    def setUp(self):
        with tempfile.NamedTemporaryFile("w", suffix=".log") as log:
            log.write(LOG)
            log.flush()
            self.rows = read_results(log.name)

    def test_echoed_command_is_not_a_result(self):
        self.assertEqual([row["quantity"] for row in self.rows], ["u", "p"])

    def test_values_are_kept_as_written(self):
        self.assertEqual(self.rows[0]["l2"], "1.23456789e-05")

    def test_columns_are_aligned_and_gaps_are_empty(self):
        lines = table(self.rows)
        self.assertEqual(len(lines), 4)
        self.assertEqual(len({len(line) for line in lines}), 1)
        self.assertEqual(lines[0].split("  ")[0].strip(), "case")
        self.assertEqual(lines[3].split(), ["pipe", "p", "0.02", "12800", "1"])

    def test_numbers_are_rounded_names_and_integers_are_not(self):
        self.assertEqual(short("1.23456789e-05"), "1.235e-05")
        self.assertEqual(short("12800123"), "12800123")
        self.assertEqual(short("pipe"), "pipe")


if __name__ == "__main__":
    unittest.main()
