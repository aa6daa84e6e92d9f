#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Area and edge of shapes that are known."""

import unittest

import numpy as np

import shape


def lattice(columns, rows, d):
    x, y = np.meshgrid(np.arange(columns), np.arange(rows), indexing="ij")
    return d * np.column_stack([x.ravel(), y.ravel()]).astype(float)


class Blocks(unittest.TestCase):
    d = 0.1

    def test_area_and_edge_of_a_block(self):
        found = shape.measure(lattice(20, 10, self.d), [], self.d)
        # The line 1/2 lies half a spacing outside the last particles, but for the corners, which
        # it rounds: at a corner of the square the sum is 1/4. A round of radius r there takes
        # (1 - pi/4) r^2 of the area and (2 - pi/2) r of the edge each, with r up to the support.
        r = 2.4 * self.d
        self.assertLess(found.area, 2.0 + 0.01)
        self.assertGreater(found.area, 2.0 - 4 * (1 - np.pi / 4) * r**2)
        self.assertLess(found.edge, 6.0 + 0.06)
        self.assertGreater(found.edge, 6.0 - 4 * (2 - np.pi / 2) * r)
        self.assertFalse(found.spray.any())

    def test_walls_close_the_region(self):
        """A tank filled to a height: walls at x = 0, x = 2 and y = 0, fluid inside."""
        d, n, rows = self.d, 20, 8
        everything = lattice(n + 1, n + 1, d)
        x, y = np.rint(everything / d).astype(int).T
        wall = (x == 0) | (x == n) | (y == 0)
        fluid = ~wall & (y <= rows)
        found = shape.measure(everything[fluid], everything[wall], d, ((0, n * d), (0, n * d)))
        # The volume of its particles. Walls reach a row higher than the fluid: the edge turns up
        # there, by less than 2 d each.
        self.assertAlmostEqual(found.area, fluid.sum() * d * d, delta=2 * 2 * d * d)
        self.assertAlmostEqual(found.edge, n * d, delta=2 * d)

    def test_a_particle_alone_is_spray(self):
        fluid = np.vstack([lattice(20, 10, self.d), [[3.0, 3.0]]])
        found = shape.measure(fluid, [], self.d)
        self.assertEqual(list(np.flatnonzero(found.spray)), [200])
        alone = shape.measure(fluid[:200], [], self.d)
        self.assertAlmostEqual(found.area - alone.area, self.d**2)


if __name__ == "__main__":
    unittest.main()
