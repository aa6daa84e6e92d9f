#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Writes a LAMMPS data file with the particles of a disc or ball, stretched to an ellipse or an
ellipsoid of revolution of the same volume.

The disc is made of concentric rings, the ball of concentric shells, half a spacing, one and a half,
... from the centre, each with as many particles as its volume asks for. Those of a shell lie on a
spiral with equal areas; every ring and shell is turned, so that no line of particles continues from
one to the next. The outermost layer is half a spacing inside the surface.
"""

import argparse
import math

GOLDEN = math.pi * (3.0 - math.sqrt(5.0))    # angle between two particles of a spiral


def ring(number, d):
    count = max(1, round(2.0 * math.pi * (number + 0.5)))
    angles = [2.0 * math.pi * (k / count + 0.382 * number) for k in range(count)]
    r = (number + 0.5) * d
    return [(r * math.cos(a), r * math.sin(a), 0.0) for a in angles]


def shell(number, d):
    count = round(4.0 / 3.0 * math.pi * ((number + 1)**3 - number**3))
    r = (number + 0.5) * d
    for k in range(count):
        z = 1.0 - (2 * k + 1) / count
        a = GOLDEN * k + 2.4 * number
        s = math.sqrt(1.0 - z * z)
        yield turned((r * s * math.cos(a), r * s * math.sin(a), r * z), number)


def turned(p, number):
    """About the x axis, so that the poles of the spirals do not lie above each other."""
    c, s = math.cos(1.0 * number), math.sin(1.0 * number)
    return p[0], c * p[1] - s * p[2], s * p[1] + c * p[2]


def particles(dim, layers, d, stretch):
    """2d: longer by the factor `stretch` along x; 3d: along z."""
    thin = 1.0 / stretch if dim == 2 else stretch**-0.5
    factors = (stretch, thin, 1.0) if dim == 2 else (thin, thin, stretch)
    for number in range(layers):
        for p in (ring if dim == 2 else shell)(number, d):
            yield tuple(a * f for a, f in zip(p, factors))


def write(path, dim, rows, d):
    with open(path, "w", encoding="ascii") as out:
        out.write(f"Drop, made by drop.py\n\n{len(rows)} atoms\n1 atom types\n\n")
        for axis, name in enumerate("xyz"):
            reach = 0.5 * d + max(abs(row[axis]) for row in rows)
            out.write(f"{-reach:.17g} {reach:.17g} {name}lo {name}hi\n")
        out.write("\nAtoms # atomic\n\n")
        for tag, row in enumerate(rows, 1):
            out.write(f"{tag} 1 {row[0]:.17g} {row[1]:.17g} {row[2]:.17g}\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--dim", type=int, default=2, choices=(2, 3))
    parser.add_argument("-d", "--spacing", type=float, required=True)
    parser.add_argument("-n", "--layers", type=int, required=True, help="radius over spacing")
    parser.add_argument("--stretch", type=float, default=1.0)
    parser.add_argument("-o", "--output", default="drop.data")
    args = parser.parse_args()
    if args.layers < 3 or args.stretch <= 0.0:
        parser.error("at least 3 layers and a positive stretch")
    rows = list(particles(args.dim, args.layers, args.spacing, args.stretch))
    write(args.output, args.dim, rows, args.spacing)


if __name__ == "__main__":
    main()
