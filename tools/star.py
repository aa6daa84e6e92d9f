# SPDX-License-Identifier: GPL-2.0-only
"""Smooth outlines r(direction) of drops, in 2d and 3d. Standard library only.

An outline is a sum of harmonics - cos, sin of multiples of the angle in 2d, spherical harmonics in
3d - fitted to points by least squares; from it come volume and area (2d: area and perimeter).
"""

import math
from operator import mul

STEP = 1e-5    # of numerical derivatives with respect to the direction


def dot(a, b):
    return sum(map(mul, a, b))


def unit(vector):
    length = math.sqrt(dot(vector, vector))
    return [a / length for a in vector]


def circular(direction, degree):
    """1, cos and sin of 1 to degree times the angle."""
    z = complex(direction[0], direction[1])
    power, values = z, [1.0]
    for _ in range(degree):
        values += [power.real, power.imag]
        power *= z
    return values


def legendre(m, degree, z):
    """P_l^m(z)/(1 - z^2)^(m/2) for l = m to degree, without the sign (-1)^m; recurrence in l, and
    scaled by sqrt((l - m)!/(l + m)!) to be of order one."""
    last, value = 0.0, math.prod(range(1, 2 * m, 2))
    scale = 1.0 / math.sqrt(math.factorial(2 * m))
    for k in range(m, degree + 1):
        yield value * scale
        last, value = value, ((2 * k + 1) * z * value - (k + m) * last) / (k + 1 - m)
        scale *= math.sqrt((k + 1 - m) / (k + 1 + m))


def spherical(direction, degree):
    """Real spherical harmonics of degree 0 to degree: P_l^m(z) times real, imaginary (x + iy)^m."""
    x, y, z = direction
    power, values = complex(1.0), []
    for m in range(degree + 1):
        for p in legendre(m, degree, z):
            values += [p * power.real, p * power.imag] if m else [p]
        power *= complex(x, y)
    return values


def directions(dim):
    """Points that divide the circle or the sphere into equal parts, each with the unit vectors
    perpendicular to it."""
    if dim == 2:
        for k in range(256):
            a = 2.0 * math.pi * k / 256
            yield (math.cos(a), math.sin(a)), [(-math.sin(a), math.cos(a))]
        return
    for row in range(32):
        z = (row + 0.5) / 16 - 1.0
        s = math.sqrt(1.0 - z * z)
        for column in range(64):
            a = 2.0 * math.pi * (column + 0.5) / 64
            c, e = math.cos(a), math.sin(a)
            yield (s * c, s * e, z), [(-e, c, 0.0), (-z * c, -z * e, s)]


def solve(matrix, right):
    """Gauss elimination of a positive definite system."""
    n = len(right)
    if not all(math.isfinite(a) for row in matrix for a in row):
        raise ValueError("points that are not finite")
    rows = [row[:] + [b] for row, b in zip(matrix, right)]
    for k in range(n):
        for i in range(k + 1, n):
            factor = rows[i][k] / rows[k][k]
            if factor:
                rows[i][k:] = [a - factor * b for a, b in zip(rows[i][k:], rows[k][k:])]
    x = [0.0] * n
    for k in reversed(range(n)):
        x[k] = (rows[k][n] - dot(rows[k][k + 1:n], x[k + 1:])) / rows[k][k]
    return x


def least_squares(columns, values):
    """Coefficients of the columns (lists) whose sum is nearest to the values."""
    matrix = [[dot(a, b) for b in columns[:k + 1]] for k, a in enumerate(columns)]
    full = [[matrix[max(i, j)][min(i, j)] for j in range(len(columns))]
            for i in range(len(columns))]
    return solve(full, [dot(a, values) for a in columns])


class Star:
    """Outlines in dim dimensions, harmonics up to a degree."""

    def __init__(self, dim, degree):
        self.dim, self.degree = dim, degree
        self.basis = circular if dim == 2 else spherical
        self.values, self.slopes = [], []    # of the harmonics in all directions
        for u, tangents in directions(dim):
            self.values.append(self.at(u))
            self.slopes.append([self.slope(u, t) for t in tangents])

    def at(self, direction):
        return self.basis(direction, self.degree)

    def slope(self, u, tangent):
        ahead = self.at(unit([a + STEP * b for a, b in zip(u, tangent)]))
        behind = self.at(unit([a - STEP * b for a, b in zip(u, tangent)]))
        return [(a - b) / (2.0 * STEP) for a, b in zip(ahead, behind)]

    def fit(self, points, depth):
        """Coefficients of the outline through points relative to its centre, and how many of them
        are left out, since they are deeper than this below the outline through all."""
        if len(points) < len(self.values[0]):
            raise ValueError(f"{len(points)} points do not determine an outline")
        rows = [self.at(unit(p)) for p in points]
        radii = [math.sqrt(dot(p, p)) for p in points]
        fit = least_squares(list(zip(*rows)), radii)
        outer = [k for k, row in enumerate(rows) if radii[k] > dot(fit, row) - depth]
        if len(outer) < len(points):
            fit = least_squares(list(zip(*(rows[k] for k in outer))), [radii[k] for k in outer])
        return fit, len(points) - len(outer)

    def radii(self, fit):
        return [dot(fit, values) for values in self.values]

    def measures(self, fit):
        """(volume, area); in 2d (area, perimeter)."""
        if not min(self.radii(fit)) > 0.0:
            raise ValueError("the surface is no outline around its centre; the drop flew apart")
        whole = 2.0 * (self.dim - 1) * math.pi / len(self.values)    # angle of each direction
        volume = area = 0.0
        for r, slopes in zip(self.radii(fit), self.slopes):
            square = sum(dot(fit, slope)**2 for slope in slopes)
            volume += whole * r**self.dim / self.dim
            area += whole * r**(self.dim - 2) * math.sqrt(r * r + square)
        return volume, area
