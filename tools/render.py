#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Draws a LAMMPS dump of particles as a picture: render.py DUMP PICTURE.png [options]

One panel per field (--fields) and snapshot (--frame), every particle a disc as large as its
spacing; with --profile a further panel of velocity profiles at all times of the dump, next to the
exact solution. In three dimensions the fields show the particles near a plane (--slice z=0).
Colors and axes do not follow single particles that are far off all others; how many lie outside of
them stands on stderr and in the title. Needs numpy and matplotlib (Debian: python3-matplotlib).
"""

import argparse
import io
import sys

from series import pyplot

plt = pyplot()    # it says what is missing, so before the others
import numpy as np  # noqa: E402
from PIL import Image  # noqa: E402  (matplotlib needs it, too)
from matplotlib.collections import EllipseCollection  # noqa: E402

from dumps import Frame, finite, read_frames, warn  # noqa: E402
from profiles import PROFILES  # noqa: E402

LABELS = {"speed": "|v|", "d_aleisph_p": "p", "vx": "u", "vy": "v", "vz": "w", "v_P": "P"}


def field(frame, name):
    if name == "speed":
        return np.sqrt(frame["vx"]**2 + frame["vy"]**2 + frame["vz"]**2)
    return frame["d_aleisph_p" if name == "p" else name]


def slice_mask(frame, word):
    """Particles near the plane 'axis=value': half the mean distance of particles on either side."""
    if word is None:
        return np.ones(len(frame), dtype=bool)
    axis, value = word.split("=")
    extent = [np.ptp(limits_without_strays(frame[a])) for a in "xyz"]
    thickness = (np.prod(extent) / len(frame))**(1 / 3)
    return np.abs(frame[axis] - float(value)) < 0.5 * thickness


def spacing(frame, sample=200):
    """Median distance to the nearest neighbor in space, of some of the particles: in a projection
    particles may lie on each other."""
    x = np.column_stack([frame[a] for a in "xyz"])
    chosen = np.linspace(0, len(x) - 1, min(sample, len(x))).astype(int)
    nearest = []
    for k in chosen:
        distance = np.sum((x - x[k])**2, axis=1)
        distance[k] = np.inf
        nearest.append(distance.min())
    return np.sqrt(np.median(nearest))


def covered(x, y, size):
    """How many particles lie on others in the picture: in the same cell of a tenth of a spacing."""
    cells = np.floor(np.column_stack([x, y]) / (0.1 * size) + 0.5)
    return len(x) - len(np.unique(cells, axis=0))


def limits_without_strays(values):
    """(low, high) of the values, but not of those that are farther off the others than these are
    apart: the largest and smallest hundredth, one at least, say nothing about the others."""
    ordered = np.sort(values)
    cut = max(1, len(ordered) // 100)
    if len(ordered) < 5 or ordered[cut] == ordered[-1 - cut]:
        return ordered[0], ordered[-1]
    low, high = ordered[cut], ordered[-1 - cut]
    return (ordered[ordered >= low - (high - low)][0], ordered[ordered <= high + (high - low)][-1])


def discs(axes, x, y, size, values, limits):
    """Particles as discs of diameter size; grey without values."""
    size = np.full(len(x), size)
    colors = {"facecolor": "0.75"} if values is None else {"array": values, "cmap": "viridis"}
    shapes = EllipseCollection(size, size, np.zeros(len(x)), units="x",
                               offsets=np.column_stack([x, y]), offset_transform=axes.transData,
                               linewidths=0, **colors)
    if values is not None:
        shapes.set_clim(*limits)
    axes.add_collection(shapes)
    return shapes


def arrow_places(x, y, mask, count):
    """One particle in each cell of a grid with count cells along x: the first one found."""
    cell = np.ptp(x[mask]) / count
    inside = np.flatnonzero(mask)
    column, row = ((a[inside] - a[mask].min()) // cell for a in (x, y))
    return inside[np.unique(np.column_stack([column, row]), axis=0, return_index=True)[1]]


def outline_pieces(path, time, copies):
    """Lines that a CSV file (time,x,y) holds for this time, turned to make a closed outline."""
    with open(path, encoding="ascii") as lines:
        rows = [line.split(",") for line in lines if line[:1].isdigit() and line.endswith("\n")]
    table = np.array(rows, dtype=float).reshape(-1, 3)
    piece = table[np.abs(table[:, 0] - time) < 1e-3]
    z = piece[:, 1] + 1j * piece[:, 2]
    if not len(z):
        warn(f"{path} holds no line for the time {time:.4g}")
    return [z * np.exp(2j * np.pi * k / copies) for k in range(copies)]


def draw_outline(axes, time, path, copies):
    for z in outline_pieces(path, time, int(copies)):
        axes.plot(z.real, z.imag, color="black", linewidth=0.8)


def color_limits(values, name, options):
    """Those of --limits, else of the values but for strays."""
    for field_name, low, high in options.limits:
        if field_name == name:
            return float(low), float(high)
    return limits_without_strays(values)


def outside(values, limits):
    return int(np.sum((values < limits[0]) | (values > limits[1])))


def selected(frame, keep):
    return Frame(frame.step, frame.time, {name: a[keep] for name, a in frame.columns.items()})


def visible(frame, name, options):
    """The particles that can be drawn: near the plane, with a place and a value."""
    where = f"step {frame.step}"
    columns = ["x", "y", "z", "type"]
    columns += ["vx", "vy", "vz"] if name == "speed" else ["d_aleisph_p" if name == "p" else name]
    frame = selected(frame, finite(frame, columns, where))
    if not len(frame):
        raise ValueError(f"{where}: no particle has a place and a value of {name}")
    near = selected(frame, slice_mask(frame, options.slice))
    if np.all(np.isin(near["type"], options.walls)):
        raise ValueError(f"{where}: no fluid particle is near the plane {options.slice}"
                         if options.slice else f"{where}: all particles are walls")
    return near, spacing(frame)


def report(x, y, size, values, limits, view):
    """Says what the picture does not show; the same in few words for its title."""
    hidden, beyond = covered(x, y, size), outside(x, view[0]) + outside(y, view[1])
    if hidden:
        warn(f"{hidden} of {len(x)} particles lie on others in this projection and are not seen")
    if beyond:
        warn(f"{beyond} of {len(x)} particles lie outside of the picture")
    off = outside(values, limits)
    if off:
        warn(f"{off} of {len(values)} values lie outside of the colors, {limits[0]:.4g} to "
             f"{limits[1]:.4g}; they go from {values.min():.4g} to {values.max():.4g}")
    words = [f"{beyond} particles outside"] * (beyond > 0) + [f"{off} off the colors"] * (off > 0)
    return f"   ({', '.join(words)})" if words else ""


def draw_field(figure, axes, frame, name, options):
    frame, size = visible(frame, name, options)
    first, second = options.axes
    fluid = ~np.isin(frame["type"], options.walls)
    x, y, values = frame[first], frame[second], field(frame, name)
    if not size > 0.0:
        raise ValueError(f"step {frame.step}: most particles lie on each other")
    discs(axes, x[~fluid], y[~fluid], size, None, None)
    limits = color_limits(values[fluid], name, options)
    shapes = discs(axes, x[fluid], y[fluid], size, values[fluid], limits)
    view = limits_without_strays(x), limits_without_strays(y)
    note = report(x, y, size, values[fluid], limits, view)
    if options.outline and frame.time is not None:
        draw_outline(axes, frame.time, *options.outline)
    if options.arrows:
        sample = arrow_places(x, y, fluid, options.arrows)
        axes.quiver(x[sample], y[sample], frame["v" + first][sample], frame["v" + second][sample],
                    color="white", pivot="middle", width=0.004)
    axes.set_xlim(view[0][0] - size, view[0][1] + size)
    axes.set_ylim(view[1][0] - size, view[1][1] + size)
    axes.set_aspect("equal")
    axes.set_xlabel(first)
    axes.set_ylabel(second)
    axes.ticklabel_format(scilimits=(-2, 3))
    unit = f" [{options.units}]" if options.units else ""
    time = "" if frame.time is None else f"t = {frame.time:.4g}"
    axes.set_title(f"{LABELS.get(name, name)}{unit}   {time}{note}")
    wide = np.ptp(view[0]) > 1.5 * np.ptp(view[1])
    figure.colorbar(shapes, ax=axes, orientation="horizontal" if wide else "vertical")


def coordinate(kind, frame):
    """Where a particle lies in a profile: radius in a pipe, else y."""
    return np.hypot(frame["y"], frame["z"]) if kind == "pipe" else frame["y"]


def draw_profile(axes, frames, kind, parameters):
    """u over the coordinate: dots are particles, lines the exact solution."""
    steps = [frame for frame in frames if frame.time]
    if not steps:
        raise ValueError("no profile: the dump has no times after 0 (dump_modify ... time yes)")
    chosen = steps if len(steps) <= 6 else [steps[k] for k in profile_choice(len(steps))]
    for number, frame in enumerate(chosen):
        color = plt.get_cmap("viridis")(0.85 * number / max(1, len(chosen) - 1))
        s = coordinate(kind, frame)
        grid = np.linspace(np.nanmin(s), np.nanmax(s), 200)
        axes.plot(grid, PROFILES[kind](grid, frame.time, *parameters), color=color,
                  label=f"t = {frame.time:.3g}")
        inside = np.isin(frame["type"], [1]) & np.isfinite(s) & np.isfinite(frame["vx"])
        axes.plot(s[inside], frame["vx"][inside], "o", color=color, markersize=3)
    axes.set_xlabel("r" if kind == "pipe" else "y")
    axes.set_title("u: particles (dots) and exact (lines)")
    axes.ticklabel_format(scilimits=(-2, 3))
    axes.grid(alpha=0.3)
    axes.legend(loc="center left", bbox_to_anchor=(1.0, 0.5))


def profile_choice(count):
    """About six of many frames, close together at first, where the flow changes fast."""
    return sorted({round(k) for k in np.geomspace(1, count, 6) - 1})


def parse():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("dump")
    parser.add_argument("picture")
    parser.add_argument("--fields", nargs="*", default=["speed"],
                        help="speed, p, or a column of the dump")
    parser.add_argument("--frame", nargs="+", type=int, default=[-1],
                        help="which snapshots; default: the last")
    parser.add_argument("--axes", default="xy", help="horizontal and vertical axis")
    parser.add_argument("--slice", help="plane of a 3d dump, such as z=0")
    parser.add_argument("--walls", nargs="*", type=int, default=[2], help="types drawn in grey")
    parser.add_argument("--arrows", type=int, default=0, help="so many arrows along the picture")
    parser.add_argument("--units", default="", help="unit of the field, for the title")
    parser.add_argument("--limits", nargs=3, action="append", default=[],
                        metavar=("FIELD", "LOW", "HIGH"), help="of the colors; can be repeated")
    parser.add_argument("--outline", nargs=2, metavar=("CSV", "COPIES"),
                        help="draw the line of columns time,x,y, turned COPIES times")
    parser.add_argument("--profile", nargs=4, metavar=("KIND", "A", "B", "C"),
                        help="pipe R G nu, plane H G nu, or couette H U nu")
    return parser.parse_args()


def overlap(one, other):
    return one.get_window_extent().overlaps(other.get_window_extent())


def clear_factors(figure):
    """Moves what lies on the factor of an axis (such as 1e7, also that of the colors): titles
    upwards, the names of horizontal axes downwards."""
    figure.canvas.draw()
    points = 72.0 / figure.dpi
    factors = [axis.offsetText for axes in figure.axes for axis in (axes.xaxis, axes.yaxis)
               if axis.offsetText.get_text()]
    for axes in figure.axes:
        below = [factor.get_window_extent() for factor in factors
                 if overlap(axes.xaxis.label, factor)]
        if below:
            axes.xaxis.labelpad += points * max(box.height for box in below)
        tops = [factor.get_window_extent().y1 for factor in factors if overlap(axes.title, factor)]
        if tops:
            pad = points * (max(tops) - axes.get_window_extent().y1)
            axes.set_title(axes.get_title(), pad=pad + plt.rcParams["axes.titlepad"])


def save(figure, path):
    """A PNG with a palette: a third of the size of one with full colors."""
    with io.BytesIO() as buffer:
        figure.savefig(buffer, dpi=110, bbox_inches="tight")
        Image.open(buffer).convert("RGB").quantize(256, kmeans=2).save(path, "PNG", optimize=True)


def frame_number(frames, k):
    try:
        return frames[k]
    except IndexError:
        raise ValueError(f"there is no snapshot {k}: the dump has {len(frames)}") from None


def draw(options):
    frames = read_frames(options.dump)
    shown = [(frame_number(frames, k), name) for k in options.frame for name in options.fields]
    panels = len(shown) + (options.profile is not None)
    figure, axes = plt.subplots(1, panels, figsize=(5.5 * panels, 4.2), squeeze=False,
                                constrained_layout=True)
    for place, (frame, name) in zip(axes[0], shown):
        draw_field(figure, place, frame, name, options)
    if options.profile:
        kind, *parameters = options.profile
        draw_profile(axes[0][-1], frames, kind, [float(word) for word in parameters])
    clear_factors(figure)
    save(figure, options.picture)


def main():
    try:
        draw(parse())
    except (OSError, ValueError) as problem:
        sys.exit(f"render.py: {problem}")


if __name__ == "__main__":
    main()
