#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Free surfaces: the rotating patch against a boundary-integral solution, and a tank at rest
for thousands of steps.
"""

import unittest

from examples import last


def number(row, key="value"):
    return float(row[key])


class Patch(unittest.TestCase):
    def test_accurate(self):
        """Invariants are exact; 1 % and 2 % are asked for, measured 0.7 % and 0.2 %."""
        for cfl in (0.05, 0.2):
            run = last("square-patch", d=0.02, cfl=cfl)
            self.assertLess(number(run["p-deviation"], "linf"), 3e-3)
            for quantity, share in (("energy", 0.01), ("angular-momentum", 0.01), ("area", 0.02)):
                row = run[quantity]
                self.assertLess(abs(number(row) / number(row, "reference") - 1), share, quantity)

    def test_published(self):
        """As printed, dt = 1 ms: the area is kept within 2 %, measured +0.7 %; the error of p0 grows to
        7.3e-3."""
        run = last("square-patch", d=0.02, cfl=0.0354, variant="published")
        self.assertLess(abs(number(run["area"]) / number(run["area"], "reference") - 1), 0.02)
        self.assertLess(number(run["p-deviation"], "linf"), 15e-3)

    def test_published_with_the_other_readings(self):
        """p = 0 half a spacing inside the surface costs p0 (1 - (1 - d/L)^2) = 5.8e-3 alone; with
        eq 23 symmetric the fluid contracts, by 3.4 %."""
        run = last("square-patch", d=0.02, variant="published", pair="symmetric", normal="color",
                   layer="inside", rate=0.1)
        self.assertGreater(number(run["p-deviation"], "linf"), 5.8e-3)
        self.assertLess(number(run["p-deviation"], "linf"), 15e-3)
        self.assertLess(number(run["area"]), 0.98)


class Tank(unittest.TestCase):
    def test_lattice_stays(self):
        for variables in ({"n": 20}, {"n": 8, "dim": 3, "steps": 400}):
            run = last("tank", jitter=0, **variables)
            self.assertLess(number(run["v"], "linf"), 1e-12)

    def test_disorder_settles(self):
        for variables in ({"n": 20}, {"n": 8, "dim": 3}):
            run = last("tank", jitter=0.2, **variables)
            self.assertLess(number(run["v"], "l2"), 0.01)
            self.assertLess(abs(number(run["volume"]) - 1), 0.01)


if __name__ == "__main__":
    unittest.main(verbosity=2)
