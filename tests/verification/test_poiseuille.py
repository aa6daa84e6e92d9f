#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Hagen-Poiseuille flow to the accuracy that the method allows: order of the transient, exactness
of the steady profile, and independence of the steady state from the time step of a stiff fluid.
"""

import math
import unittest

from examples import results

# L2 errors at nu dt/d^2 = 0.1 and t = 0.02, 0.05, 0.1, 0.5 of an independent program (sparse
# direct solver) with the same particles. The example rounds the step down to hit the times of
# comparison, to nu dt/d^2 = 0.0985 at d = 6.25e-5. Forward Euler hides spatial error in proportion
# to the step, and at 0.1 it hides half of it: 1.5 % less of a step shows about 1.5 % more error.
# Two more per cent are the two digits that the reference is given with.
REFERENCE = {
    "1e-4": (2.8e-3, 3.75e-3, 2.45e-3, 1.3e-6),
    "6.25e-5": (1.23e-3, 1.58e-3, 1.02e-3, 5.7e-7),
    "5e-5": (8.24e-4, 1.04e-3, 6.63e-4, 3.5e-7),
}
MARGIN = 1.035
TIMES = (0.02, 0.05, 0.1, 0.5)


class Pipe(unittest.TestCase):
    def test_transient(self):
        error = {}
        for d, reference in REFERENCE.items():
            rows = results("poiseuille", d=d)
            error[d] = [rows[t]["l2"] for t in TIMES]
            for t, mine, theirs in zip(TIMES, error[d], reference):
                self.assertLessEqual(mine, MARGIN * theirs, f"d={d} t={t}")
        # second order, reached from below as the support is a large part of the radius
        for k, t in enumerate(TIMES[:3]):
            order = math.log(error["1e-4"][k] / error["5e-5"][k]) / math.log(2.0)
            print(f"order at t={t}: {order:.3f}")
            self.assertGreaterEqual(order, 1.75, f"t={t}")

    def test_steady_profile_stays(self):
        # 1000 steps of 0.001 s; 1e-9 is ten times the tolerance of the pressure solve
        for row in results("poiseuille", d="1e-4", start="steady", marks="50 100").values():
            self.assertLessEqual(row["l2"], 1.0e-9)
        for row in results("poiseuille-plane", start="steady", marks="50 100").values():
            self.assertLessEqual(row["l2"], 1.0e-9)

    def test_stiff(self):
        # nu = 1e-3; vn = 0.456 is the explicit limit of this arrangement. Backward Euler is done
        # with the transient, exp(-5.78 nu t/R^2), at t = 4 R^2/nu: 1e-10
        for mult in (1, 10, 100):
            rows = results("poiseuille", d="1e-4", nu="1e-3", vn="0.456", scheme="be", mult=mult,
                           marks="100")
            self.assertLessEqual(list(rows.values())[-1]["l2"], 1.0e-8, f"mult={mult}")


if __name__ == "__main__":
    unittest.main(verbosity=2)
