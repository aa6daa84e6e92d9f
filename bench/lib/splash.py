# SPDX-License-Identifier: GPL-2.0-only
"""A dam break in mid-splash at any resolution, to solve one pressure equation in it.

examples/dam-break is run to T = t sqrt(2g/a) = 10.5: the water that ran up the far wall has fallen
back, plunged into the rest and throws up a jet; there are a cavity and spray. With m = 1 that state
is used as it is. A finer one would take too long to reach: with m > 1 the same water is filled with
a lattice m times as fine, disordered like a tank.
"""

import numpy as np

import common
import scene

TIME = 10.5
WIDTH, TOP, COLUMN, GRAVITY = 1.0, 1.6, 0.2, 9.81  # of examples/dam-break
REACH = 0.75        # of a particle of the run, in its spacings: a lattice of these has no gaps
NEXT_TO_WALL = 1.5  # of a particle, in the same unit
SMOOTHING = 1.5     # velocities are means over particles within this reach
JITTER = 0.2        # in spacings of the finer lattice; so none are closer than 0.6


def run(n, folder):
    """Positions and velocities of the fluid; n spacings across the column."""
    variables = {"d": COLUMN / n, "Tend": TIME, "every": TIME}
    common.run_lammps(scene.EXAMPLES / "dam-break/in.dam-break", variables, folder)
    rows = common.read_dump(folder / "dump.dam-break")
    fluid = rows[rows[:, 1] == 1]
    return fluid[:, 2:4], fluid[:, 5:7]


def offsets(reach, m):
    """Of all points of the finer lattice that can be within this many coarse spacings."""
    k = np.arange(-np.ceil(reach * m) - 1, np.ceil(reach * m) + 2).astype(int)
    grid = np.stack(np.meshgrid(k, k, indexing="ij"), axis=-1).reshape(-1, 2)
    return grid[np.sum(grid**2, axis=1) <= (reach * m + 1)**2]


def pairs(x, d, m, reach, columns):
    """(key of a point of the finer lattice, particle, distance/d) of all within reach.

    key = j*columns + i; points on the walls and beyond them are left out.
    """
    fine = d / m
    near = offsets(reach, m)
    i = np.rint(x[:, None, 0] / fine).astype(int) + near[None, :, 0]
    j = np.rint(x[:, None, 1] / fine).astype(int) + near[None, :, 1]
    distance = np.hypot(fine * i - x[:, None, 0], fine * j - x[:, None, 1]) / d
    keep = (distance <= reach) & (i > 0) & (i < columns) & (j > 0)
    particle = np.broadcast_to(np.arange(len(x))[:, None], i.shape)
    return (j * columns + i)[keep], particle[keep], distance[keep]


def with_feet(x, v, d):
    """The fluid, and of what is next to a wall its projection on that wall (in a corner: on both,
    and the corner): the finer fluid reaches the wall, where the velocity is along it."""
    for axis, plane in ((0, 0.0), (0, WIDTH), (1, 0.0)):
        next_to = np.abs(x[:, axis] - plane) < NEXT_TO_WALL * d
        foot, slip = x[next_to].copy(), v[next_to].copy()
        foot[:, axis], slip[:, axis] = plane, 0.0
        x, v = np.concatenate((x, foot)), np.concatenate((v, slip))
    return x, v


def refine(x, v, d, m, seed=1):
    """Fluid of spacing d/m where the fluid of spacing d is: positions, velocities."""
    if m == 1:
        return x, v
    x, v = with_feet(x, v, d)
    columns = round(WIDTH * m / d)
    filled = np.unique(pairs(x, d, m, REACH, columns)[0])
    key, particle, distance = pairs(x, d, m, SMOOTHING, columns)
    weight = np.exp(-2 * distance**2)
    total = np.bincount(key, weight)
    mean = [np.bincount(key, weight * v[particle, axis])[filled] / total[filled]
            for axis in (0, 1)]
    lattice = np.column_stack((filled % columns, filled // columns)) * (d / m)
    shift = np.random.default_rng(seed).uniform(-JITTER, JITTER, lattice.shape) * (d / m)
    return lattice + shift, np.column_stack(mean)


def walls(d):
    """Of the tank, open above: the outermost rows of the lattice."""
    across, high = np.arange(round(WIDTH / d) + 1), np.arange(1, round(TOP / d) + 1)
    floor = np.column_stack((across * d, 0 * across))
    sides = [np.column_stack((0 * high + x, high * d)) for x in (0.0, WIDTH)]
    return np.concatenate((floor, *sides))


def write_data(path, x, v, d):
    """LAMMPS data file: fluid of type 1, walls of type 2; the pressure is zero."""
    solid = walls(d)
    both = np.concatenate((x, solid))
    count, low, high = len(both), both.min(axis=0) - 0.5 * d, both.max(axis=0) + 0.5 * d
    kind = np.repeat((1, 2), (len(x), len(solid)))
    zero, tag = np.zeros(count), np.arange(1, count + 1)
    speed = np.concatenate((v, 0 * solid))
    with open(path, "w", encoding="ascii") as out:
        out.write(f"Dam break, made by splash.py\n\n{count} atoms\n2 atom types\n\n")
        for name, a, b in zip("xyz", (*low, -0.5 * d), (*high, 0.5 * d)):
            out.write(f"{a:.17g} {b:.17g} {name}lo {name}hi\n")
        out.write("\nAtoms # atomic\n\n")
        np.savetxt(out, np.column_stack((tag, kind, both, zero)), "%d %d %.15g %.15g %g")
        out.write("\nVelocities\n\n")
        np.savetxt(out, np.column_stack((tag, speed, zero)), "%d %.15g %.15g %g")
    return count


def step(v, d):
    """The time step of the example: CFL 0.2, and sqrt(d/g)/4 for the body force."""
    return float(min(0.2 * d / np.max(np.hypot(*v.T)), 0.25 * np.sqrt(d / GRAVITY)))
