#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Shape of drops on walls, of the last frame of a dump: caps.py sessile|pendant DUMP options

sessile: a circle (2d) or sphere (3d) through the surface, half a spacing outside the surface
particles, next to the exact cap of the same volume without gravity; the wall is at y = 0 (2d) or
z = 0 (3d), the fluid above it.
  angle     at which the circle meets the wall [deg]; l2: relative error
  height    of the highest particle plus half a spacing
  radius    half the width (3d: radius) of the circle on the wall
  p         mean inner pressure; reference: sigma/R (2d), 2 sigma/R (3d)
  shape     deviation of the surface from the fitted circle in spacings (rms, largest)
  stray     surface particles farther than one spacing from it, left out of the fit
pendant: a drop under a ceiling at z = 0, next to the Young-Laplace drop of the same volume; height
from a paraboloid through the surface within 3 d of the axis, radius and angle at the ceiling from
lines through the surface within 4 d of it.
  verdict   explodes: more kinetic energy than gravity and surface tension can have set free, or a
            tenth of the fluid above the ceiling, far out to the side or not finite; falls: it does
            not, and a tenth of the fluid is deeper than any drop in equilibrium reaches; hangs: not
            that, either, and the fluid is at rest; else moves
The volume is N d^dim and half a cell for each spot of the wall that is wet: the first particles are
one spacing above the wall particles.
What cannot be measured, in a drop that has flown apart, has value=nan; stderr says why.
--print FILE: result lines as LAMMPS commands. --outline FILE: the exact outline, for render.py.
"""

import argparse
import math
import sys
from pathlib import Path

import pendant
from dumps import finite_rows, last_snapshot, need_columns, need_time, snapshots
from series import attempt, mean, print_command

NEEDED = {"sessile": ("x", "y", "z", "surface", "d_aleisph_p"),    # columns
          "pendant": ("x", "y", "z", "vx", "vy", "vz", "surface", "nx", "ny", "nz")}
REACH = 2.2        # no hanging drop is longer, in capillary lengths, at contact angles above 30 deg
ASIDE = 2.0        # from the axis, in edges of a cube of the drop's volume: 1.3 wets a cap of 30 deg
REST = 0.02        # rms velocity of a fluid at rest, over sqrt(sigma/(rho d_drop))


# --- frames ---------------------------------------------------------------------------------------

def first_rows(path, time, options, needed):
    """Fluid in the first snapshot of a dump, if that was before this time."""
    first = next(snapshots(path))
    if not need_time(first, path) < time:
        return []
    fluid = [row for row in first.dicts() if row["type"] == options.fluid]
    return finite_rows(fluid, needed, f"{path}, step {first.step}")


def last_frame(path):
    """(time, [length of the box or None where it is not periodic], rows) of the last snapshot."""
    snapshot = last_snapshot(path)
    time = need_time(snapshot, path)
    need_columns(snapshot.names, ("type", "surface", *"xyz"), path)
    lengths = [high - low if periodic else None
               for (low, high), periodic in zip(snapshot.bounds, snapshot.periodic)]
    return time, lengths, snapshot.dicts()


def joined(rows, lengths):
    """The same, moved by periods so that no drop lies across a boundary."""
    for axis, length in zip("xyz", lengths):
        if length is None:
            continue
        turn = 2.0 * math.pi / length
        middle = math.atan2(sum(math.sin(turn * row[axis]) for row in rows),
                            sum(math.cos(turn * row[axis]) for row in rows)) / turn
        for row in rows:
            row[axis] -= length * round((row[axis] - middle) / length)
    return rows


# --- spheres --------------------------------------------------------------------------------------

def solve(matrix, right):
    """Gaussian elimination with pivots, of a few equations."""
    n = len(right)
    rows = [list(row) + [value] for row, value in zip(matrix, right)]
    for k in range(n):
        pivot = max(range(k, n), key=lambda i, k=k: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        for i in range(k + 1, n):
            share = rows[i][k] / rows[k][k]
            rows[i] = [a - share * b for a, b in zip(rows[i], rows[k])]
    x = [0.0] * n
    for k in reversed(range(n)):
        x[k] = (rows[k][n] - sum(rows[k][j] * x[j] for j in range(k + 1, n))) / rows[k][k]
    return x


def least_squares(lines, values):
    """Solution of lines.x = values, by normal equations."""
    n = len(lines[0])
    matrix = [[sum(line[i] * line[j] for line in lines) for j in range(n)] for i in range(n)]
    return solve(matrix, [sum(line[i] * v for line, v in zip(lines, values)) for i in range(n)])


def fit_sphere(points):
    """(centre, radius) of the circle or sphere with the smallest sum of squared distances."""
    if len(points) < 4:
        raise ValueError(f"{len(points)} points of the surface")
    dim, origin = len(points[0]), [sum(c) / len(points) for c in zip(*points)]
    local = [[a - b for a, b in zip(point, origin)] for point in points]
    start = least_squares([[2.0 * a for a in q] + [1.0] for q in local],
                          [sum(a * a for a in q) for q in local])
    centre = start[:dim]
    radius = math.sqrt(start[dim] + sum(a * a for a in centre))
    for _ in range(10):    # Gauss-Newton, from the algebraic fit
        distances = [math.dist(q, centre) for q in local]
        lines = [[(a - c) / r for a, c in zip(q, centre)] + [1.0] for q, r in zip(local, distances)]
        step = least_squares(lines, [r - radius for r in distances])
        centre = [c + s for c, s in zip(centre, step)]
        radius += step[dim]
    return [c + o for c, o in zip(centre, origin)], radius


def fit_surface(points, d):
    """(centre, radius, residuals, strays): points more than d off a first fit are left out."""
    centre, radius = fit_sphere(points)
    near = [p for p in points if abs(math.dist(p, centre) - radius) < d]
    centre, radius = fit_sphere(near)
    return centre, radius, [math.dist(p, centre) - radius for p in near], len(points) - len(near)


def cap_volume(radius, angle, dim):
    """Area (2d) or volume of a cap of contact angle [rad]."""
    c = math.cos(angle)
    if dim == 2:
        return radius**2 * (angle - math.sin(angle) * c)
    return math.pi * radius**3 * (1.0 - c)**2 * (2.0 + c) / 3.0


def wet(contact_radius, dim):
    """What a drop covers of the wall."""
    return 2.0 * contact_radius if dim == 2 else math.pi * contact_radius**2


def exact_cap(count, d, angle, dim):
    """Radius of the cap whose volume is that of the particles and of the half cells on the wall."""
    radius = (count * d**dim / cap_volume(1.0, angle, dim))**(1.0 / dim)
    for _ in range(50):
        volume = count * d**dim + 0.5 * d * wet(radius * math.sin(angle), dim)
        radius = (volume / cap_volume(1.0, angle, dim))**(1.0 / dim)
    return radius


# --- results --------------------------------------------------------------------------------------

def against(case, quantity, time, angle, value, reference):
    return print_command([f"case={case}", f"quantity={quantity}", f"time={time:.6g}",
                          f"value={value:.6g}", f"reference={reference:.6g}",
                          f"l2={abs(value / reference - 1.0):.5f}", f"angle={angle:g}"])


def other(case, quantity, time, angle, *words):
    return print_command([f"case={case}", f"quantity={quantity}", f"time={time:.6g}", *words,
                          f"angle={angle:g}"])


def fitted_cap(rows, options):
    """(centre, radius, residuals, strays) of the circle or sphere half a spacing outside the surface."""
    axes = "xyz"[:options.dim]
    surface = [[row[a] for a in axes] for row in rows
               if row["surface"] and row[axes[-1]] > options.above * options.d]
    centre, radius, errors, strays = fit_surface(surface, options.d)
    return centre, radius + 0.5 * options.d, errors, strays


def cap_lines(rows, time, options, exact):
    """Result lines of the fitted circle or sphere, and the outline of the exact cap over it."""
    axes, d, degrees = "xyz"[:options.dim], options.d, options.angle
    angle = math.radians(degrees)
    centre, radius, errors, strays = fitted_cap(rows, options)
    cosine = max(-1.0, min(1.0, -centre[-1] / radius))
    top = max(row[axes[-1]] for row in rows
              if math.dist([row[a] for a in axes], centre) < radius + d)
    rms = math.sqrt(mean([e * e for e in errors])) / d

    def line(quantity, value, reference):
        return against("sessile-drop", quantity, time, degrees, value, reference)

    lines = [line("angle", math.degrees(math.acos(cosine)), degrees),
             line("height", top + 0.5 * d, exact * (1.0 - math.cos(angle))),
             line("radius", radius * math.sqrt(1.0 - cosine**2), exact * math.sin(angle)),
             other("sessile-drop", "shape", time, degrees, f"l2={rms:.4f}",
                   f"linf={max(map(abs, errors)) / d:.4f}"),
             other("sessile-drop", "stray", time, degrees, f"value={strays}", "reference=0")]
    turns = [angle * (2.0 * k / 200.0 - 1.0) for k in range(201)]
    outline = [(centre[0] + exact * math.sin(t), exact * (math.cos(t) - math.cos(angle)))
               for t in turns]
    return lines, outline


def sessile(rows, time, options):
    """Result lines, and the outline of the exact cap over the fitted centre."""
    exact = exact_cap(len(rows), options.d, math.radians(options.angle), options.dim)
    outline = []

    def cap():
        lines, points = cap_lines(rows, time, options, exact)
        outline.extend(points)
        return lines

    def failed(quantity, value):
        return other("sessile-drop", quantity, time, options.angle, value)

    lines = attempt(["angle", "height", "radius", "shape", "stray"], cap, failed)
    inner = mean([row["d_aleisph_p"] for row in rows if not row["surface"]])
    pressure = against("sessile-drop", "p", time, options.angle, inner,
                       (options.dim - 1) * options.sigma / exact)
    return lines[:3] + [pressure] + lines[3:], outline


def ceiling_line(rows, d, axis):
    """(radius, angle [deg]) at the ceiling: r = radius - depth cot(angle), quadratic in the depth,
    through the surface half a spacing outside the surface particles within 4 d."""
    lines, values = [], []
    for row in rows:
        x, y, z = (row[a] + 0.5 * d * row["n" + a] for a in "xyz")
        if row["surface"] and 0.0 < -z < 4.0 * d:
            lines.append([1.0, -z, z * z])
            values.append(math.hypot(x - axis[0], y - axis[1]))
    if len(values) < 10:
        return None, None
    radius, tangent, _ = least_squares(lines, values)
    return radius, math.degrees(math.atan2(1.0, -tangent))


def apex_depth(rows, d, axis):
    """Depth of the surface on the axis: a paraboloid through the surface particles within 3 d of it,
    half a spacing below them. One particle that sticks out counts little."""
    lines, values = [], []
    middle = sum(row["z"] for row in rows) / len(rows)
    for row in rows:
        x, y = row["x"] - axis[0], row["y"] - axis[1]
        if row["surface"] and row["z"] < middle and math.hypot(x, y) < 3.0 * d:
            lines.append([1.0, x / d, y / d, (x * x + y * y) / d**2])
            values.append(0.5 * d - row["z"])
    if len(values) < 10:
        return 0.5 * d - min(row["z"] for row in rows)
    return least_squares(lines, values)[0]


def kinetic(rows):
    """Per mass."""
    return 0.5 * mean([row["vx"]**2 + row["vy"]**2 + row["vz"]**2 for row in rows])


def surface_release(degrees):
    """Energy that surface tension can set free, over sigma size^2, with size^3 the volume.

    The least that a drop on a wall can have is that of the cap, 3 V/R. A cube that hangs by a face has
    5 - cos(angle), the wet face counted; half a unit more is allowed for other shapes at the start.
    """
    angle = math.radians(degrees)
    return max(0.0, 5.5 - math.cos(angle) - 3.0 * cap_volume(1.0, angle, 3)**(1.0 / 3.0))


def explodes(rows, lost, options, size, start):
    """Whether the drop has flown apart (see above). start: the same particles earlier; none: at rest
    at the ceiling, z = 0. From then on gravity has set free g times what the fluid has sunk."""
    count = len(rows)
    before, height = (kinetic(start), mean([row["z"] for row in start])) if start else (0.0, 0.0)
    sunk = max(0.0, height - mean([row["z"] for row in rows]))
    free = before + options.g * sunk
    free += surface_release(options.angle) * options.sigma / (options.rho * size)
    middle = drop_axis(rows, options)
    astray = lost + sum(row["z"] > options.d or math.dist((row["x"], row["y"]), middle) > ASIDE * size
                        for row in rows)
    return kinetic(rows) > free or astray > 0.1 * (count + lost)


def drop_axis(rows, options):
    """(x, y): the median, which few particles that fly away do not move."""
    if options.copies > 1:
        return 0.0, 0.0
    return tuple(sorted(row[a] for row in rows)[len(rows) // 2] for a in "xy")


def verdict(rows, options, length, lost=0, start=()):
    """explodes, falls, hangs or moves (see above), and the rms velocity in units of the drop."""
    if not rows:
        return "explodes", math.nan
    size = (options.copies * (len(rows) + lost) * options.d**3)**(1.0 / 3.0)
    unit = math.sqrt(options.sigma / (options.rho * size))
    speed = math.sqrt(2.0 * kinetic(rows))
    if explodes(rows, lost, options, size, start):
        return "explodes", speed / unit
    deep = sum(-row["z"] > REACH * length for row in rows)
    if deep > 0.1 * len(rows):
        return "falls", speed / unit
    return ("hangs" if speed < REST * unit else "moves"), speed / unit


def drop_lines(rows, time, options, length):
    """Result lines of a drop that hangs or moves, and the outline of the exact one if there is one."""
    d, degrees, case = options.d, options.angle, "hanging-drop"
    axis = (0.0, 0.0) if options.copies > 1 else tuple(mean([row[a] for row in rows]) for a in "xy")
    radius, angle = ceiling_line(rows, d, axis)
    if radius is None:
        return [], []
    volume = options.copies * len(rows) * d**3 + 0.5 * d * wet(radius, 3)
    lines = [other(case, "volume", time, degrees, f"value={volume:.6g}")]
    exact = pendant.equilibrium(volume / length**3, degrees)
    height = apex_depth(rows, d, axis)
    if exact is None:
        return lines + [other(case, "height", time, degrees, f"value={height:.6g}")], []
    lines += [against(case, "height", time, degrees, height, exact.height * length),
              against(case, "radius", time, degrees, radius, exact.contact_radius * length),
              against(case, "angle", time, degrees, angle, degrees)]
    half = [(r * length, (z - exact.height) * length) for r, z in exact.points[::20]]
    return lines, [(axis[0] - r, z) for r, z in reversed(half)] + [(axis[0] + r, z) for r, z in half]


def hanging(rows, time, options, lost=0, start=()):
    """Result lines, and the outline of the exact drop if there is one."""
    length = math.sqrt(options.sigma / (options.rho * options.g))
    word, speed = verdict(rows, options, length, lost, start)
    lines = [other("hanging-drop", "verdict", time, options.angle, f"value={word}"),
             other("hanging-drop", "speed", time, options.angle, f"value={speed:.4g}")]
    outline = []
    if word in ("hangs", "moves"):
        def shape():
            more, points = drop_lines(rows, time, options, length)
            outline.extend(points)
            return more
        lines += attempt(["height", "radius", "angle"], shape, lambda name, value: other(
            "hanging-drop", name, time, options.angle, value))
    return lines, outline


def parse():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("kind", choices=["sessile", "pendant"])
    parser.add_argument("dump")
    parser.add_argument("--d", type=float, required=True, help="spacing")
    parser.add_argument("--angle", type=float, required=True, help="contact angle [deg]")
    parser.add_argument("--sigma", type=float, required=True, help="surface tension")
    parser.add_argument("--dim", type=int, default=3, choices=[2, 3])
    parser.add_argument("--above", type=float, default=1.5,
                        help="the circle goes through the surface above this height, in spacings")
    parser.add_argument("--rho", type=float, default=1000.0)
    parser.add_argument("--g", type=float, default=5.0)
    parser.add_argument("--copies", type=int, default=1,
                        help="4 if the dump is a quarter of the drop, with its axis at x = y = 0")
    parser.add_argument("--fluid", type=int, default=1, help="type of the fluid")
    parser.add_argument("--print", dest="commands", metavar="FILE")
    parser.add_argument("--outline", metavar="FILE")
    return parser.parse_args()


def main():
    options = parse()
    time, lengths, rows = last_frame(options.dump)
    fluid = [row for row in rows if row["type"] == options.fluid]
    if not fluid:
        sys.exit(f"{options.dump} has no particle of type {options.fluid}")
    needed = [name for name in fluid[0] if name in NEEDED[options.kind]]
    rows = joined(finite_rows(fluid, needed, options.dump), lengths)
    if options.kind == "sessile":
        lines, outline = sessile(rows, time, options)
    else:
        start = first_rows(options.dump, time, options, needed)
        lines, outline = hanging(rows, time, options, len(fluid) - len(rows), start)
    if options.commands:
        Path(options.commands).write_text("".join(lines), encoding="ascii")
    else:
        print("".join(lines), end="")
    if options.outline:
        text = "".join(f"{time:.9g},{x:.6g},{y:.6g}\n" for x, y in outline)
        Path(options.outline).write_text("# time,x,y: " + options.kind + "\n" + text,
                                         encoding="ascii")


if __name__ == "__main__":
    main()
