#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Reading one solve, and the growth of the iterations."""

import unittest
import unittest.mock

import pressure

LOG = """
Loop time of 1e-6 on 1 procs for 0 steps with 50 atoms
PRESSURE iterations=12 residual={residual} restarts=0 solves=1 failed={failed} fluid=40

ALEISPH time: 0.5 s for 0 steps to step 0, 100 us per particle-step and rank
  preconditioner      0.1 s   20.0 %
  solve               0.4 s   80.0 %
"""


class Solves(unittest.TestCase):
    def test_row_of_a_solve(self):
        row = pressure.read(LOG.format(residual=5e-9, failed=0), "ilu0", 1, share=0.5)
        self.assertEqual((row["iterations"], row["N"], row["fluid"]), (12, 50, 40))
        self.assertAlmostEqual(row["set-up"], 0.1)
        self.assertAlmostEqual(row["seconds"], 0.5)
        self.assertIsNone(row["note"])

    def test_the_quickest_of_short_solves_counts(self):
        rows = [{"iterations": 5, "seconds": s, "note": None} for s in (0.3, 0.1, 0.2)]
        with unittest.mock.patch.object(pressure, "attempt", side_effect=rows):
            self.assertEqual(pressure.solve(None, {}, "ilu0", None, 1, 1)["seconds"], 0.1)

    def test_a_long_solve_is_run_once(self):
        row = {"iterations": 5, "seconds": 2.0, "note": None}
        with unittest.mock.patch.object(pressure, "attempt", side_effect=[row]):
            self.assertIs(pressure.solve(None, {}, "ilu0", None, 1, 1), row)

    def test_other_iterations_of_the_same_solve_are_named(self):
        rows = [{"iterations": k, "seconds": 0.1, "note": None} for k in (5, 6, 5)]
        with unittest.mock.patch.object(pressure, "attempt", side_effect=rows):
            self.assertEqual(pressure.solve(None, {}, "amg", None, 1, 1)["note"],
                             "not-reproducible")

    def test_what_did_not_converge_is_named(self):
        for residual, failed in ((5e-9, 1), (2e-8, 0), ("nan", 0)):
            row = pressure.read(LOG.format(residual=residual, failed=failed), "none", 1)
            self.assertEqual(row["note"], "not-converged")

    def test_a_fallback_is_named(self):
        text = ("WARNING: Fix aleisph/ppe: preconditioner amg failed at step 0 (breakdown), jacobi "
                "was used (src/fix.cpp:1)\n" + LOG)
        self.assertEqual(pressure.read(text.format(residual=1e-9, failed=0), "amg", 1)["note"],
                         "fallback")

    def test_what_is_not_affordable_is_left_out(self):
        self.assertEqual(pressure.affordable(["none", "amg"], 1e6), ["amg"])
        self.assertTrue(pressure.too_long({"note": "stopped-after-5-s"}))
        self.assertFalse(pressure.too_long({"note": None}))

    def test_what_a_build_has_not(self):
        for text in ("ERROR: Fix aleisph/ppe: unknown preconditioner amg, use auto or one of none",
                     "ERROR: Fix aleisph/ppe: preconditioner amg needs the library hypre, and"):
            self.assertTrue(pressure.MISSING.search(text))
        self.assertFalse(pressure.MISSING.search("ERROR: Lost atoms: original 50 current 49"))

    def test_growth_is_from_the_size_next_to_ten_thousand(self):
        rows = [{"case": "pipe", "preconditioner": "amg", "N": N, "iterations": k, "note": note}
                for N, k, note in ((1e3, 5, None), (9e3, 8, None), (1e5, 9, None),
                                   (1e6, 10, None), (2e6, 90, "not-converged"))]
        line, = pressure.growth(rows)
        self.assertEqual((line["from"], line["N"], line["value"]), (9e3, 1e6, 1.25))

    def test_no_growth_from_one_size(self):
        self.assertEqual(pressure.growth([{"case": "pipe", "preconditioner": "amg", "N": 1e4,
                                           "iterations": 5}]), [])

    def test_the_scene_gets_the_preconditioner(self):
        text = pressure.script("fix ppe all aleisph/ppe tol 1e-8\ntimestep 1\n", "jacobi")
        self.assertIn("fix ppe all aleisph/ppe tol 1e-8 preconditioner jacobi", text)


if __name__ == "__main__":
    unittest.main()
