#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Oscillations of drops: linear theory; frequency and damping of a series. Standard library only.

oscillation.py PICTURE.png SERIES... --Oh OH [--dim 3] draws the amplitudes in files of
examples/capillary over linear theory (needs matplotlib; Debian: python3-matplotlib).

Linear theory of the mode n of a free drop, in units of rho, sigma and R, nu = Oh (H. Lamb,
Hydrodynamics, 1932, 349, for the method; S. Chandrasekhar, Hydrodynamic and Hydromagnetic
Stability, 1961, 98, for the ball). The flow with the time factor exp(s t) is a potential flow and a
vortical one. Its poloidal scalar, in 2d the stream function, is f = r^n + B b(q r), q^2 = s/nu,
with b a modified Bessel function I_n, in 3d the spherical one, normalised to b(q) = 1. At r = 1
  no shear stress      f'' - f' + n^2 f = 0 in 2d, f'' + (n (n + 1) - 2) f = 0 in 3d,
  pressure = tension   s^2/n + 2 nu s (f' - f) + k f = 0,  k = n^2 - 1, (n - 1)(n + 2).
The first gives B, the second s = -gamma +- i omega. For small nu, gamma is 2 n (n - 1) nu in 2d and
(n - 1)(2 n + 1) nu in 3d, less a share of order sqrt(nu).
"""

import argparse
import cmath
import math

from series import pyplot, read_series
from star import dot, least_squares


def stiffness(dim, n):
    """Change of the curvature of a circle or sphere with a deformation of the mode n."""
    return n * n - 1 if dim == 2 else (n - 1) * (n + 2)


def inviscid(dim, n, nu):
    """(omega, gamma) to leading order in nu."""
    rate = 2 * n * (n - 1) if dim == 2 else (n - 1) * (2 * n + 1)
    return math.sqrt(n * stiffness(dim, n)), rate * nu


def bessel_slope(dim, n, q):
    """q b'(q)/b(q), by backward recurrence of the ratio of two orders."""
    order = n + 0.5 * (dim - 2)
    ratio = 0.0
    for k in range(300, -1, -1):
        ratio = 1.0 / (2.0 * (order + k + 1) / q + ratio)
    return n + q * ratio


def boundary(dim, n, nu, s):
    """What is left of the second condition."""
    q = cmath.sqrt(s / nu)
    slope = bessel_slope(dim, n, q)
    if dim == 2:
        second = q * q + n * n - slope
        shear = [f2 - f1 + n * n for f1, f2 in ((n, n * (n - 1)), (slope, second))]
    else:
        second = q * q + n * (n + 1) - 2.0 * slope
        shear = [f2 + n * (n + 1) - 2 for f2 in (n * (n - 1), second)]
    B = -shear[0] / shear[1]
    f, f1 = 1.0 + B, n + B * slope
    return s * s / n + 2.0 * nu * s * (f1 - f) + stiffness(dim, n) * f


def viscous(dim, n, nu):
    """(omega, gamma), by the secant method from the leading order."""
    omega, gamma = inviscid(dim, n, nu)
    if nu == 0.0:
        return omega, 0.0
    last = complex(-gamma, omega)
    s = 1.001 * last
    rest = boundary(dim, n, nu, last)
    for _ in range(50):
        value = boundary(dim, n, nu, s)
        if abs(s - last) < 1e-12 or value == rest:
            break
        last, s, rest = s, s - value * (s - last) / (value - rest), value
    return s.imag, -s.real


def misfit(omega, gamma, times, values):
    """Sum of squares that the best exp(-gamma t) (a cos omega t + b sin omega t) + c + e t leaves.
    The mean drifts by 1e-3 R as the particles of a drop, in 3d above all, find their places."""
    if -gamma * times[-1] > 300.0:    # growth that no run shows, near the end of what exp() can
        return math.inf
    decay = [math.exp(-gamma * t) for t in times]
    columns = [[e * math.cos(omega * t) for e, t in zip(decay, times)],
               [e * math.sin(omega * t) for e, t in zip(decay, times)], [1.0] * len(times), times]
    best = least_squares(columns, values)
    rest = [y - dot(best, row) for y, row in zip(values, zip(*columns))]
    return dot(rest, rest)


def fit(times, values, omega, gamma):
    """(omega, gamma, relative rms of what is left); omega and gamma given: where to begin.

    Search over the neighbors of a point in the plane, with steps that are halved when none is
    better.
    """
    if len(times) < 6 or not all(map(math.isfinite, values)):
        raise ValueError("the series of the amplitude has fewer than six values, or some not finite")
    step = [0.1 * omega, 0.1 * omega]
    point = [omega, gamma]
    least = misfit(*point, times, values)
    while step[0] > 1e-6 * omega:
        better = False
        for k in (0, 1):
            for sign in (1, -1):
                other = point[:]
                other[k] += sign * step[k]
                rest = misfit(*other, times, values)
                if rest < least:
                    point, least, better = other, rest, True
        if not better:
            step = [0.5 * s for s in step]
    return point[0], point[1], math.sqrt(least / dot(values, values))


def plot(picture, paths, dim, nu):
    plt = pyplot()
    omega, gamma = viscous(dim, 2, nu)
    figure, axes = plt.subplots(figsize=(7, 3.6), constrained_layout=True)
    for path in paths:
        series = read_series(path)
        axes.plot(series["t"], series["a"], label=path)
    t = series["t"]
    axes.plot(t, [series["a"][0] * math.exp(-gamma * x) * math.cos(omega * x) for x in t], "k--",
              linewidth=1, label="linear theory")
    axes.set(xlabel="t/sqrt(rho R^3/sigma)", ylabel="amplitude/R", xlim=(0, t[-1]))
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8)
    figure.savefig(picture, dpi=80)


def main():
    parser = argparse.ArgumentParser(description="Draws amplitudes of drops over linear theory")
    parser.add_argument("picture")
    parser.add_argument("series", nargs="+")
    parser.add_argument("--dim", type=int, default=2, choices=(2, 3))
    parser.add_argument("--Oh", type=float, required=True)
    options = parser.parse_args()
    plot(options.picture, options.series, options.dim, options.Oh)


if __name__ == "__main__":
    main()
