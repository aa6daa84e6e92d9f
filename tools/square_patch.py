#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Shape and pressure of examples/square-patch: square_patch.py FILE... --print FILE | --plot PNG

--print, of the last frame of a dump, as LAMMPS commands:
  area      of the region where the kernel sum V sum_j W exceeds 1/2, counted on a fine grid;
            reference: the volume of the particles
  surface   number of surface particles; reference: length of the edge of that region over d
  outline   distance of the surface from the exact outline, at times it is known for, in spacings.
            The surface lies half a spacing outside the surface particles, or what --inset says. The
            outer fifth of the arms, which are a few spacings thick, is left out.
--plot: pressure at the centre in one or several files series.square-patch over the exact one
(needs matplotlib; Debian: python3-matplotlib)
"""

import argparse
import math
from pathlib import Path

from dumps import finite_rows, last_snapshot, need_columns
from series import attempt, mean, print_command, pyplot, read_series, read_table

REFERENCE = Path(__file__).resolve().parents[1] / "tests" / "reference"
H_OVER_D = 1.2     # kernel of the area: cubic spline, whatever the run uses
CELLS = 4          # grid cells in a spacing


def last_frame(path):
    """Rows of the last snapshot, each a dict of numbers."""
    names = ("x", "y", "nx", "ny", "surface")
    snapshot = last_snapshot(path)
    need_columns(snapshot.names, names, path)
    return finite_rows(snapshot.dicts(), names, f"{path}, step {snapshot.step}")


def kernel(q2):
    """Cubic spline in 2d times h^2, of (r/h)^2."""
    q = math.sqrt(q2)
    shape = 1.0 - 1.5 * q2 + 0.75 * q2 * q if q < 1.0 else 0.25 * (2.0 - q)**3
    return 10.0 / (7.0 * math.pi) * shape


def kernel_sum(points, d):
    """V sum_j W on the points of a grid, {(column, row): sum}; the grid has CELLS cells in d."""
    g, support = d / CELLS, 2.0 * H_OVER_D * CELLS    # the support in cells
    scale, share = 1.0 / (H_OVER_D * CELLS)**2, 1.0 / H_OVER_D**2
    total = {}
    for x, y in points:
        x, y = x / g, y / g
        for row in range(math.ceil(y - support), math.floor(y + support) + 1):
            half = math.sqrt(max(support**2 - (row - y)**2, 0.0))
            for column in range(math.ceil(x - half), math.floor(x + half) + 1):
                w = share * kernel(min(((column - x)**2 + (row - y)**2) * scale, 4.0))
                total[column, row] = total.get((column, row), 0.0) + w
    return total


def segment(values):
    """Length of the line value = 1/2 in a cell, of its corners (0,0), (1,0), (1,1), (0,1)."""
    corners = ((0, 0), (1, 0), (1, 1), (0, 1))
    cuts = []
    for k in range(4):
        a, b = values[k] - 0.5, values[(k + 1) % 4] - 0.5
        if (a > 0) != (b > 0):
            (x0, y0), (x1, y1) = corners[k], corners[(k + 1) % 4]
            cuts.append((x0 + (x1 - x0) * a / (a - b), y0 + (y1 - y0) * a / (a - b)))
    return sum(math.dist(*cuts[k:k + 2]) for k in range(0, len(cuts), 2))


def area_and_edge(total, g):
    """Area where the sum exceeds 1/2, and the length of its edge."""
    cells = sum(value > 0.5 for value in total.values())
    edge = 0.0
    for column, row in total:
        square = ((column, row), (column + 1, row), (column + 1, row + 1), (column, row + 1))
        values = [total.get(corner, 0.0) for corner in square]
        if min(values) <= 0.5 < max(values):
            edge += segment(values)
    return cells * g * g, edge * g


def exact_outline(time, side):
    """The four pieces of the outline as lists of points; none if it is not known at this time."""
    rows = read_table(REFERENCE / "square_patch_free_surface.csv")
    piece = [complex(float(row["x"]), float(row["y"])) * side for row in rows
             if abs(float(row["omega_t"]) - time) < 1e-4]
    return [[z * turn for z in piece] for turn in (1, 1j, -1, -1j)] if piece else []


def distance(z, piece):
    """Of a point from a line through points."""
    best = math.inf
    for a, b in zip(piece, piece[1:]):
        along = (z - a) * (b - a).conjugate() / abs(b - a)**2
        best = min(best, abs(z - a - min(max(along.real, 0.0), 1.0) * (b - a)))
    return best


def outline_error(rows, pieces, d, radius, inset=0.5):
    """(rms, largest) distance of the surface from the outline within a radius, in spacings. inset:
    how far particles of the surface are inside of it."""
    surface = [complex(row["x"] + inset * d * row["nx"], row["y"] + inset * d * row["ny"])
               for row in rows if row["surface"]]
    errors = [min(distance(z, piece) for piece in pieces) / d for z in surface if abs(z) < radius]
    if not errors:
        raise ValueError(f"no surface particle within {radius:.3g} of the centre")
    return math.sqrt(mean([e * e for e in errors])), max(errors)


def line(quantity, time, *more):
    return print_command(["case=square-patch", f"quantity={quantity}", f"time={time:g}", *more])


def result_lines(dump, time, d, side, inset=0.5):
    rows = last_frame(dump)
    area, edge = area_and_edge(kernel_sum([(row["x"], row["y"]) for row in rows], d), d / CELLS)
    count = sum(row["surface"] != 0 for row in rows)
    yield line("area", time, f"value={area / side**2:.5f}",
               f"reference={len(rows) * d**2 / side**2:.6g}")
    yield line("surface", time, f"value={count}", f"reference={edge / d:.1f}")
    pieces = exact_outline(time, side)
    if pieces:
        radius = 0.8 * math.sqrt(0.5 * (1.0 + time**2)) * side

        def outline():
            rms, largest = outline_error(rows, pieces, d, radius, inset)
            return [line("outline", time, f"l2={rms:.3f}", f"linf={largest:.3f}")]
        yield from attempt(["outline"], outline, lambda name, value: line(name, time, value))


def plot(paths, picture):
    plt = pyplot()
    figure, (pressure, error) = plt.subplots(1, 2, figsize=(11, 4.2), constrained_layout=True)
    table = read_table(REFERENCE / "square_patch_centre_pressure.csv")
    pressure.plot([float(row["t"]) for row in table], [float(row["p0"]) for row in table], "k",
                  linewidth=2.5, alpha=0.4, label="boundary integral")
    end = 0.0
    for path in paths:
        series = read_series(path)
        pressure.plot(series["t"], series["p"], label=path)
        error.plot(series["t"], [p - q for p, q in zip(series["p"], series["p_ref"])], label=path)
        end = max(end, series["t"][-1])
    pressure.set(xlim=(0, end), ylim=(-0.16, 0.0), title="pressure at the centre")
    error.set(xlim=(0, end), ylim=(-0.015, 0.015), title="its error")
    for axes in (pressure, error):
        axes.set(xlabel="omega t", ylabel="p/(rho omega^2 L^2)")
        axes.grid(alpha=0.3)
    pressure.legend(fontsize=8)
    figure.savefig(picture, dpi=80)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("files", nargs="+", help="a dump to measure, or series to plot")
    parser.add_argument("--time", type=float, help="omega t of the last frame")
    parser.add_argument("-d", type=float, help="particle spacing")
    parser.add_argument("-L", type=float, help="side of the square")
    parser.add_argument("--inset", type=float, default=0.5,
                        help="of surface particles from the surface, in spacings")
    parser.add_argument("--print", dest="output", metavar="FILE")
    parser.add_argument("--plot", metavar="PICTURE")
    options = parser.parse_args()
    if options.output:
        lines = list(result_lines(options.files[0], options.time, options.d, options.L,
                                  options.inset))
        Path(options.output).write_text("".join(lines), encoding="ascii")
    if options.plot:
        plot(options.files, options.plot)


if __name__ == "__main__":
    main()
