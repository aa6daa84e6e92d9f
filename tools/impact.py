#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Pressure impulse of two impacts on water: impact.py DUMP... --scene plate|patch --print | --plot

At an impact the pressure is large for a short time; its integral P over this time obeys lap P = 0, P =
0 on a free surface, dP/dn = -rho (change of the normal velocity) on a wall, and the velocity changes
by -grad P/rho (M. J. Cooker, D. H. Peregrine, J. Fluid Mech. 297, 193, 1995). Sums over odd n:
  plate  a wall x = 0 of a tank of depth H gets the velocity U, the tank is long:
           P = sum 8 rho U H/(n pi)^2 sin(n pi y'/2H) exp(-n pi x/2H), y' from the surface downwards
         impulse on the plate: rho U H^2 (16/pi^3) sum n^-3 = 0.542755 rho U H^2
  patch  a block, L wide and H high, falls on a wall y = 0 with the velocity U:
           P = sum 4 rho U L/(n pi)^2 sin(n pi x/L) sinh(n pi (H - y)/L)/cosh(n pi H/L)
         impulse on the wall: rho U L^2 (8/pi^3) sum tanh(n pi H/L) n^-3, for a square 0.270415;
         energy lost: half of this times U

--print FILE writes result lines as LAMMPS commands: impulse and, of the patch, energy, as measured by
the input file, next to the exact ones; P of all fluid particles: l2, root mean square of the difference
from the exact one relative to the root mean square of that, and linf, the largest difference in rho U H
or rho U L. --plot FILE.png: P on the wall in one or more dumps over the exact one (needs matplotlib;
Debian: python3-matplotlib). A dump has x, y, type and v_P, P in these units.
"""

import argparse
import math
from pathlib import Path

from dumps import finite_rows, last_snapshot, need_columns
from series import attempt, print_command, pyplot
from star import dot

TERMS = range(1, 400, 2)    # the last ones are 8/(399 pi)^2 = 5e-6, where they do not decay
NAMES = ("x", "y", "v_P")


def plate(x, y):
    """P of the plate, y from the floor; H = 1."""
    return sum(8.0 / (n * math.pi)**2 * math.sin(0.5 * n * math.pi * (1.0 - y))
               * math.exp(-0.5 * n * math.pi * x) for n in TERMS if n * x < 40.0)


def patch(x, y, height):
    """P of the patch, which stands on 0 < x < 1; L = 1."""
    total = 0.0
    for n in TERMS:
        a = n * math.pi
        if a * y > 60.0:
            break
        share = math.exp(-a * y) - math.exp(-a * (2.0 * height - y))    # without large numbers
        total += 4.0 / a**2 * math.sin(a * x) * share / (1.0 + math.exp(-2.0 * a * height))
    return total


def impulse(scene, height):
    if scene == "plate":
        return 16.0 / math.pi**3 * sum(n**-3 for n in range(1, 4001, 2))
    return 8.0 / math.pi**3 * sum(math.tanh(n * math.pi * height) / n**3 for n in range(1, 4001, 2))


def last_frame(path):
    snapshot = last_snapshot(path)
    need_columns(snapshot.names, ("type", *NAMES), path)
    return finite_rows(snapshot.dicts(), NAMES, f"{path}, step {snapshot.step}")


def result_lines(path, options):
    scene, height = options.scene, options.height
    rows = [row for row in last_frame(path) if row["type"] == 1]

    def line(name, *more):
        return print_command(["case=impact", f"quantity={name}", *more])

    def field():
        exact = [plate(row["x"], row["y"]) if scene == "plate" else
                 patch(row["x"], row["y"], height) for row in rows]
        errors = [row["v_P"] - p for row, p in zip(rows, exact)]
        return [line("P", f"l2={math.sqrt(dot(errors, errors) / dot(exact, exact)):.4g}",
                     f"linf={max(map(abs, errors)):.4g}")]

    yield from attempt(["P"], field, line)
    total = impulse(scene, height)
    yield line("impulse", f"value={options.impulse:.5f}", f"reference={total:.5f}")
    if scene == "patch":
        yield line("energy", f"value={options.energy:.5f}", f"reference={0.5 * total:.5f}")


def on_wall(rows, scene):
    """[(place, P)] along the plate, or along the wall under the patch."""
    across, along = ("x", "y") if scene == "plate" else ("y", "x")
    wall = sorted((row[along], row["v_P"]) for row in rows
                  if row["type"] == 2 and abs(row[across]) < 1e-6)
    return [(s, p) for s, p in wall if 0.0 <= s <= 1.0]


def plot(paths, scene, height, picture):
    plt = pyplot()
    figure, axes = plt.subplots(figsize=(6, 4), constrained_layout=True)
    places = [k / 200 for k in range(201)]
    exact = [plate(0.0, s) if scene == "plate" else patch(s, 0.0, height) for s in places]
    axes.plot(places, exact, "k", linewidth=3, alpha=0.35, label="exact")
    for path in paths:
        s, p = zip(*on_wall(last_frame(path), scene))
        axes.plot(s, p, "o-", markersize=3, linewidth=0.7, label=path)
    axes.set(xlabel="y/H on the plate" if scene == "plate" else "x/L on the wall", xlim=(0, 1),
             ylabel="P/(rho U H)" if scene == "plate" else "P/(rho U L)")
    axes.grid(alpha=0.3)
    axes.legend(fontsize=9)
    figure.savefig(picture, dpi=80)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("dumps", nargs="+", help="one to measure, or several to plot")
    parser.add_argument("--scene", choices=("plate", "patch"), required=True)
    parser.add_argument("--height", type=float, default=1.0, help="H/L of the patch")
    parser.add_argument("--impulse", type=float, default=math.nan, help="measured on the wall")
    parser.add_argument("--energy", type=float, default=math.nan, help="that the patch has lost")
    parser.add_argument("--print", dest="output", metavar="FILE")
    parser.add_argument("--plot", metavar="PICTURE")
    options = parser.parse_args()
    if options.output:
        lines = list(result_lines(options.dumps[0], options))
        Path(options.output).write_text("".join(lines), encoding="ascii")
    if options.plot:
        plot(options.dumps, options.scene, options.height, options.plot)


if __name__ == "__main__":
    main()
