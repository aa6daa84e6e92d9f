#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Writes a LAMMPS data file with the particles of a pipe along x between its two open ends.

A cross-section is made of concentric rings, one spacing apart, of round(2 pi r/d) particles; every
second ring is turned by half a step. The last ring lies on the surface r = R: these are the wall
particles. The same section is repeated every spacing along x, and beyond both ends for as many
layers as the support of the kernel reaches (buffer layers).

Types: 1 fluid, 2 wall, 3 buffer before the inlet x = 0, 4 buffer behind the outlet x = L.
"""

import argparse
import math


def ring(radius, spacing, turned):
    """Particles (y, z) on a circle about the axis."""
    count = max(1, round(2 * math.pi * radius / spacing))
    start = 0.5 if turned else 0.0
    angles = [2 * math.pi * (k + start) / count for k in range(count)]
    return [(radius * math.cos(a), radius * math.sin(a)) for a in angles]


def section(radius, spacing):
    """Lists of the fluid and of the wall particles (y, z) of one cross-section."""
    rings = round(radius / spacing)
    step = radius / rings
    fluid = [p for m in range(rings) for p in ring(m * step, spacing, turned=m % 2 == 1)]
    return fluid, ring(radius, spacing, turned=False)


def particles(length, radius, spacing, support):
    """Rows (type, x, y, z)."""
    planes = round(length / spacing)
    step = length / planes
    layers = math.ceil(support / step - 1e-9)
    fluid, wall = section(radius, spacing)
    for plane in range(-layers, planes + layers + 1):
        kind = 3 if plane < 0 else 4 if plane > planes else 1
        yield from ((kind, plane * step, y, z) for y, z in fluid)
        yield from ((2, plane * step, y, z) for y, z in wall)


def write(path, rows, margin):
    """The data file; the box ends a margin beyond the outermost particles."""
    with open(path, "w", encoding="ascii") as out:
        out.write(f"Pipe along x, made by pipe.py\n\n{len(rows)} atoms\n4 atom types\n\n")
        for axis, name in enumerate("xyz", 1):
            values = [row[axis] for row in rows]
            low, high = min(values) - margin, max(values) + margin
            out.write(f"{low:.17g} {high:.17g} {name}lo {name}hi\n")
        out.write("\nAtoms # atomic\n\n")
        for tag, (kind, x, y, z) in enumerate(rows, 1):
            out.write(f"{tag} {kind} {x:.17g} {y:.17g} {z:.17g}\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-L", "--length", type=float, required=True)
    parser.add_argument("-R", "--radius", type=float, required=True)
    parser.add_argument("-d", "--spacing", type=float, required=True)
    parser.add_argument("--support", type=float, default=2.4,
                        help="of the kernel, in spacings (default: cubic spline with h = 1.2 d)")
    parser.add_argument("-o", "--output", default="pipe.data")
    args = parser.parse_args()
    if not 0 < 3 * args.spacing <= args.radius:
        parser.error("the radius must be at least 3 spacings")
    rows = list(particles(args.length, args.radius, args.spacing, args.support * args.spacing))
    write(args.output, rows, margin=0.5 * args.spacing)


if __name__ == "__main__":
    main()
