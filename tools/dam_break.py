#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Front and energy of runs of examples/dam-break: dam_break.py PLOT.png SERIES...

The front is drawn over the experiment of Martin & Moyce (1952). Needs matplotlib (Debian:
python3-matplotlib).
"""

import sys
from pathlib import Path

from series import pyplot, read_series, read_table

REFERENCE = Path(__file__).resolve().parents[1] / "tests" / "reference"
SETS = {"table": "ks", "pysph_a2.25in": "k+", "pysph_a1.125in": "kx"}


def draw_experiment(axes):
    rows = read_table(REFERENCE / "dambreak_martin_moyce.csv")
    for name, mark in SETS.items():
        points = [(float(row["T"]), float(row["Z"])) for row in rows if row["set"] == name]
        axes.plot(*zip(*points), mark, markersize=4, label=f"Martin & Moyce, {name}")


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    plt = pyplot()
    figure, (front, energy) = plt.subplots(1, 2, figsize=(11, 4.2), constrained_layout=True)
    draw_experiment(front)
    for path in sys.argv[2:]:
        series = read_series(path)
        front.plot(series["Tsim"], series["Zsim"], label=path)
        energy.plot(series["Tsim"], series["E"], label=path)
    front.set(xlim=(0, 5), ylim=(1, 5.2), xlabel="T", ylabel="Z = x/a", title="front")
    energy.axhline(1.0, color="k", linewidth=0.5)
    energy.set(xlabel="T", ylabel="E/E0", title="energy")
    for axes in (front, energy):
        axes.grid(alpha=0.3)
    front.legend(fontsize=8)
    figure.savefig(sys.argv[1], dpi=80)


if __name__ == "__main__":
    main()
