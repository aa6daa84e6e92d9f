#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Writes a LAMMPS data file with the particles of the MARIN tank: SPHERIC benchmark test 2.

The tank is 3.22 m long (x), 1 m wide (y) and open above; a box stands on its floor; the water fills
the end at large x to a depth of 0.55 m. Walls are sheets of particles, one thick, on the surfaces
of tank and box; edges and corners are there once. All sheets are cut out of one set of planes
x = const, y = const, z = const, which contains every surface, so that the spacing along a sheet
differs a little from one stretch between two surfaces to the next. The vertical walls of the tank
have planes z = const of their own.

The water is a lattice of equal cells, one cell away from the walls. Its free sides lie half a cell
beyond the last particles. The cells are not larger than asked for in z and nearly cubes.

Types: 1 water, 2 tank, 3 box (with the line where it meets the floor).
Prints the edge of a cube with the volume of a cell, which is the particle spacing of the run.
"""

import argparse

LENGTH, WIDTH = 3.22, 1.0
WATER, DEPTH = 1.992, 0.55    # the water begins at this x
BOX = ((0.6635, 0.8245), (0.2955, 0.6985), (0.0, 0.161))


def planes(stops, spacing):
    """Coordinates from the first to the last of the stops, equal steps between two stops."""
    result = [stops[0]]
    for low, high in zip(stops, stops[1:]):
        count = max(1, round((high - low) / spacing))
        result += [low + (high - low) * k / count for k in range(1, count)] + [high]
    return result


def cell(spacing):
    """Edges of a cell of water; in x and z, the last particle is half a cell inside the surface."""
    layers = int(DEPTH / spacing - 0.5 + 1e-9)
    edge = DEPTH / (layers + 0.5)
    columns = round((LENGTH - WATER) / edge - 0.5)
    return (LENGTH - WATER) / (columns + 0.5), WIDTH / round(WIDTH / edge), edge


def water(edges):
    """Particles, one edge away from the walls, as long as they are inside of the free sides."""
    dx, dy, dz = edges
    return [(LENGTH - i * dx, j * dy, k * dz)
            for i in range(1, int((LENGTH - WATER) / dx) + 1)
            for j in range(1, round(WIDTH / dy))
            for k in range(1, int(DEPTH / dz) + 1)]


def walls(spacing, layer, height):
    """Particles of the tank and of the box, as two sets."""
    (x0, x1), (y0, y1), (z0, z1) = BOX
    xs = planes([0.0, x0, x1, LENGTH], spacing)
    ys = planes([0.0, y0, y1, WIDTH], spacing)
    low = planes([z0, z1], spacing)
    high = [k * layer for k in range(round(height / layer) + 1)]

    inside = [(x, y) for x in xs for y in ys if x0 < x < x1 and y0 < y < y1]
    around = [(x, y) for x in xs for y in ys
              if x0 <= x <= x1 and y0 <= y <= y1 and (x in (x0, x1) or y in (y0, y1))]
    box = {(x, y, z) for x, y in around for z in low} | {(x, y, z1) for x, y in inside}
    floor = {(x, y, 0.0) for x in xs for y in ys} - {(x, y, 0.0) for x, y in inside + around}
    sides = {(x, y, z) for x in xs for y in (0.0, WIDTH) for z in high}
    ends = {(x, y, z) for x in (0.0, LENGTH) for y in ys for z in high}
    return floor | sides | ends, box


def write(path, groups, margin):
    """The data file; the simulation box ends a margin beyond the outermost particles."""
    rows = [(kind, *place) for kind, places in enumerate(groups, 1) for place in sorted(places)]
    with open(path, "w", encoding="ascii") as out:
        out.write(f"MARIN tank, made by tank.py\n\n{len(rows)} atoms\n{len(groups)} atom types\n\n")
        for axis, name in enumerate("xyz", 1):
            values = [row[axis] for row in rows]
            low, high = min(values) - margin, max(values) + margin
            out.write(f"{low:.17g} {high:.17g} {name}lo {name}hi\n")
        out.write("\nAtoms # atomic\n\n")
        for tag, (kind, x, y, z) in enumerate(rows, 1):
            out.write(f"{tag} {kind} {x:.17g} {y:.17g} {z:.17g}\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-d", "--spacing", type=float, required=True)
    parser.add_argument("--height", type=float, default=1.0, help="of the walls of the tank")
    parser.add_argument("-o", "--output", default="tank.data")
    args = parser.parse_args()
    if not 0 < args.spacing <= 0.08:
        parser.error("the spacing must be at most 0.08 m, half the height of the box")
    edges = cell(args.spacing)
    spacing = (edges[0] * edges[1] * edges[2])**(1 / 3)
    tank, box = walls(spacing, edges[2], args.height)
    write(args.output, [water(edges), tank, box], margin=0.5 * spacing)
    print(f"{spacing:.10g}")


if __name__ == "__main__":
    main()
