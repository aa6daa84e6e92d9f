#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Exact start-up flow in a pipe, and the fit of its radius."""

import unittest

import numpy as np

import pipe


class StartUp(unittest.TestCase):
    def test_bessel_functions_and_their_zeros(self):
        # Abramowitz & Stegun, tables 9.1 and 9.5
        self.assertAlmostEqual(float(pipe.bessel(0, 1.0)), 0.7651976866, delta=1e-10)
        self.assertAlmostEqual(float(pipe.bessel(1, 5.0)), -0.3275791376, delta=1e-10)
        np.testing.assert_allclose(pipe.zeros(3), [2.4048255577, 5.5200781103, 8.6537279129],
                                   rtol=0, atol=1e-9)

    def test_rest_free_fall_and_steady_flow(self):
        r = np.array([0.0, 0.3, 0.9])
        # u = G t = 4 tau u_max away from the wall as long as its layer is thin
        np.testing.assert_allclose(pipe.start_up(r[:2], 0.005), 0.02, rtol=1e-4)
        np.testing.assert_allclose(pipe.start_up(r, 5.0), 1 - r**2, atol=4e-6)

    def test_solves_the_equation(self):
        # u_tau = 4 + u_rr + u_r/r by central differences, at radii that are not interpolated
        r, tau, h = 0.4, 0.1, 0.01

        def u(x, t):
            return float(pipe.start_up(x, t))
        left = (u(r, tau + h / 10) - u(r, tau - h / 10)) / (h / 5)
        right = 4 + (u(r + h, tau) - 2 * u(r, tau) + u(r - h, tau)) / h**2 \
            + (u(r + h, tau) - u(r - h, tau)) / (2 * h * r)
        # u_tau is about 2; the differences are off by its third derivatives, (k^2 h)^2/6 of it
        self.assertAlmostEqual(left, right, delta=5e-3)


class Radius(unittest.TestCase):
    def test_finds_the_radius_of_exact_profiles(self):
        R, G, nu = 5.0, 5e-4, 0.03
        r = np.linspace(0.2, 4.8, 24)
        u_max = G * 5.3**2 / (4 * nu)
        profiles = [(r, u_max * pipe.start_up(r / 5.3, nu * t / 5.3**2), t) for t in (160, 320)]
        self.assertAlmostEqual(pipe.fit_radius(profiles, R, G, nu), 0.3, delta=1e-4)
        self.assertGreater(pipe.l2(*profiles[1][:2], R, G, nu, 320), 0.02)

    def test_the_units_of_a_peer(self):
        setup = pipe.rheo(10)
        u_max = setup.force() * 5**2 / (4 * setup.nu())
        self.assertAlmostEqual(u_max, 0.1)
        self.assertAlmostEqual(u_max * 5 / setup.nu(), pipe.REYNOLDS)


if __name__ == "__main__":
    unittest.main()
