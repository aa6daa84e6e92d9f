#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Shape, pressure and energy of a drop in free space: drops.py DUMP --case NAME -d D [options]

Needs the columns surface, nx, ny (nz), d_aleisph_p and velocities in the dump. R is the radius of
the disc or ball whose volume is that of the particles, d^dim each; its pressure is (dim - 1)
sigma/R. The surface lies half a spacing outside the surface particles. --print writes, for the last
frame, as LAMMPS commands:
  p           mean of the particles deeper than 3 d below the nearest point of the surface;
              l2: its relative error
  sphericity  largest radius of the surface over R; linf, l2: largest and rms difference of the
              radii of surface particles from R, in spacings; inner: surface particles of the
              second layer, 0.6 d and more inside the outline
  volume      value: that of the particles over their numerical density, the kernel sum of deep
              ones; outline: inside a smooth outline (harmonics up to degree 8 in 3d, 12 in 2d,
              fitted without the inner particles); both over that of the particles. Where the layer
              of surface particles is denser than the lattice, the surface is farther outside than
              half a spacing, and the outline too small; layer: surface particles per d^(dim - 1)
  velocity    largest |v| over sqrt(sigma/(rho R))
and for all frames, with --energy, kinetic energy plus sigma times the area of that outline, scaled
to the volume of the particles: its distance from them is known to about 0.1 d only
  energy      at the end over that of the disc or ball at rest; rise: largest growth above any
              earlier frame, in the same units
--series FILE keeps these for all frames. --mode SERIES reads columns t [sqrt(rho R^3/sigma)] and a,
the amplitude of the mode n = 2, of a file of fix ave/time, and adds
  frequency, damping    of that mode, in that unit of time; reference: linear theory with all of
              viscosity (oscillation.py); l2: relative error; leading: to leading order
              in nu, omega^2 = 6 and gamma = 4 nu/R^2 in 2d, 8 and 5 nu/R^2 in 3d
What cannot be measured, in a drop that has flown apart, has value=nan; stderr says why. Standard
library only.
"""

import argparse
import itertools
import math
import sys
from pathlib import Path

import oscillation
from dumps import finite_rows, need_columns, snapshots
from series import attempt, mean, print_command, read_series
from star import Star, dot

H_OVER_D = 1.2    # kernel of the density: cubic spline, whatever the run uses
SAMPLE = 400      # particles whose density is summed
ENOUGH = 800      # surface particles for an outline of which there are many
ENERGY = ("time", "kinetic", "surface", "energy", "volume", "r_min", "r_max", "inner")
INNER = 0.6    # surface particles deeper than this below the outline are not of the outer layer
DEEP = 3.0     # where the pressure is taken, below the surface, in spacings


def frames(path, dim):
    """(time, {column: list of numbers}) of every snapshot of a dump."""
    needed = ["surface", "d_aleisph_p", *"xyz"[:dim]]
    needed += [a + b for a in "nv" for b in "xyz"[:dim]]
    for snapshot in snapshots(path):
        need_columns(snapshot.names, needed, path)
        rows = finite_rows(snapshot.dicts(), needed, f"{path}, step {snapshot.step}")
        yield snapshot.time or 0.0, {name: [row[name] for row in rows] for name in needed}


def vectors(columns, names):
    return list(zip(*(columns[name] for name in names)))


def size(vector):
    return math.sqrt(dot(vector, vector))


def sphere_radius(volume, dim):
    return math.sqrt(volume / math.pi) if dim == 2 else (0.75 * volume / math.pi)**(1 / 3)


def sphere_area(radius, dim):
    return 2.0 * math.pi * radius if dim == 2 else 4.0 * math.pi * radius**2


def kernel(q, dim):
    """Cubic spline times h^dim, of q = r/h."""
    shape = 1.0 - 1.5 * q * q + 0.75 * q**3 if q < 1.0 else 0.25 * max(2.0 - q, 0.0)**3
    return shape * (10.0 / (7.0 * math.pi) if dim == 2 else 1.0 / math.pi)


class Cells:
    """Particles by cells of the size of the support."""

    def __init__(self, x, d):
        self.h = H_OVER_D * d
        self.cells = {}
        for p in x:
            self.cells.setdefault(self.cell(p), []).append(p)

    def cell(self, p):
        return tuple(math.floor(a / (2.0 * self.h)) for a in p)

    def density(self, p, d):
        """V sum_j W at a point."""
        total = 0.0
        for shift in itertools.product((-1, 0, 1), repeat=len(p)):
            for other in self.cells.get(tuple(map(sum, zip(self.cell(p), shift))), ()):
                q = math.dist(p, other) / self.h
                if q < 2.0:
                    total += kernel(q, len(p))
        return total * (d / self.h)**len(p)


class Drop:
    """One frame."""

    def __init__(self, columns, dim, d):
        self.dim, self.d = dim, d
        self.columns = columns
        self.outlines = {}    # those fitted so far
        self.volume = len(columns["x"]) * d**dim
        self.R = sphere_radius(self.volume, dim)
        x = vectors(columns, "xyz"[:dim])
        middle = [mean(column) for column in zip(*x)]
        self.x = [[a - m for a, m in zip(p, middle)] for p in x]

    def surface(self):
        """Points of the surface: half a spacing outside the surface particles."""
        normals = vectors(self.columns, ("nx", "ny", "nz")[:self.dim])
        return [[a + 0.5 * self.d * b for a, b in zip(p, n)]
                for p, n, on in zip(self.x, normals, self.columns["surface"]) if on]

    def radii(self):
        """Of the surface, over every surface particle."""
        return [size(p) + 0.5 * self.d
                for p, on in zip(self.x, self.columns["surface"]) if on]

    def outline(self, star, every=1):
        """(coefficients, number of inner particles), from every so many surface particles"""
        if every not in self.outlines:
            self.outlines[every] = star.fit(self.surface()[::every], INNER * self.d)
        return self.outlines[every]

    def density(self, nearest):
        """Mean numerical density of some particles deeper than 3 d."""
        deep = [x for x in self.x if size(x) < nearest - DEEP * self.d]
        if not deep:
            return math.nan
        cells = Cells(self.x, self.d)
        return mean([cells.density(x, self.d) for x in deep[::1 + len(deep) // SAMPLE]])

    def layer(self):
        """Surface particles per d^(dim - 1) of the sphere or circle on which they lie."""
        radii = [r - 0.5 * self.d for r in self.radii()]
        return len(radii) * self.d**(self.dim - 1) / sphere_area(mean(radii), self.dim)

    def pressure(self, nearest):
        """Mean over particles deeper than 3 d below a sphere; (pressure, their number)."""
        deep = [p for x, p in zip(self.x, self.columns["d_aleisph_p"])
                if size(x) < nearest - DEEP * self.d]
        return (mean(deep), len(deep)) if deep else (math.nan, 0)

    def speeds(self):
        return [size(v) for v in vectors(self.columns, ("vx", "vy", "vz")[:self.dim])]


def star_for(drop):
    """Harmonics that so many surface particles determine well."""
    count = sum(on != 0 for on in drop.columns["surface"])
    limit = 12 if drop.dim == 2 else 8
    return Star(drop.dim, min(limit, int(count / 8) if drop.dim == 2 else int(count**0.5 / 2.5)))


def energy_row(time, drop, star, rho, sigma):
    """Energies in units of sigma times the area of the sphere of that volume. ENOUGH particles
    determine the outline; the inner ones are counted among these."""
    fit, inner = drop.outline(star, 1 + sum(map(bool, drop.columns["surface"])) // ENOUGH)
    volume, area = star.measures(fit)
    area *= (drop.volume / volume)**(1.0 - 1.0 / drop.dim)
    whole = sigma * sphere_area(drop.R, drop.dim)
    kinetic = 0.5 * rho * drop.d**drop.dim * sum(v * v for v in drop.speeds())
    radii = drop.radii()
    return {"time": time, "kinetic": kinetic / whole, "surface": sigma * area / whole,
            "energy": (kinetic + sigma * area) / whole, "volume": volume / drop.volume,
            "r_min": min(radii) / drop.R, "r_max": max(radii) / drop.R, "inner": inner}


def energy_rows(frames_of_dump, options):
    """A row for every frame whose outline can be found, the last drop, and its harmonics."""
    rows, star, drop = [], None, None
    for time, columns in frames_of_dump:
        drop = Drop(columns, options.dim, options.d)
        if options.energy:
            try:
                star = star or star_for(drop)
                rows.append(energy_row(time, drop, star, options.rho, options.sigma))
            except (ArithmeticError, ValueError) as problem:
                print(f"no energy at time {time:g}: {problem}", file=sys.stderr)
                rows.append({**dict.fromkeys(ENERGY, math.nan), "time": time})
    return rows, star, drop


def largest_rise(values):
    """Of those that could be measured."""
    values = [value for value in values if math.isfinite(value)]
    if not values:
        return math.nan
    lowest, rise = values[0], 0.0
    for value in values:
        lowest = min(lowest, value)
        rise = max(rise, value - lowest)
    return rise


def line(options, quantity, *more):
    return print_command([f"case={options.case}", f"quantity={quantity}",
                          f"time={options.time:g}", *more])


def result_lines(drop, star, options):
    def make(name, *more):
        return line(options, name, *more)

    if not options.only:
        yield from attempt(["p"], lambda: pressure_lines(drop, nearest(drop, star), options), make)
        yield from attempt(["velocity"], lambda: velocity_lines(drop, options), make)
    yield from attempt(["sphericity"], lambda: shape_lines(drop, drop.outline(star)[1], options),
                       make)
    yield from attempt(["volume"], lambda: volume_lines(drop, star, options), make)


def nearest(drop, star):
    """Distance of the outline from the centre."""
    return min(star.radii(drop.outline(star)[0]))


def volume_lines(drop, star, options):
    fit, _ = drop.outline(star)
    volume = 1.0 / drop.density(min(star.radii(fit)))
    yield line(options, "volume", f"value={volume:.5f}", "reference=1",
               f"outline={star.measures(fit)[0] / drop.volume:.5f}", f"layer={drop.layer():.3f}")


def pressure_lines(drop, distance, options):
    p_exact = (drop.dim - 1) * options.sigma / drop.R
    p, count = drop.pressure(distance)
    yield line(options, "p", f"value={p:.6g}", f"reference={p_exact:.6g}",
               f"l2={abs(p / p_exact - 1):.3e}", f"deep={count}")


def velocity_lines(drop, options):
    scale = math.sqrt(options.sigma / (options.rho * drop.R))
    yield line(options, "velocity", f"value={max(drop.speeds()) / scale:.5f}", "reference=0")


def shape_lines(drop, inner, options):
    radii = drop.radii()
    off = [(r - drop.R) / drop.d for r in radii]
    yield line(options, "sphericity", f"value={max(radii) / drop.R:.4f}", "reference=1",
               f"linf={max(map(abs, off)):.3f}", f"l2={math.sqrt(mean([a * a for a in off])):.3f}",
               f"inner={inner}")


def mode_lines(drop, options):
    """Frequency and damping; the first tenth of the series, in which particles settle, is left
    out."""
    series = read_series(options.mode)
    times, values = ([float(a) for a in series[name][len(series["t"]) // 10:]]
                     for name in ("t", "a"))
    nu = options.nu / math.sqrt(options.sigma * drop.R / options.rho)
    leading = oscillation.inviscid(drop.dim, 2, nu)
    exact = oscillation.viscous(drop.dim, 2, nu)
    *found, rest = oscillation.fit(times, values, *exact)
    for k, name in enumerate(("frequency", "damping")):
        error = abs(found[k] / exact[k] - 1.0) if exact[k] else math.nan
        yield line(options, name, f"value={found[k]:.5f}", f"reference={exact[k]:.5f}",
                   f"l2={error:.3e}", f"leading={leading[k]:.5f}", f"rest={rest:.3f}")


def write_series(path, rows):
    lines = ["# " + " ".join(ENERGY)]
    lines += [" ".join(f"{row[name]:.8g}" for name in ENERGY) for row in rows]
    Path(path).write_text("\n".join(lines) + "\n", encoding="ascii")


def parse():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("dump")
    parser.add_argument("--case", required=True, help="name for the result lines")
    parser.add_argument("--dim", type=int, default=3, choices=(2, 3))
    parser.add_argument("-d", type=float, required=True, help="particle spacing")
    parser.add_argument("--rho", type=float, required=True)
    parser.add_argument("--sigma", type=float, required=True)
    parser.add_argument("--time", type=float, default=0.0, help="as it stands on the result lines")
    parser.add_argument("--only", choices=("shape",), help="sphericity and volume")
    parser.add_argument("--energy", action="store_true", help="measure all frames")
    parser.add_argument("--series", metavar="FILE")
    parser.add_argument("--mode", metavar="SERIES", help="amplitude of the mode n = 2")
    parser.add_argument("--nu", type=float, default=0.0, help="kinematic viscosity")
    parser.add_argument("--print", dest="output", metavar="FILE")
    return parser.parse_args()


def main():
    options = parse()
    rows, star, drop = energy_rows(frames(options.dump, options.dim), options)
    star = star or star_for(drop)
    lines = list(result_lines(drop, star, options))
    if rows:
        energies = [row["energy"] for row in rows]
        lines.append(line(options, "energy", f"value={energies[-1]:.5f}", "reference=1",
                          f"rise={largest_rise(energies):.2e}"))
    if options.mode:
        lines += attempt(["frequency", "damping"], lambda: mode_lines(drop, options),
                         lambda name, *more: line(options, name, *more))
    if options.series:
        write_series(options.series, rows)
    if options.output:
        Path(options.output).write_text("".join(lines), encoding="ascii")
    else:
        print("".join(lines), end="")


if __name__ == "__main__":
    main()
