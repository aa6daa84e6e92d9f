# SPDX-License-Identifier: GPL-2.0-only
"""Exact start-up profiles for plots, as series of eigenfunctions in exp(-k^2 tau), tau = nu t/H^2.

Written without a look at the package's own (aleisph_exact.cpp), so that a plot checks both. Use
them for tau > 0.002: earlier, more than the terms summed here would be needed.
"""

import numpy as np

TERMS = np.arange(60)


def bessel(n, x):
    """J_n by its integral over half a period; the trapezoidal rule converges exponentially."""
    t = (np.arange(400) + 0.5) * np.pi / 400
    return np.mean(np.cos(n * t - np.multiply.outer(x, np.sin(t))), axis=-1)


def bessel_zeros():
    """The first zeros of J_0: McMahon's guess, then Newton's method with J_0' = -J_1."""
    k = (TERMS + 0.75) * np.pi
    k = k + 1 / (8 * k)
    for _ in range(4):
        k = k + bessel(0, k) / bessel(1, k)
    return k


def pipe(r, t, R, G, nu):
    """Axial velocity at the distance r from the axis; start from rest under acceleration G."""
    s, k = r / R, bessel_zeros()
    decay = 8 / (k**3 * bessel(1, k)) * np.exp(-k**2 * nu * t / R**2)
    return G * R**2 / (4 * nu) * (1 - s**2 - bessel(0, np.multiply.outer(s, k)) @ decay)


def plane(y, t, H, G, nu):
    """Velocity between plates at y = -H and y = H; start from rest under acceleration G."""
    s, k = y / H, (TERMS + 0.5) * np.pi
    decay = 4 * (-1.0)**TERMS / k**3 * np.exp(-k**2 * nu * t / H**2)
    return G * H**2 / (2 * nu) * (1 - s**2 - np.cos(np.multiply.outer(s, k)) @ decay)


def couette(y, t, H, U, nu):
    """Velocity between a plate at rest at y = 0 and one that moves with U, at y = H."""
    s, k = y / H, (TERMS + 1) * np.pi
    decay = 2 * (-1.0)**TERMS / k * np.exp(-k**2 * nu * t / H**2)
    return U * (s - np.sin(np.multiply.outer(s, k)) @ decay)


PROFILES = {"pipe": pipe, "plane": plane, "couette": couette}
