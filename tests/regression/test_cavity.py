#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""The spectral solver of tools/cavity_reference.py: against the stored tables that it has made with more
polynomials, and, at Re = 1000, against those of Botella and Peyret, which it has no part in."""

import unittest

import cavity
import numpy as np
from cavity_reference import Cavity


class Spectral(unittest.TestCase):
    def profiles(self, Re, n):
        """Largest differences of u, v, p from the table."""
        tables = cavity.tables(Re)
        places = {line: np.array([row[0] for row in rows]) for line, rows in tables.items()}
        u, pu, v, pv = Cavity("flat", n, Re).lines(places["u"], places["v"])

        def off(found, line, column):
            return np.abs(found - [row[column] for row in tables[line]]).max()
        return off(u, "u", 1), off(v, "v", 1), max(off(pu, "u", 2), off(pv, "v", 2))

    def test_smooth_lid(self):
        """The singularity in the corners is weak: 24 polynomials a side are enough for 1.4e-5."""
        stored, solver = cavity.SmoothLid(), Cavity("smooth", 24, 100.0)
        g = np.linspace(0.05, 0.95, 19)
        x, y = (a.ravel() for a in np.meshgrid(g, g))
        flow = solver.flow(x, y)
        for a, b, u, v in zip(x, y, flow.y, -flow.x):
            exact = stored(a, b)
            self.assertAlmostEqual(u, exact[0], delta=2e-5)
            self.assertAlmostEqual(v, exact[1], delta=2e-5)

    def test_flat_lid(self):
        """From 24 to 32 polynomials 4e-4 is left, of third order at least: twice that in all."""
        for error in self.profiles(100, 24):
            self.assertLess(error, 8e-4)

    def test_published_table(self):
        """40 polynomials: measured 1.6e-3, 5.8e-4 and 1.2e-4; with 64 it is 7e-5."""
        for error, bound in zip(self.profiles(1000, 40), (2e-3, 1e-3, 3e-4)):
            self.assertLess(error, bound)


if __name__ == "__main__":
    unittest.main(verbosity=2)
