#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Draws snapshots of a 3d LAMMPS dump seen from outside: view.py DUMP PICTURE.png [options]

Parallel projection; particles are discs, painted from back to front. Wall particles are drawn in
grey (--solid) or left out (--hidden). Needs numpy and matplotlib (Debian: python3-matplotlib).
"""

import argparse
import sys

from series import pyplot

plt = pyplot()    # it says what is missing, so before the others
import matplotlib  # noqa: E402
import numpy as np  # noqa: E402
from matplotlib.collections import EllipseCollection  # noqa: E402

from dumps import finite, need_time, read_frames, warn  # noqa: E402
from render import LABELS, field, limits_without_strays, outside, save, selected  # noqa: E402


def axes_of_view(azimuth, elevation):
    """Unit vectors to the right, upwards and towards the eye; z is up, angles in degrees."""
    a, e = np.radians([azimuth, elevation])
    eye = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
    right = np.array([-np.sin(a), np.cos(a), 0.0])
    return right, np.cross(eye, right), eye


def frame_outline(axes, frame, view, margin):
    """Edges of the floor and of the box around all particles that are drawn or hidden."""
    limits = [limits_without_strays(frame[a]) for a in "xyz"]
    low, high = np.array(limits).T
    beyond = sum(outside(frame[a], pair) for a, pair in zip("xyz", limits))
    if beyond:
        warn(f"step {frame.step}: {beyond} particles lie outside of the frame")
    corners = np.array([[i, j] for i in (0, 1) for j in (0, 1)])
    for axis in range(3):
        for pair in corners:
            ends = np.insert(pair, axis, 0), np.insert(pair, axis, 1)
            line = np.array([low + (high - low) * end for end in ends]) @ np.array(view[:2]).T
            axes.plot(*line.T, color="0.6", linewidth=0.6, zorder=0)
    axes.margins(margin)
    axes.autoscale_view()
    axes.set_autoscale_on(False)    # the particles do not change what is seen


def draw(figure, axes, frame, options, limits):
    frame = selected(frame, finite(frame, ["x", "y", "z"], f"step {frame.step}"))
    shown = ~np.isin(frame["type"], options.hidden)
    solid = np.isin(frame["type"], options.solid)[shown]
    place = np.column_stack([frame[a][shown] for a in "xyz"])
    view = axes_of_view(*options.eye)
    right, up, depth = (place @ axis for axis in view)
    order = np.argsort(depth, kind="stable")
    colors = plt.get_cmap("viridis")(
        np.clip((field(frame, options.field)[shown] - limits[0]) / np.ptp(limits), 0, 1))
    colors[solid] = (0.75, 0.75, 0.75, 1.0)
    size = np.full(len(order), options.size)
    frame_outline(axes, frame, view, 0.01)
    axes.add_collection(EllipseCollection(
        size, size, np.zeros(len(order)), units="x", transOffset=axes.transData,
        offsets=np.column_stack([right, up])[order], facecolors=colors[order],
        edgecolors=(0, 0, 0, 0.25), linewidths=0.2))
    axes.set_aspect("equal")
    axes.set_axis_off()
    axes.set_title(f"t = {frame.time:.4g}")


def parse():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("dump")
    parser.add_argument("picture")
    parser.add_argument("--times", nargs="*", type=float, help="snapshots; default: the last")
    parser.add_argument("--field", default="speed", help="speed, p, or a column of the dump")
    parser.add_argument("--limits", nargs=2, type=float, required=True, help="of the colors")
    parser.add_argument("--size", type=float, required=True, help="diameter of the discs")
    parser.add_argument("--eye", nargs=2, type=float, default=[-60.0, 25.0],
                        metavar=("AZIMUTH", "ELEVATION"), help="direction of the eye, in degrees")
    parser.add_argument("--hidden", nargs="*", type=int, default=[2], help="types not drawn")
    parser.add_argument("--solid", nargs="*", type=int, default=[3], help="types drawn in grey")
    return parser.parse_args()


def draw_all(options):
    if not options.limits[0] < options.limits[1]:
        raise ValueError("--limits LOW HIGH: LOW must be below HIGH")
    frames = read_frames(options.dump)
    for frame in frames:
        need_time(frame, options.dump)
    chosen = frames[-1:] if not options.times else [
        min(frames, key=lambda frame, t=t: abs(frame.time - t)) for t in options.times]
    rows = (len(chosen) + 1) // 2
    columns = min(2, len(chosen))
    figure, panels = plt.subplots(rows, columns, figsize=(6.5 * columns, 3.7 * rows),
                                  squeeze=False, constrained_layout=True)
    for axes in panels.flat[len(chosen):]:
        axes.set_axis_off()
    for axes, frame in zip(panels.flat, chosen):
        draw(figure, axes, frame, options, options.limits)
    scale = matplotlib.cm.ScalarMappable(matplotlib.colors.Normalize(*options.limits), "viridis")
    figure.colorbar(scale, ax=panels, orientation="vertical", shrink=0.6,
                    label=LABELS.get(options.field, options.field))
    save(figure, options.picture)


def main():
    try:
        draw_all(parse())
    except (OSError, ValueError) as problem:
        sys.exit(f"view.py: {problem}")


if __name__ == "__main__":
    main()
