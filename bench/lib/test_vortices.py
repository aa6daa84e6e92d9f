#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Taylor-Green vortices in units of d and cs: exact solution, error, time steps."""

import math
import unittest

import numpy as np

import vortices


class Vortices(unittest.TestCase):
    n, mach, nu = 32, 0.1, 0.032

    def snapshot(self, t, factor=1.0):
        x, y = np.random.default_rng(1).uniform(0, self.n, (2, 200))
        u, v = vortices.exact(x, y, self.n, self.mach, self.nu, t)
        return x, y, factor * u, factor * v

    def test_decays_with_the_rate_of_its_wave(self):
        u0, u1 = (vortices.exact(8.0, 0.0, 32, 0.1, self.nu, t)[0] for t in (0.0, 100.0))
        self.assertAlmostEqual(u0, 0.1)
        self.assertAlmostEqual(u1 / u0, math.exp(-2 * self.nu * (2 * math.pi / 32)**2 * 100))

    def test_error_is_relative_and_zero_when_exact(self):
        for factor, error in ((1.0, 0.0), (0.9, 0.1)):
            found = vortices.l2(self.snapshot(50.0, factor), self.n, self.mach, self.nu, 50.0)
            self.assertAlmostEqual(found, error)

    def test_steps_end_at_the_times_of_comparison(self):
        setup = vortices.rheo("tuned", 64, 0.2, 0.2, 0.1, 0.1)
        self.assertEqual(setup.steps(), [400, 1600])    # t U/L = steps dt mach/n
        self.assertAlmostEqual(setup.mach * setup.n / setup.nu(), vortices.REYNOLDS)


if __name__ == "__main__":
    unittest.main()
