#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Free elliptical drop next to its exact solution: ellipse.py DUMP | SERIES... [options]

A disc of inviscid fluid, radius R, starts with u = A x, v = -A y. It stays an ellipse with u = s' x,
v = -s' y, semi-axes a = R exp(s), b = R exp(-s), and p = pc (1 - (x/a)^2 - (y/b)^2). The momentum
equation gives pc = rho s'^2 a^2 b^2/(a^2 + b^2) and conserves the kinetic energy pi rho R^4 A^2/4, hence
  s' = A/sqrt(cosh 2s),  s(0) = 0;   pc = rho A^2 R^2/(2 cosh(2s)^2).
(The flow: J. J. Monaghan, J. Comput. Phys. 110, 399, 1994.) s(t) is found by the classical
Runge-Kutta method.

--print FILE, of the last frame of a dump (--time: its time), as LAMMPS commands; R of the exact solution
is that of a disc as large as all particles together:
  a, b   semi-axes of the region where the kernel sum V sum_j W exceeds 1/2: from its second moments
  area   of that region; a void makes it larger than that of the drop
  p      pressure at the centre, as given (--pressure), next to the exact one
--plot FILE.png: semi-axes and pressure in one or more files series.ellipse (needs matplotlib;
Debian: python3-matplotlib). --outline FILE writes the exact outline at times of the dump, which
render.py draws (tests/reference/ellipse_outline.csv).
"""

import argparse
import math
from pathlib import Path

from dumps import finite_rows, last_snapshot, need_columns
from series import attempt, print_command, pyplot, read_series
from square_patch import CELLS, kernel_sum

STEP = 1e-3     # A times the step of the exact solution: its error is of the order 1e-13


def strain(t):
    """s at the time t, with A = 1."""
    def rate(s):
        return 1.0 / math.sqrt(math.cosh(2.0 * s))
    steps = max(1, math.ceil(t / STEP))
    h, s = t / steps, 0.0
    for _ in range(steps):
        k1 = rate(s)
        k2 = rate(s + 0.5 * h * k1)
        k3 = rate(s + 0.5 * h * k2)
        s += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + rate(s + h * k3))
    return s


def exact(t):
    """{"a", "b", "p"} with R = A = rho = 1."""
    s = strain(t)
    return {"a": math.exp(s), "b": math.exp(-s), "p": 0.5 / math.cosh(2.0 * s)**2}


def shape(rows, d):
    """(area, a, b) of the region where the kernel sum exceeds 1/2."""
    total = kernel_sum([(row["x"], row["y"]) for row in rows], d)
    cells = [cell for cell, value in total.items() if value > 0.5]
    if not cells:
        raise ValueError("there is no fluid where the kernel sum exceeds 1/2")
    g, n = d / CELLS, len(cells)
    means = [sum(cell[axis] for cell in cells) / n for axis in (0, 1)]
    axes = [2.0 * g * math.sqrt(sum((cell[axis] - m)**2 for cell in cells) / n)
            for axis, m in enumerate(means)]
    return n * g * g, *axes


def result_lines(dump, time, d, pressure):
    names = ("x", "y")
    snapshot = last_snapshot(dump)
    need_columns(snapshot.names, names, dump)
    rows = finite_rows(snapshot.dicts(), names, f"{dump}, step {snapshot.step}")
    volume = len(snapshot.rows) * d * d
    R = math.sqrt(volume / math.pi)
    right = exact(time)
    right = {"area": volume, "a": R * right["a"], "b": R * right["b"], "p": R * R * right["p"]}

    def line(name, *more):
        return print_command(["case=ellipse", f"quantity={name}", f"time={time:g}", *more])

    def measures():
        for name, value in zip(("area", "a", "b"), shape(rows, d)):
            yield line(name, f"value={value:.5f}", f"reference={right[name]:.5f}")

    yield from attempt(["area", "a", "b"], measures, line)
    yield line("p", f"value={pressure:.5f}", f"reference={right['p']:.5f}")


def plot(paths, picture):
    plt = pyplot()
    figure, panels = plt.subplots(1, 3, figsize=(12, 3.6), constrained_layout=True)
    runs = {path: read_series(path) for path in paths}
    end = max(series["t"][-1] for series in runs.values())
    times = [end * k / 100 for k in range(101)]
    right = [exact(t) for t in times]
    for axes, name, title in zip(panels, "abp", ("semi-axis a/R", "semi-axis b/R",
                                                 "pressure at the centre/(rho A^2 R^2)")):
        axes.plot(times, [row[name] for row in right], "k", linewidth=3, alpha=0.35, label="exact")
        for path, series in runs.items():
            axes.plot(series["t"], series[name], linewidth=1, label=path)
        axes.set(title=title, xlabel="A t", xlim=(0, end))
        axes.grid(alpha=0.3)
    panels[2].set_ylim(0, 0.6)
    panels[0].legend(fontsize=8)
    figure.savefig(picture, dpi=80)


def write_outline(path):
    lines = ["# Free elliptical drop, exact outline: made by tools/ellipse.py --outline", "A_t,x,y"]
    for t in (0.0, 0.5, 1.0, 1.5, 2.0):
        now = exact(t)
        for k in range(101):
            angle = 2.0 * math.pi * k / 100
            lines.append(f"{t:g},{now['a'] * math.cos(angle):.6f},{now['b'] * math.sin(angle):.6f}")
    Path(path).write_text("\n".join(lines) + "\n", encoding="ascii")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="*", help="a dump to measure, or series to plot")
    parser.add_argument("--time", type=float, help="A t of the last frame")
    parser.add_argument("-d", type=float, help="particle spacing")
    parser.add_argument("--pressure", type=float, default=math.nan, help="at the centre")
    parser.add_argument("--print", dest="output", metavar="FILE")
    parser.add_argument("--plot", metavar="PICTURE")
    parser.add_argument("--outline", metavar="FILE")
    options = parser.parse_args()
    if options.output:
        lines = list(result_lines(options.files[0], options.time, options.d, options.pressure))
        Path(options.output).write_text("".join(lines), encoding="ascii")
    if options.plot:
        plot(options.files, options.plot)
    if options.outline:
        write_outline(options.outline)


if __name__ == "__main__":
    main()
