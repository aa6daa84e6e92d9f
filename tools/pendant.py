# SPDX-License-Identifier: GPL-2.0-only
"""Exact shapes of drops that hang from a ceiling: the axisymmetric Young-Laplace equation.

Lengths in capillary lengths l = sqrt(sigma/(rho g)), pressures in sigma/l. Along the profile, from
the apex at the bottom: r' = cos psi, z' = sin psi, psi' = 2/R0 - z - sin(psi)/r, R0 the radius of
curvature at the apex. psi is the inclination, and where the profile meets the ceiling the angle
through the fluid. Standard library only.
"""

import math
from dataclasses import dataclass

STEP = 5e-3    # of the arc length; fourth order: errors are below 1e-6


@dataclass
class Drop:
    """A drop in equilibrium; points: its profile from the apex to the ceiling."""
    apex_radius: float
    volume: float
    height: float
    contact_radius: float
    points: list

    def ceiling_pressure(self):
        return 2.0 / self.apex_radius - self.height


def slope(state, curvature):
    r, z, psi, _ = state
    turn = curvature - math.sin(psi) / r if r > 1e-9 else 0.5 * curvature
    return (math.cos(psi), math.sin(psi), turn - z, math.pi * r * r * math.sin(psi))


def runge_kutta(state, curvature, step):
    def moved(k, by):
        return tuple(s + by * g for s, g in zip(state, k))
    k1 = slope(state, curvature)
    k2 = slope(moved(k1, 0.5 * step), curvature)
    k3 = slope(moved(k2, 0.5 * step), curvature)
    k4 = slope(moved(k3, step), curvature)
    return tuple(s + step / 6.0 * (a + 2.0 * b + 2.0 * c + d)
                 for s, a, b, c, d in zip(state, k1, k2, k3, k4))


def crossings(apex_radius, angle, count=2):
    """The first drops of this apex radius that meet the ceiling at an angle [rad]: the profile
    rises through it, and (after a bulge) falls through it again."""
    curvature = 2.0 / apex_radius
    step = STEP * min(1.0, apex_radius)
    state, points, found = (0.0, 0.0, 0.0, 0.0), [(0.0, 0.0)], []
    while len(found) < count and state[2] < math.pi and state[1] < 6.0 and len(points) < 20000:
        new = runge_kutta(state, curvature, step)
        if (state[2] < angle) != (new[2] < angle):
            share = (angle - state[2]) / (new[2] - state[2])
            r, z, _, volume = runge_kutta(state, curvature, share * step)
            found.append(Drop(apex_radius, volume, z, r, points + [(r, z)]))
        elif new[2] < 0.0:
            break
        state = new
        points.append(new[:2])
    return found


def family(angle, ratio=1.01):
    """Drops from a small one on, in the order of the family of equilibria: the apex radius grows
    as long as the profile reaches the angle, then falls on the branch that bulges."""
    radius = 0.05
    while drops := crossings(radius, angle, 1):
        yield drops[0]
        radius *= ratio
    while radius > 0.05:
        radius /= ratio
        drops = crossings(radius, angle)
        if len(drops) < 2:
            return
        yield drops[1]


def bisect(first, second, volume, angle):
    """The drop of a volume between two neighbors of the family."""
    branch = 0 if second.apex_radius > first.apex_radius else 1
    low, high = first.apex_radius, second.apex_radius
    drop = first
    for _ in range(30):
        middle = 0.5 * (low + high)
        drops = crossings(middle, angle, branch + 1)
        if len(drops) <= branch:    # beyond the largest apex radius
            high = middle
            continue
        drop = drops[branch]
        low, high = (middle, high) if drop.volume < volume else (low, middle)
    return drop


def equilibrium(volume, degrees):
    """The stable drop of a volume, or None where none hangs: the family's volume has a maximum."""
    angle = math.radians(degrees)
    last = None
    for drop in family(angle):
        if last and drop.volume < last.volume:
            return None
        if last and drop.volume >= volume:
            return bisect(last, drop, volume, angle)
        last = drop
    return None


def largest(degrees):
    """The drop of the largest volume that hangs."""
    best = None
    for drop in family(math.radians(degrees)):
        if best and drop.volume < best.volume:
            break
        best = drop
    return best
