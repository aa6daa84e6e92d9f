#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Draws snapshots of a 3d LAMMPS dump seen from outside: view.py DUMP PICTURE.png [options]

Parallel projection; particles are discs, painted from back to front. Wall particles are drawn in
grey (--solid) or left out (--hidden). Needs numpy and matplotlib (Debian: python3-matplotlib).
"""

import argparse

import matplotlib
import numpy as np
from matplotlib.collections import EllipseCollection

from dumps import read_frames
from render import LABELS, field, save

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend comes first)


def axes_of_view(azimuth, elevation):
    """Unit vectors to the right, upwards and towards the eye; z is up, angles in degrees."""
    a, e = np.radians([azimuth, elevation])
    eye = np.array([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])
    right = np.array([-np.sin(a), np.cos(a), 0.0])
    return right, np.cross(eye, right), eye


def frame_outline(axes, frame, view, margin):
    """Edges of the floor and of the box around all particles that are drawn or hidden."""
    low = np.array([frame[a].min() for a in "xyz"])
    high = np.array([frame[a].max() for a in "xyz"])
    corners = np.array([[i, j] for i in (0, 1) for j in (0, 1)])
    for axis in range(3):
        for pair in corners:
            ends = np.insert(pair, axis, 0), np.insert(pair, axis, 1)
            line = np.array([low + (high - low) * end for end in ends]) @ np.array(view[:2]).T
            axes.plot(*line.T, color="0.6", linewidth=0.6, zorder=0)
    axes.margins(margin)


def draw(figure, axes, frame, options, limits):
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


def main():
    options = parse()
    frames = read_frames(options.dump)
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


if __name__ == "__main__":
    main()
