#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""The tools that measure drops, on shapes and oscillations that are known."""

import argparse
import math
import random
import unittest

import drops
import oscillation
import sloshing
from star import Star, dot

ROUND = 1e-9    # of sums of a few hundred numbers of order one


def directions(dim, count, seed=1):
    source = random.Random(seed)
    for _ in range(count):
        p = [source.gauss(0.0, 1.0) for _ in range(dim)]
        yield [a / math.sqrt(dot(p, p)) for a in p]


class Outlines(unittest.TestCase):
    def test_disc_and_ball(self):
        for dim, volume, area in ((2, math.pi, 2 * math.pi), (3, 4 / 3 * math.pi, 4 * math.pi)):
            star = Star(dim, 4)
            fit, inner = star.fit([[2.0 * a for a in u] for u in directions(dim, 200)], 0.1)
            self.assertEqual(inner, 0)
            self.assertAlmostEqual(star.measures(fit)[0] / (volume * 2**dim), 1, delta=ROUND)
            self.assertAlmostEqual(star.measures(fit)[1] / (area * 2**(dim - 1)), 1, delta=ROUND)

    def test_single_harmonic(self):
        """r = 1 + e P_2(cos theta): V = 4 pi/3 (1 + 3 e^2/5 + 2 e^3/35), by the integrals of powers
        of P_2 over the sphere, 4 pi/5 and 8 pi/35. The midpoint rule over 32 rows in z is off by
        (1/16)^2/24 of the difference of the slopes of r^3/3 at the poles, 6 e (1 + e)^2, of 2/3."""
        e, star = 0.1, Star(3, 4)
        points = [[(1 + e * (1.5 * u[2]**2 - 0.5)) * a for a in u] for u in directions(3, 300)]
        volume = star.measures(star.fit(points, 0.1)[0])[0]
        exact = 4 / 3 * math.pi * (1 + 0.6 * e**2 + 2 / 35 * e**3)
        self.assertAlmostEqual(volume / exact, 1, delta=1.8e-3 * e)

    def test_inner_points_are_left_out(self):
        star = Star(2, 4)
        points = list(directions(2, 100))
        points[17] = [0.3 * a for a in points[17]]
        fit, inner = star.fit(points, 0.5)
        self.assertEqual(inner, 1)
        self.assertAlmostEqual(star.measures(fit)[0] / math.pi, 1, delta=ROUND)


class Drops(unittest.TestCase):
    """A square lattice cut to a disc: d = 1, so that the numerical density is 1.01 at most off."""

    def setUp(self):
        places = [(i, j) for i in range(-8, 9) for j in range(-8, 9) if math.hypot(i, j) < 8]
        on = [math.hypot(*p) > 7 for p in places]
        normal = [(p[0] / math.hypot(*p), p[1] / math.hypot(*p)) if s else (0, 0)
                  for p, s in zip(places, on)]
        columns = {"x": [p[0] + 5.0 for p in places], "y": [p[1] for p in places],
                   "surface": on, "nx": [n[0] for n in normal], "ny": [n[1] for n in normal],
                   "vx": [3.0] * len(places), "vy": [4.0] * len(places),
                   "d_aleisph_p": [7.0 if math.hypot(*p) < 4 else 1.0 for p in places]}
        self.count = len(places)
        self.drop = drops.Drop(columns, 2, 1.0)

    def test_measures(self):
        self.assertAlmostEqual(self.drop.R, math.sqrt(self.count / math.pi), delta=ROUND)
        self.assertEqual(self.drop.pressure(7.0)[0], 7.0)    # deeper than 3 d below 7 d
        self.assertEqual(set(self.drop.speeds()), {5.0})
        # the sum of the cubic spline, h = 1.2 d, over the square lattice is 1 within 1e-3
        self.assertAlmostEqual(self.drop.density(7.0), 1, delta=1e-3)
        self.assertTrue(all(7.5 < r < 8.5 for r in self.drop.radii()))

    def test_rise(self):
        self.assertAlmostEqual(drops.largest_rise([3.0, 2.0, 2.5, 1.0, 1.2]), 0.5, delta=ROUND)
        self.assertEqual(drops.largest_rise([3.0, 2.0, 1.0]), 0.0)


class Theory(unittest.TestCase):
    def test_known_limits(self):
        """Rayleigh's frequencies, and the damping of potential flow for small viscosity, from
        which boundary layers take off a share of order sqrt(nu) = 1e-4."""
        for dim, square, rate in ((2, 6, 4), (3, 8, 5)):
            nu = 1e-8
            omega, gamma = oscillation.viscous(dim, 2, nu)
            self.assertAlmostEqual(omega**2 / square, 1, delta=1e-7)
            self.assertAlmostEqual(gamma / (rate * nu), 1, delta=1e-3)

    def test_translation_has_no_frequency(self):
        for dim in (2, 3):
            self.assertEqual(oscillation.inviscid(dim, 1, 0.1), (0.0, 0.0))

    def test_very_viscous_drop_creeps(self):
        """A ball of large viscosity relaxes at the rate n (n + 2)(2 n + 1)/(2 (2 n^2 + 4 n + 3))/nu
        = 20/(19 nu) for n = 2 (creeping flow); inertia adds terms of order 1/nu^2. The residual
        must vanish there and nowhere near."""
        nu = 200.0
        low, at, high = (abs(oscillation.boundary(3, 2, nu, complex(-f * 20 / 19 / nu)))
                         for f in (0.9, 1.0, 1.1))
        self.assertLess(at, 1e-3 * min(low, high))

    def test_fit(self):
        times = [0.02 * k for k in range(400)]
        values = [0.05 * math.exp(-0.08 * t) * math.cos(2.5 * t + 0.1) + 0.001 for t in times]
        omega, gamma, rest = oscillation.fit(times, values, 2.4, 0.1)
        # the search ends with steps of 1e-6 omega
        self.assertAlmostEqual(omega, 2.5, delta=1e-5)
        self.assertAlmostEqual(gamma, 0.08, delta=1e-5)
        self.assertLess(rest, 1e-4)


class Sway(unittest.TestCase):
    def test_frequency_of_a_series(self):
        """That of the theory with natural frequencies 0.7 % too high; the interval ends at 1e-4."""
        tank = argparse.Namespace(L=1.0, H=0.5, A=0.002, omega=3.7, g=9.81)
        times = [0.02 * k for k in range(300)]
        series = {"t": times, **{name: [sloshing.elevation(xi, t, tank, 1.007) for t in times]
                                 for name, xi in (("eta0", 0.0), ("etaL", 1.0))}}
        self.assertAlmostEqual(sloshing.frequency(series, tank), 1.007, delta=1e-4)


if __name__ == "__main__":
    unittest.main(verbosity=2)
