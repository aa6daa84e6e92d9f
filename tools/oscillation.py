# SPDX-License-Identifier: GPL-2.0-only
"""Frequency and damping of a series: y = exp(-gamma t) (a cos omega t + b sin omega t) + c.
Standard library only."""

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
