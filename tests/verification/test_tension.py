#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Surface tension: frequency and damping of drops against linear theory, drops at rest that were
cubes, and the Laplace pressure over three sizes and three spacings.
"""

import os
import unittest
from pathlib import Path

from examples import last
from series import read_table

TABLE = Path(os.environ["ALEISPH_SOURCE_DIR"]) / "tests/reference/laplace_pressure.csv"


def number(row, key="value"):
    return float(row[key])


class Oscillation(unittest.TestCase):
    """3 % and 15 % are asked for. A curvature that is 0.8 of the exact one would cost 11 % of the
    frequency; without the viscous normal stress the damping is half as large."""

    def check(self, **variables):
        run = last("capillary", shape="ellipse", **variables)
        self.assertLess(number(run["frequency"], "l2"), 0.03)
        self.assertLess(number(run["damping"], "l2"), 0.15)
        self.assertLess(number(run["energy"], "rise"), 1e-3)

    def test_ellipse(self):
        for res in (10, 20):
            self.check(res=res, Oh=0.02)

    def test_ellipsoid(self):
        for res in (8, 12):
            self.check(dim=3, res=res, Oh=0.03, T=4)

    def test_no_damping_without_viscosity(self):
        """The decay within a period must be below 1 %: 2 pi gamma/omega < 0.01."""
        run = last("capillary", shape="ellipse", res=10, Oh=0)
        self.assertLess(abs(number(run["damping"])), 0.01 * 2.45 / 6.28)

    def test_viscous_normal_stress(self):
        """Without it, half of the energy loss of a potential flow n = 2 is missing."""
        run = last("capillary", shape="ellipse", res=10, Oh=0.02, tension=["viscous no"])
        self.assertLess(number(run["damping"]), 0.75 * number(run["damping"], "reference"))


class AtRest(unittest.TestCase):
    def check(self, run):
        self.assertLess(number(run["p"], "l2"), 0.02)
        self.assertLess(number(run["sphericity"], "linf"), 0.5)
        for key in ("value", "outline"):
            self.assertLess(abs(number(run["volume"], key) - 1), 0.01)
        # the averages in the curvature let tension take up less energy of short waves, of n = 4
        # that a cube begins with, than the area says: see the README of cube-drop
        self.assertLess(number(run["energy"], "rise"), 1e-2)

    def test_square(self):
        self.check(last("capillary"))

    def test_cube(self):
        self.check(last("cube-drop", d=1e-4))

    def test_water_with_filter(self):
        run = last("cube-drop", d=2e-4, nu=1e-6, filter=0.5, T=5)
        self.assertLess(number(run["p"], "l2"), 0.02)
        self.assertLess(number(run["sphericity"], "linf"), 0.5)


class Laplace(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.pressure = {float(row["L"]): float(row["dp"]) for row in read_table(TABLE)
                        if row["dim"] == "3"}

    def test_nine_combinations(self):
        for L, p in self.pressure.items():
            for n in (10, 14, 20):
                run = last("laplace", L=L, n=n)
                self.assertAlmostEqual(number(run["p"], "reference") / p, 1, delta=1e-5)
                self.assertLess(abs(number(run["p"]) / p - 1), 0.02, f"L={L} n={n}")
                self.assertLess(number(run["sphericity"], "linf"), 0.5)

    def test_published_explodes(self):
        """If it does not any more, the tables of the READMEs are out of date."""
        run = last("laplace", L=0.002, n=10, model="published")
        self.assertGreater(number(run["sphericity"], "linf"), 2)


if __name__ == "__main__":
    unittest.main(verbosity=2)
