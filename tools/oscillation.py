# SPDX-License-Identifier: GPL-2.0-only
"""Oscillations of drops: linear theory, and frequency and damping of a series. Standard library only.

Linear theory of the mode n of a free drop, in units of rho, sigma and R, nu = Oh (2d disc: Lamb,
Hydrodynamics, 349 for the method; ball: Chandrasekhar, Hydrodynamic and hydromagnetic stability,
98). The flow with time factor exp(s t) is a potential flow r^n and a vortical one; the poloidal
scalar (stream function in 2d) is f = r^n + B b(q r), q^2 = s/nu, with b a modified Bessel function
I_n, in 3d the spherical one, normalised to b(q) = 1. With f', f'' at r = 1, on which
  no shear stress      2d: f'' - f' + n^2 f = 0,  3d: f'' + (n (n + 1) - 2) f = 0
  pressure of tension  2d: -s^2/n  - 2 nu s (f' - f) = (n^2 - 1) n f,   2d terms over n
                       3d: -s^2/n - 2 nu s (f' - f) = (n - 1) (n + 2) f
hold, the second an equation for s = -gamma +- i omega. For small nu: gamma = 2 n (n - 1) nu in 2d and
(n - 1)(2 n + 1) nu in 3d, less a share of order sqrt(nu).
"""

import math

from star import dot, least_squares


def misfit(omega, gamma, times, values):
    """Sum of squares that the best a, b, c leave, and those."""
    decay = [math.exp(-gamma * t) for t in times]
    columns = [[e * math.cos(omega * t) for e, t in zip(decay, times)],
               [e * math.sin(omega * t) for e, t in zip(decay, times)], [1.0] * len(times)]
    best = least_squares(columns, values)
    rest = [y - dot(best, row) for y, row in zip(values, zip(*columns))]
    return dot(rest, rest), best


def fit(times, values, omega, gamma):
    """(omega, gamma, relative rms of what is left); omega and gamma given: where to begin.

    Search over the neighbors of a point in the plane, with steps that are halved when none is
    better.
    """
    step = [0.1 * omega, 0.1 * omega]
    point = [omega, gamma]
    least = misfit(*point, times, values)[0]
    while step[0] > 1e-6 * omega:
        better = False
        for k in (0, 1):
            for sign in (1, -1):
                other = point[:]
                other[k] += sign * step[k]
                rest = misfit(*other, times, values)[0]
                if rest < least:
                    point, least, better = other, rest, True
        if not better:
            step = [0.5 * s for s in step]
    return point[0], point[1], math.sqrt(least / dot(values, values))
