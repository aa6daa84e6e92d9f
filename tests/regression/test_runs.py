#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Several `run` commands give what one gives. Every `run` builds its neighbor lists, operators and
matrices anew. Where particles do not move they come out the same, and so do all results, to the
last bit; else the order of neighbors may differ, and with it the rounding (README.md).
"""

import unittest
from dataclasses import replace

import dump_check
from cases import CASES
from dumps import read_frames
from example import HERE, run_case

SPLIT = {"poiseuille": "1 2 5", "poiseuille-plane-cn": "1 2 5", "couette-lagrangian": "1 3 5",
         "taylor-green": "2 5", "taylor-green-lagrangian": "1 2", "stokes-box-curlcurl": "1 5"}
FULL_PRECISION = {"(dump_modify .*) format.*": r"\1 format float %.17g"}


class Runs(unittest.TestCase):
    longMessage = False

    def both(self, name):
        """Dumps of one run and of several."""
        split = replace(CASES[name], variables={**CASES[name].variables, "marks": SPLIT[name]})
        return [run_case(name, case, variant, changes=FULL_PRECISION)[0]
                for case, variant in ((CASES[name], "one-run"), (split, "several-runs"))]

    def test_several_runs_equal_one(self):
        for name in SPLIT:
            with self.subTest(name):
                one, several = self.both(name)
                if "lagrangian" in name:
                    table = HERE / "tolerances" / f"{name}.txt"
                    report, good = dump_check.compare(several, one, table)
                    print(f"{name}: {report}")
                    self.assertTrue(good, f"{name}: {report}")
                else:
                    self.assertEqual(several.read_text(), one.read_text(), f"{name} differs")
                self.assertEqual([frame.step for frame in read_frames(one)],
                                 [frame.step for frame in read_frames(several)])


if __name__ == "__main__":
    unittest.main(verbosity=2)
