#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Lid-driven cavity next to published and to spectral solutions: cavity.py DUMP... --lid LID --Re RE

--print FILE, of the last frame of a dump, as LAMMPS commands:
  flat lid (Re = 100, 400, 1000): u on the line x = 1/2, v on y = 1/2 and p on both at the points of
    the tables: l2, root mean square, and linf, largest difference; u-min, v-min, v-max: the extrema
  smooth lid (Re = 100): u (both components) and p of all fluid particles: l2, root mean square of the
    difference relative to that of the solution, and linf, the largest
In units of U and rho U^2; the pressure up to a constant.
--plot FILE.png: both profiles of one or more dumps over the tables (needs matplotlib; Debian:
python3-matplotlib).

The references are in tests/reference: cavity_botella_peyret_re1000.csv, and what
cavity_reference.py has made. Between particles a polynomial of third degree is used.
"""

import argparse
import math
from operator import mul
from pathlib import Path

from dumps import finite_rows, last_snapshot, need_columns, need_time
from series import attempt, mean, print_command, pyplot, read_table
from star import dot, least_squares

REFERENCE = Path(__file__).resolve().parents[1] / "tests" / "reference"
NAMES = ("x", "y", "vx", "vy", "d_aleisph_p")
REACH = 3.2    # radius of the fit of a polynomial, in spacings
FINE = 400     # points of a line among which extrema are looked for
# Extrema on the centre lines. Re = 100 and 400: cavity_reference.py --lid flat -n 56 64; 1000: O.
# Botella, R. Peyret, Comput. Fluids 27, 421 (1998), whose values for Re = 100 are the same to 1e-6.
EXTREMA = {100: {"u-min": -0.214042, "v-max": 0.179573, "v-min": -0.253803},
           400: {"u-min": -0.328730, "v-max": 0.303830, "v-min": -0.454062},
           1000: {"u-min": -0.388570, "v-max": 0.376945, "v-min": -0.527077}}


# --- particles ------------------------------------------------------------------------------------

def last_frame(path):
    """(time, rows of all particles)"""
    snapshot = last_snapshot(path)
    need_columns(snapshot.names, ("type", *NAMES), path)
    return (need_time(snapshot, path),
            finite_rows(snapshot.dicts(), NAMES, f"{path}, step {snapshot.step}"))


def is_fluid(row):
    return row["type"] == 1


class Interpolation:
    """Values between particles: a cubic through those near a point, by least squares, in which the
    nearest ones count so much that it takes their values where it meets them."""

    def __init__(self, rows):
        self.d = 1.0 / round(math.sqrt(len(rows)) - 1)    # (n + 1)^2 particles, walls included
        self.cells = {}
        for row in rows:
            self.cells.setdefault(self.cell(row["x"], row["y"]), []).append(row)

    def cell(self, x, y):
        return math.floor(x / self.d), math.floor(y / self.d)

    def near(self, x, y):
        reach = math.ceil(REACH)
        column, line = self.cell(x, y)
        for a in range(column - reach, column + reach + 1):
            for b in range(line - reach, line + reach + 1):
                yield from self.cells.get((a, b), ())

    def __call__(self, x, y, names):
        columns, values = [], []
        for row in self.near(x, y):
            a, b = (row["x"] - x) / self.d, (row["y"] - y) / self.d
            r2 = a * a + b * b
            if r2 < REACH * REACH:
                w = 1.0 / (r2 + 1e-2)**2
                columns.append([w * a**i * b**j for i in range(4) for j in range(4 - i)])
                values.append([w * row[name] for name in names])
        if len(columns) < 10:
            raise ValueError(f"{len(columns)} particles near ({x:g}, {y:g}), too few")
        columns = list(zip(*columns))
        return [least_squares(columns, list(column))[0] for column in zip(*values)]


# --- the flat lid ---------------------------------------------------------------------------------

def tables(Re):
    """{"u": rows (coordinate, velocity, pressure or None) inside of the line, "v": ...}; columns:
    also those of Ghia, or None."""
    if Re == 1000:
        rows = read_table(REFERENCE / "cavity_botella_peyret_re1000.csv")
    else:
        rows = [row for row in read_table(REFERENCE / "cavity_flat_lid.csv")
                if float(row["Re"]) == Re]
    if not rows:
        raise ValueError(f"there is no table for Re = {Re:g}, but for 100, 400 and 1000")
    found = {"u": [], "v": []}
    for row in rows:
        s = float(row["coordinate"])
        if 0.0 < s < 1.0:
            found[row["line"][0]].append((s, float(row["velocity"]), float(row["pressure"]),
                                          float(row["ghia"]) if "ghia" in row else None))
    return found


def place(line, s):
    """Point and velocity component of a centre line."""
    return (0.5, s, "vx") if line == "u" else (s, 0.5, "vy")


def profile(field, line, points):
    """[(velocity, pressure)]"""
    found = []
    for s in points:
        x, y, name = place(line, s)
        found.append(field(x, y, (name, "d_aleisph_p")))
    return found


def result(time, quantity, *more):
    return print_command(["case=cavity", f"quantity={quantity}", f"time={time:.6g}", *more])


def size(errors):
    return f"l2={math.sqrt(mean([e * e for e in errors])):.4g}", f"linf={max(map(abs, errors)):.4g}"


def flat_lines(field, Re, time):
    pressure = []
    for line, rows in tables(Re).items():
        found = profile(field, line, [row[0] for row in rows])
        pressure += [f[1] - row[2] for f, row in zip(found, rows)]
        yield result(time, line, *size([f[0] - row[1] for f, row in zip(found, rows)]))
    level = mean(pressure)
    yield result(time, "p", *size([e - level for e in pressure]))
    inner = [(k + 0.5) / FINE for k in range(FINE)]
    lines = {line: [f[0] for f in profile(field, line, inner)] for line in "uv"}
    for name, exact in EXTREMA[Re].items():
        value = (max if name.endswith("max") else min)(lines[name[0]])
        yield result(time, name, f"value={value:.5f}", f"reference={exact:.5f}")


# --- the smooth lid -------------------------------------------------------------------------------

def chebyshev(s, count):
    """T_k(2 s - 1) and their slopes with s."""
    z = 2.0 * s - 1.0
    T, D = [1.0, z], [0.0, 2.0]
    for _ in range(2, count):
        D.append(4.0 * T[-1] + 2.0 * z * D[-1] - D[-2])
        T.append(2.0 * z * T[-1] - T[-2])
    return T, D


class SmoothLid:
    """The spectral solution at any point."""

    def __init__(self):
        rows = read_table(REFERENCE / "cavity_smooth_lid.csv")
        self.count = 1 + max(int(row[name]) for row in rows for name in "kl")
        self.series = {name: [[0.0] * self.count for _ in range(self.count)] for name in ("psi", "p")}
        for row in rows:
            for name, c in self.series.items():
                c[int(row["l"])][int(row["k"])] = float(row[name])
        self.lines = {}

    def line(self, x):
        """Series in y of psi, psi_x and p at one x: particles of a lattice share it."""
        if x not in self.lines:
            T, D = chebyshev(x, self.count)
            self.lines[x] = [[dot(row, f) for row in self.series[name]]
                             for name, f in (("psi", T), ("psi", D), ("p", T))]
        return self.lines[x]

    def __call__(self, x, y):
        """(u, v, p)"""
        psi, psi_x, p = self.line(x)
        T, D = chebyshev(y, self.count)
        return sum(map(mul, psi, D)), -sum(map(mul, psi_x, T)), sum(map(mul, p, T))


def relative(errors, exact):
    l2 = math.sqrt(dot(errors, errors) / dot(exact, exact))
    return f"l2={l2:.4g}", f"linf={max(map(abs, errors)):.4g}"


def smooth_lines(rows, Re, time):
    if Re != 100:
        raise ValueError("the spectral solution is for Re = 100")
    exact = SmoothLid()
    fluid = [row for row in rows if is_fluid(row)]
    u, v, p = zip(*(exact(row["x"], row["y"]) for row in fluid))
    speed = list(map(math.hypot, u, v))
    yield result(time, "u", *relative([math.hypot(row["vx"] - a, row["vy"] - b)
                                       for row, a, b in zip(fluid, u, v)], speed))
    p = [a - mean(p) for a in p]
    level = mean([row["d_aleisph_p"] for row in fluid])
    yield result(time, "p", *relative([row["d_aleisph_p"] - level - a
                                       for row, a in zip(fluid, p)], p))


# --- the command ----------------------------------------------------------------------------------

def result_lines(path, lid, Re):
    time, rows = last_frame(path)
    if lid == "smooth":
        yield from attempt(["u", "p"], lambda: smooth_lines(rows, Re, time),
                           lambda name, value: result(time, name, value))
    else:
        yield from attempt(["u", "v", "p", *EXTREMA[100]],
                           lambda: flat_lines(Interpolation(rows), Re, time),
                           lambda name, value: result(time, name, value))


def plot(paths, Re, picture):
    plt = pyplot()
    figure, panels = plt.subplots(1, 2, figsize=(10, 4.4), constrained_layout=True)
    points = [(k + 0.5) / FINE for k in range(FINE)]
    for axes, (line, rows) in zip(panels, tables(Re).items()):
        for path in paths:
            found = profile(Interpolation(last_frame(path)[1]), line, points)
            axes.plot(points, [f[0] for f in found], label=path if len(paths) > 1 else "ALE-ISPH")
        s, values, _, ghia = zip(*rows)
        axes.plot(s, values, "ko", markersize=4.5, markerfacecolor="none",
                  label="Botella & Peyret" if Re == 1000 else "spectral")
        if ghia[0] is not None:
            axes.plot(s, ghia, "k+", markersize=6, label="Ghia, Ghia & Shin")
        axes.set(xlabel="y" if line == "u" else "x", xlim=(0, 1),
                 ylabel="u at x = 1/2" if line == "u" else "v at y = 1/2")
        axes.grid(alpha=0.3)
    panels[0].legend(fontsize=9)
    figure.suptitle(f"Re = {Re:g}")
    figure.savefig(picture, dpi=80)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("dumps", nargs="+", help="one to measure, or several to plot")
    parser.add_argument("--lid", choices=("flat", "smooth"), default="flat")
    parser.add_argument("--Re", type=float, required=True)
    parser.add_argument("--print", dest="output", metavar="FILE")
    parser.add_argument("--plot", metavar="PICTURE")
    options = parser.parse_args()
    if options.output:
        lines = list(result_lines(options.dumps[0], options.lid, options.Re))
        Path(options.output).write_text("".join(lines), encoding="ascii")
    if options.plot:
        plot(options.dumps, options.Re, options.plot)


if __name__ == "__main__":
    main()
