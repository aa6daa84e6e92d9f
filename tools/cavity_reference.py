#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Spectral solution of the lid-driven cavity: cavity_reference.py --write FOLDER | --lid LID --Re RE

Steady flow in the unit square, the lid y = 1 slides with u = 1 (flat) or 16 x^2 (1 - x)^2 (smooth).
Stream function psi, u = psi_y, v = -psi_x, vorticity w = -lap psi, u.grad w = nu lap w. psi is a part
that obeys all boundary conditions plus a sum of products of Legendre polynomials that vanish on the
walls with their slopes (J. Shen, SIAM J. Sci. Comput. 15, 1489, 1994), found by collocation at the
zeros of P_{n+2}'' and Newton's method.
  smooth: 16 x^2 (1 - x)^2 (y^3 - y^2).
  flat: velocity jumps at the ends of the lid. The Stokes flow of a corner with one sliding wall, psi =
        r f(theta), is taken off at both ends (as by O. Botella, R. Peyret, Comput. Fluids 27, 421,
        1998), and what these two leave on the walls is lifted by a Hermite-Coons patch.
The pressure follows from the momentum equation, by integration of grad p. p = 0 at the centre.

--write makes anew cavity_smooth_lid.csv (the field as a Chebyshev series) and cavity_flat_lid.csv
(centre lines), both read by cavity.py, in a minute and a half. Without it values of one flow are printed
for growing n. Needs numpy (Debian: python3-numpy).
"""

import argparse
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.polynomial import Polynomial
from numpy.polynomial import chebyshev as cheb
from numpy.polynomial import legendre as leg

START = (100.0, 400.0, 1000.0)    # Reynolds numbers on the way to a larger one
FINE = {"smooth": 48, "flat": 64}
SMALL = 1e-10                     # terms of a series that are not stored: effect on u, v and p
# points of the tables of U. Ghia, K. N. Ghia, C. T. Shin, J. Comput. Phys. 48, 387 (1982)
GHIA_Y = (0.0, 0.0547, 0.0625, 0.0703, 0.1016, 0.1719, 0.2813, 0.4531, 0.5, 0.6172, 0.7344, 0.8516,
          0.9531, 0.9609, 0.9688, 0.9766, 1.0)
GHIA_X = (0.0, 0.0625, 0.0703, 0.0781, 0.0938, 0.1563, 0.2266, 0.2344, 0.5, 0.8047, 0.8594, 0.9063,
          0.9453, 0.9531, 0.9609, 0.9688, 1.0)
GHIA = {    # u(1/2, y) and v(x, 1/2). * is a misprint of the table: its neighbours are smooth without
    100: ((0, -.03717, -.04192, -.04775, -.06434, -.10150, -.15662, -.21090, -.20581, -.13641,
           .00332, .23151, .68717, .73722, .78871, .84123, 1),
          (0, .09233, .10091, .10890, .12317, .16077, .17507, .17527, .05454, -.24533, -.22445,
           -.16914, -.10313, -.08864, -.07391, -.05906, 0)),
    400: ((0, -.08186, -.09266, -.10338, -.14612, -.24299, -.32726, -.17119, -.11477, .02135,
           .16256, .29093, .55892, .61756, .68439, .75837, 1),
          (0, .18360, .19713, .20920, .22965, .28124, .30203, .30174, .05186, -.38598, -.44993,
           -.23827, -.22847, -.19254, -.15663, -.12146, 0)),    # * -.23827
}


# --- polynomials ------------------------------------------------------------------------------------

def clamped(n):
    """Legendre coefficients of n polynomials that vanish at both ends with their slopes."""
    c = np.zeros((n, n + 4))
    for k in range(n):
        c[k, k], c[k, k + 2], c[k, k + 4] = 1, -2 * (2*k + 5) / (2*k + 7), (2*k + 3) / (2*k + 7)
        c[k] /= math.sqrt(2 * (2*k + 3)**2 * (2*k + 5))
    return c


def values(n, x):
    """[derivative][point, polynomial] on [0, 1], to the fourth."""
    rows = clamped(n)
    return [np.stack([leg.legval(2 * x - 1, leg.legder(row, m) * 2.0**m if m else row)
                      for row in rows], axis=1) for m in range(5)]


def points(n):
    """Zeros of P_{n+2}'', in [0, 1]."""
    return 0.5 * (np.sort(leg.legroots(leg.legder([0.0] * (n + 2) + [1.0], 2))) + 1)


def derivative(f, k):
    return f.deriv(k) if k else f


# --- parts of psi -----------------------------------------------------------------------------------

@dataclass
class Flow:
    """Derivatives of psi at points, or of many psi (one per column); w = -lap psi, wlap = lap w."""
    x: np.ndarray
    y: np.ndarray
    xx: np.ndarray
    xy: np.ndarray
    yy: np.ndarray
    wx: np.ndarray
    wy: np.ndarray
    wlap: np.ndarray

    def __add__(self, other):
        return Flow(*[a + b for a, b in zip(vars(self).values(), vars(other).values())])

    def times(self, c):
        return Flow(*[a @ c for a in vars(self).values()])


def flow_of(d):
    """d(a, b): derivative of psi, a times by x and b times by y."""
    return Flow(d(1, 0), d(0, 1), d(2, 0), d(1, 1), d(0, 2), -(d(3, 0) + d(1, 2)),
                -(d(2, 1) + d(0, 3)), -(d(4, 0) + 2 * d(2, 2) + d(0, 4)))


class SmoothLid:
    """The part of psi that has the velocity of the lid."""
    along, across = Polynomial([0, 0, 16, -32, 16]), Polynomial([0, 0, -1, 1])

    def d(self, a, b, x, y):
        return derivative(self.along, a)(x) * derivative(self.across, b)(y)

    def flow(self, x, y):
        return flow_of(lambda a, b: self.d(a, b, x, y))


def corner(x, y):
    """Stokes flow at the end (0, 1) of a lid with velocity 1 next to a wall at rest: with X = x, Y =
    1 - y, psi = B Y + theta (C X + D Y); psi_y = 1 at theta = 0, psi_x = psi_y = 0 at pi/2."""
    C = 1 / (math.pi**2 / 4 - 1)
    D, B = C * math.pi / 2, -C * math.pi**2 / 4
    X, Y = x, 1 - y
    r2, theta, q = X * X + Y * Y, np.arctan2(Y, X), C * X + D * Y
    tX, tY = -Y / r2, X / r2
    tXX, tXY = 2 * X * Y / r2**2, (Y * Y - X * X) / r2**2
    curl = D * X - C * Y                                     # lap psi = 2 curl/r^2
    wX, wY = (-2 * (slope - 2 * curl * Z / r2) / r2 for slope, Z in ((D, X), (-C, Y)))
    psi = B * Y + theta * q
    return psi, Flow(tX * q + theta * C, -(B + tY * q + theta * D), tXX * q + 2 * tX * C,
                     -(tXY * q + tX * D + tY * C), -tXX * q + 2 * tY * D, wX, -wY, 0 * x)


def mirrored(x, y):
    """corner() at the end (1, 1)."""
    psi, f = corner(1 - x, y)
    return psi, Flow(-f.x, f.y, f.xx, -f.xy, f.yy, -f.wx, f.wy, f.wlap)


class FlatLid:
    """The two corners, and what takes their values and slopes off the walls."""
    ends = [Polynomial(c) for c in ((1, 0, -3, 2), (0, 0, 3, -2), (0, 1, -2, 1), (0, 0, -1, 1))]

    def __init__(self, degree=60):
        t = 0.5 * (np.cos(np.pi * (np.arange(degree) + 0.5) / degree) + 1)
        zero, one = 0 * t, np.ones(degree)

        def fit(f):
            return cheb.Chebyshev.fit(t, f, degree - 1, domain=[0, 1])
        (r, rf), (s, sf) = mirrored(zero, t), corner(one, t)
        (a, af), (b, bf) = corner(t, zero), mirrored(t, zero)
        # value at 0 and 1, slope at 0 and 1: of x, as functions of y, and of y
        self.of_x = [fit(-r), fit(-s), fit(-rf.x), fit(-sf.x)]
        self.of_y = [fit(-a - b), fit(zero), fit(-af.y - bf.y), fit(-one)]
        self.twist = [[f(0.0), f(1.0), f.deriv()(0.0), f.deriv()(1.0)] for f in self.of_x]

    def d(self, a, b, x, y):
        """Of the Hermite-Coons patch."""
        hx = [derivative(h, a)(x) for h in self.ends]
        hy = [derivative(h, b)(y) for h in self.ends]
        return (sum(h * derivative(f, b)(y) for h, f in zip(hx, self.of_x))
                + sum(h * derivative(f, a)(x) for h, f in zip(hy, self.of_y))
                - sum(self.twist[i][j] * hx[i] * hy[j] for i in range(4) for j in range(4)))

    def flow(self, x, y):
        return (flow_of(lambda a, b: self.d(a, b, x, y)) + corner(x, y)[1] + mirrored(x, y)[1])


LIDS = {"smooth": SmoothLid, "flat": FlatLid}


# --- solution ---------------------------------------------------------------------------------------

class Cavity:
    def __init__(self, lid, n, Re):
        self.lid, self.n, self.nu = LIDS[lid](), n, 1 / Re
        self.c = np.zeros(n * n)
        self.solve([r for r in START if r < Re] + [Re])

    def solve(self, steps):
        p = points(self.n)
        B = values(self.n, p)
        lid = self.lid.flow(*(a.ravel() for a in np.meshgrid(p, p, indexing="ij")))
        free = flow_of(lambda a, b: np.kron(B[a], B[b]))
        for Re in steps:
            for _ in range(30):
                f = lid + free.times(self.c)
                rest = f.y * f.wx - f.x * f.wy - f.wlap / Re
                slope = (f.y[:, None] * free.wx - f.x[:, None] * free.wy + f.wx[:, None] * free.y
                         - f.wy[:, None] * free.x - free.wlap / Re)
                change = np.linalg.solve(slope, -rest)
                self.c += change
                if np.abs(change).max() < 1e-10 * np.abs(self.c).max():
                    break
            else:
                raise RuntimeError(f"Newton's method does not converge at Re = {Re}")

    def derivative(self, a, b, x, y):
        """Of psi without the part of the lid."""
        bx, by = values(self.n, x)[a], values(self.n, y)[b]
        return np.einsum("ik,kl,il->i", bx, self.c.reshape(self.n, self.n), by)

    def flow(self, x, y):
        """At points off the corners."""
        return self.lid.flow(x, y) + flow_of(lambda a, b: self.derivative(a, b, x, y))

    def momentum(self, x, y):
        """grad p"""
        f = self.flow(x, y)
        return (-f.y * f.xy + f.x * f.yy - self.nu * f.wy, f.y * f.xx - f.x * f.xy + self.nu * f.wx)

    def lines(self, y, x, degree=80):
        """u and p at (1/2, y), v and p at (x, 1/2)."""
        t = 0.5 * (np.cos(np.pi * (np.arange(degree) + 0.5) / degree) + 1)
        half = np.full(degree, 0.5)
        up, along = (cheb.Chebyshev.fit(t, g, degree - 1, domain=[0, 1]).integ(1, lbnd=0.5) for g in
                     (self.momentum(half, t)[1], self.momentum(t, half)[0]))
        return (self.flow(0 * y + 0.5, y).y, up(y), -self.flow(x, 0 * x + 0.5).x, along(x))

    def series(self):
        """Chebyshev coefficients of psi and p on [0, 1]^2: for a lid whose part is a polynomial."""
        size = 2 * self.n + 8    # products of two polynomials of degree n + 3
        g = np.cos(np.pi * (np.arange(size) + 0.5) / size)
        x, y = (0.5 * (a.ravel() + 1) for a in np.meshgrid(g, g, indexing="ij"))

        def coefficients(f):
            T = cheb.chebvander(g, size - 1) * (2.0 / size)
            T[:, 0] /= 2
            return T.T @ f.reshape(size, size) @ T
        psi = coefficients(self.derivative(0, 0, x, y) + self.lid.d(0, 0, x, y))
        px, py = (coefficients(f) for f in self.momentum(x, y))
        p = cheb.chebint(px, axis=0, lbnd=0, scl=0.5)
        middle = cheb.chebval(0.0, py)                       # p_y at x = 1/2, a series in y
        p[0, :] += np.pad(cheb.chebint(middle, lbnd=0, scl=0.5), (0, 1))[:size]
        keep = self.n + 4
        return psi[:keep, :keep], p[:keep, :keep]


# --- files ------------------------------------------------------------------------------------------

def smooth_text(cavity, check):
    psi, p = cavity.series()
    g = np.linspace(-1, 1, 41)[1:-1]
    dp = np.abs(cheb.chebgrid2d(g, g, p) - cheb.chebgrid2d(g, g, check.series()[1])).max()
    k = np.arange(len(psi))
    weight = np.maximum.outer(k, k)**2 + 1.0
    rows = [f"{i},{j},{psi[i, j]:.12g},{p[i, j]:.12g}" for i in k for j in k
            if max(abs(psi[i, j]) * weight[i, j], abs(p[i, j])) > SMALL]
    return "\n".join([
        "# Lid-driven cavity, Re = 100, lid u = 16 x^2 (1 - x)^2 at y = 1: steady flow in [0, 1]^2;",
        "# lengths in L, velocities in U (the largest of the lid), p in rho U^2, p = 0 at the centre.",
        "# psi = sum c_kl T_k(2 x - 1) T_l(2 y - 1), u = psi_y, v = -psi_x, and p likewise.",
        "# Made by tools/cavity_reference.py (spectral collocation, n = "
        f"{cavity.n} polynomials a side).",
        f"# Largest difference from n = {check.n} on a grid of 41^2: {difference(cavity, check):.1e} of "
        f"u and v, {dp:.1e} of p off",
        "# the walls (in the upper corners, where grad p is singular, 1e-5).",
        "k,l,psi,p", *rows]) + "\n"


def difference(one, other):
    """Largest of u and v on a grid."""
    g = np.linspace(0, 1, 41)
    x, y = (a.ravel() for a in np.meshgrid(g, g))
    a, b = one.flow(x, y), other.flow(x, y)
    return max(np.abs(a.x - b.x).max(), np.abs(a.y - b.y).max())


def flat_rows(cavity, check, Re):
    """(lines of the table, largest difference of the velocities from another n)"""
    y, x = np.array(GHIA_Y), np.array(GHIA_X)
    inner = slice(1, -1)
    u, pu, v, pv = cavity.lines(y[inner], x[inner])
    other = check.lines(y[inner], x[inner])
    rows = []
    for line, at, f, p, wall, ghia in (("u_vs_y", y, u, pu, 1.0, GHIA[Re][0]),
                                       ("v_vs_x", x, v, pv, 0.0, GHIA[Re][1])):
        full = [0.0, *f, wall]
        for k, place in enumerate(at):
            pressure = f"{p[k - 1]:.6f}" if 0 < k < len(at) - 1 else ""
            rows.append(f"{Re},{line},{place:g},{full[k]:.6f},{pressure},{ghia[k]:.5f}")
    return rows, max(np.abs(u - other[0]).max(), np.abs(v - other[2]).max())


def flat_text(cavities, checks):
    tables = {Re: flat_rows(cavities[Re], checks[Re], Re) for Re in cavities}
    error = ", ".join(f"{tables[Re][1]:.0e} (Re = {Re})" for Re in tables)
    return "\n".join([
        "# Lid-driven cavity, lid u = 1 at y = 1: steady flow on the centre lines x = 1/2 and y = 1/2;",
        "# lengths in L, velocities in U, p in rho U^2, p = 0 at the centre.",
        "# velocity, pressure: made by tools/cavity_reference.py, spectral collocation with the Stokes",
        f"# flow of both corners taken off, n = {FINE['flat']} polynomials a side; largest difference "
        f"of the velocities",
        f"# from n = {FINE['flat'] - 8}: {error}",
        "# ghia: finite differences, 129^2 points; U. Ghia, K. N. Ghia, C. T. Shin, J. Comput. Phys.",
        "# 48, 387 (1982), tables I and II. v at Re = 400, x = 0.9063 is a misprint there.",
        "Re,line,coordinate,velocity,pressure,ghia",
        *(row for rows, _ in tables.values() for row in rows)]) + "\n"


def write(folder):
    fine = FINE["smooth"]
    text = smooth_text(Cavity("smooth", fine, 100), Cavity("smooth", fine + 8, 100))
    (folder / "cavity_smooth_lid.csv").write_text(text, encoding="ascii")
    fine = FINE["flat"]
    text = flat_text(*({Re: Cavity("flat", n, Re) for Re in GHIA} for n in (fine, fine - 8)))
    (folder / "cavity_flat_lid.csv").write_text(text, encoding="ascii")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--write", type=Path, metavar="FOLDER")
    parser.add_argument("--lid", choices=LIDS, default="smooth")
    parser.add_argument("--Re", type=float, default=100.0)
    parser.add_argument("-n", type=int, nargs="+", default=[24, 32, 40])
    options = parser.parse_args()
    if options.write:
        write(options.write)
        return
    t = np.linspace(0.0005, 0.9995, 2000)
    for n in options.n:
        u, _, v, _ = Cavity(options.lid, n, options.Re).lines(t, t)
        print(f"n {n}: u from {u.min():.7f} at x = 1/2, v from {v.min():.7f} to {v.max():.7f} "
              "at y = 1/2")


if __name__ == "__main__":
    main()
