#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""The exact flows that cavity, wave, ellipse and impact are compared with, against their equations and
against closed forms of limits; and how the tools measure, on fields that are known."""

import math
import unittest

import cavity
import ellipse
import impact
import wave

STEP = 1e-4    # of differences: a central one is off by STEP^2/6 times the third derivative


def slope(f, x, step=STEP):
    return (f(x + step) - f(x - step)) / (2 * step)


class Ellipse(unittest.TestCase):
    def test_closed_form(self):
        """a' = a A', area and energy; A'^2 (a^2 + b^2) is what it was at the start, 2."""
        for t in (0.3, 1.0, 2.0):
            now = ellipse.exact(t)
            rate = slope(lambda t: math.log(ellipse.exact(t)["a"]), t)
            self.assertAlmostEqual(now["a"] * now["b"], 1, delta=1e-12)
            self.assertAlmostEqual(rate**2 * (now["a"]**2 + now["b"]**2), 2, delta=1e-7)
            self.assertAlmostEqual(now["p"], rate**2 / (now["a"]**2 + now["b"]**2), delta=1e-8)

    def test_momentum(self):
        """Along x: A' + A^2 = 2 p/a^2, along y: -A' + A^2 = 2 p/b^2, with the rate A."""
        def rate(t):
            return slope(ellipse.strain, t)
        for t in (0.3, 1.0, 2.0):
            now = ellipse.exact(t)
            for axis, sign in (("a", 1), ("b", -1)):
                self.assertAlmostEqual(sign * slope(rate, t, 1e-3) + rate(t)**2,
                                       2 * now["p"] / now[axis]**2, delta=1e-5)

    def test_known_values(self):
        """At A t = 1, as an integration of the equations of motion gives them."""
        now = ellipse.exact(1.0)
        for name, value in (("a", 2.275516), ("b", 0.4394608), ("p", 0.0693272)):
            self.assertAlmostEqual(now[name], value, delta=1e-6)

    def test_shape(self):
        """Of a lattice cut to an ellipse. The steps of its edge are the error: the area is right to a
        part of the edge of d/8, the semi-axes as the area."""
        d, a, b = 0.05, 1.5, 0.7
        n = math.ceil(a / d)
        rows = [{"x": (i + 0.5) * d, "y": (j + 0.5) * d} for i in range(-n, n) for j in range(-n, n)
                if (((i + 0.5) * d) / a)**2 + (((j + 0.5) * d) / b)**2 < 1]
        area, along, across = ellipse.shape(rows, d)
        self.assertAlmostEqual(area / (math.pi * a * b), 1, delta=0.125 * d / b)
        self.assertAlmostEqual(along / a, 1, delta=0.125 * d / b)
        self.assertAlmostEqual(across / b, 1, delta=0.125 * d / b)


class Wave(unittest.TestCase):
    def test_small_viscosity(self):
        """gamma = 2 nu k^2 (1 - sqrt(e/2)) + O(e), e = nu k^2/omega, for a deep tank."""
        for nu in (1e-5, 1e-4):
            deep = wave.Wave(1.0, 5.0, 0.0, 1.0, nu)
            small = nu * deep.k**2 / deep.omega0
            self.assertAlmostEqual(deep.gamma / (2 * nu * deep.k**2), 1 - math.sqrt(small / 2),
                                   delta=3 * small)

    def test_dispersion_of_infinite_depth(self):
        """(s + 2 nu k^2)^2 + g k = 4 nu^2 k^3 m: Lamb 349."""
        deep = wave.Wave(1.0, 5.0, 0.0, 1.0, 0.005)
        s = complex(-deep.gamma, deep.omega)
        m = (deep.k**2 + s / deep.nu)**0.5
        left = (s + 2 * deep.nu * deep.k**2)**2 + deep.k
        self.assertAlmostEqual(abs(left - 4 * deep.nu**2 * deep.k**3 * m), 0, delta=1e-9)

    def test_finite_amplitude(self):
        """Infinite depth: 1 - (kA)^2/8. No change at kH = 1.058."""
        self.assertAlmostEqual(wave.weakly_nonlinear(20.0, 0.1), 1 - 0.01 / 8, delta=1e-12)
        self.assertAlmostEqual(wave.weakly_nonlinear(1.0581, 0.1), 1, delta=1e-6)

    def test_measures(self):
        """Of the mode itself: what went in comes out, to the end of the search, 1e-6 omega."""
        exact = wave.Wave(1.0, 1.0, 0.02, 1.0, 0.002)
        times = [0.01 * k for k in range(3900)]
        series = {"t": times, "c": [math.exp(-0.03 * t) * math.cos(1.75 * t) for t in times]}
        omega, gamma = wave.fitted(series, exact)
        self.assertAlmostEqual(omega, 1.75, delta=1e-5)
        self.assertAlmostEqual(gamma, 0.03, delta=1e-5)
        # over a period the decay changes by exp(-0.1): its cosine by a third of that
        ratio = wave.strength(series, 35.4, 39.0) / wave.strength(series, 0.0, 3.6)
        self.assertAlmostEqual(ratio / math.exp(-0.03 * 35.4), 1, delta=0.03)
        lines = list(wave.result_lines(series, exact))
        self.assertEqual(len(lines), 3)
        self.assertIn("quantity=decay time=38.99 value=0.03 reference=0.03652", lines[1])


class Impact(unittest.TestCase):
    def test_walls_and_surfaces(self):
        """dP/dn = -1 on the wall, from slopes at two distances in a straight line to it; P = 0 on the
        surfaces, no slope at the floor."""
        def on_wall(f):
            return 2 * slope(f, 0.02) - slope(f, 0.04)    # off by 0.02^2 P_xxx, 25 at most here
        for at in (0.2, 0.5, 0.8):
            self.assertAlmostEqual(on_wall(lambda x, y=at: impact.plate(x, y)), -1, delta=0.01)
            self.assertAlmostEqual(on_wall(lambda y, x=at: impact.patch(x, y, 1.0)), -1, delta=0.01)
            self.assertAlmostEqual(impact.plate(at, 1.0), 0, delta=1e-12)
            self.assertAlmostEqual(slope(lambda y, x=at: impact.plate(x, y), 0.0), 0, delta=1e-6)
            self.assertAlmostEqual(impact.patch(at, 1.0, 1.0), 0, delta=1e-12)
            self.assertAlmostEqual(impact.patch(0.0, at, 1.0), 0, delta=1e-12)

    def test_inside(self):
        """lap P = 0, by second differences."""
        h = 1e-3
        for f in (impact.plate, lambda x, y: impact.patch(x, y, 1.0)):
            lap = (f(0.3 + h, 0.4) + f(0.3 - h, 0.4) + f(0.3, 0.4 + h) + f(0.3, 0.4 - h)
                   - 4 * f(0.3, 0.4)) / h**2
            self.assertAlmostEqual(lap, 0, delta=1e-4)

    def test_impulse(self):
        """The sums are the integrals of P over the wall (midpoint rule), and 14 zeta(3)/pi^3."""
        cells = [(k + 0.5) / 400 for k in range(400)]
        self.assertAlmostEqual(sum(impact.plate(0.0, s) for s in cells) / 400,
                               impact.impulse("plate", 1.0), delta=2e-5)
        self.assertAlmostEqual(sum(impact.patch(s, 0.0, 1.0) for s in cells) / 400,
                               impact.impulse("patch", 1.0), delta=2e-5)
        self.assertAlmostEqual(impact.impulse("plate", 1.0), 14 * 1.2020569 / math.pi**3, delta=1e-6)
        self.assertAlmostEqual(impact.impulse("patch", 1.0), 0.270415, delta=1e-6)


def lattice(n, f):
    """Rows of a dump with walls: f(x, y) in all columns."""
    return [{"x": i / n, "y": j / n, "vx": f(i / n, j / n), "vy": f(i / n, j / n),
             "d_aleisph_p": f(i / n, j / n), "type": 1} for i in range(n + 1) for j in range(n + 1)]


class Cavity(unittest.TestCase):
    def test_interpolation_is_exact_for_cubics(self):
        def f(x, y):
            return 1 - 2 * x + 3 * y * x - x**3 + 2 * x * y**2 - 5 * y**3
        field = cavity.Interpolation(lattice(12, f))
        for x, y in ((0.5, 0.0547), (0.31, 0.77), (0.9766, 0.5)):
            self.assertAlmostEqual(field(x, y, ("vx",))[0], f(x, y), delta=1e-9)

    def test_interpolation_between_particles(self):
        """sin(pi x): a cubic through points d apart is off by less than (pi d)^4/24."""
        field = cavity.Interpolation(lattice(20, lambda x, y: math.sin(math.pi * x)))
        for x in (0.51, 0.525, 0.9766):
            self.assertAlmostEqual(field(x, 0.5, ("vx",))[0], math.sin(math.pi * x),
                                   delta=(math.pi / 20)**4 / 24)
        self.assertAlmostEqual(field(0.55, 0.5, ("vx",))[0], math.sin(math.pi * 0.55), delta=1e-6)

    def test_smooth_lid_on_the_walls(self):
        exact = cavity.SmoothLid()
        for s in (0.1, 0.45, 0.8):
            u, v, _ = exact(s, 1.0)
            self.assertAlmostEqual(u, 16 * s**2 * (1 - s)**2, delta=1e-8)
            self.assertAlmostEqual(v, 0, delta=1e-8)
            for x, y in ((s, 0.0), (0.0, s), (1.0, s)):
                self.assertAlmostEqual(math.hypot(*exact(x, y)[:2]), 0, delta=1e-8)

    def test_smooth_lid_inside(self):
        """Continuity and both components of the steady momentum equation, by differences."""
        exact = cavity.SmoothLid()
        h, nu = 1e-3, 0.01
        for x, y in ((0.5, 0.5), (0.3, 0.8), (0.7, 0.2)):
            here = exact(x, y)
            dx = [(a - b) / (2 * h) for a, b in zip(exact(x + h, y), exact(x - h, y))]
            dy = [(a - b) / (2 * h) for a, b in zip(exact(x, y + h), exact(x, y - h))]
            lap = [(sum(f) - 4 * c) / h**2 for c, *f in zip(
                here, exact(x + h, y), exact(x - h, y), exact(x, y + h), exact(x, y - h))]
            self.assertAlmostEqual(dx[0] + dy[1], 0, delta=1e-4)
            for k, gradient in ((0, dx[2]), (1, dy[2])):
                rest = here[0] * dx[k] + here[1] * dy[k] + gradient - nu * lap[k]
                self.assertAlmostEqual(rest, 0, delta=1e-4)    # h^2/6 times third derivatives

    def test_tables(self):
        """Three, with 15 inner points on each line; the published finite differences agree with the
        spectral values to 0.01 U, but for the misprint."""
        for Re in (100, 400, 1000):
            for line, rows in cavity.tables(Re).items():
                self.assertEqual(len(rows), 15)
                for s, value, _, ghia in rows:
                    if ghia is not None and not (Re == 400 and s == 0.9063):
                        self.assertAlmostEqual(value, ghia, delta=0.01, msg=f"{Re} {line} {s}")
        with self.assertRaises(ValueError):
            cavity.tables(200)


if __name__ == "__main__":
    unittest.main(verbosity=2)
