# SPDX-License-Identifier: GPL-2.0-only
"""Figure of bench/ppe.py: iterations and seconds against N, a column per case."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend must be chosen first)

STYLE = {"none": ("#999999", "x"), "jacobi": ("#E69F00", "s"), "ilu0": ("#0072B2", "o"),
         "amg": ("#D55E00", "D")}


def style(name):
    return STYLE.get(name, ("#000000", "v"))


def line(axes, group, name, key):
    """Open: states made finer than the run they are from."""
    colour, marker = style(name)
    group = sorted(group, key=lambda row: row["N"])
    axes.plot([r["N"] for r in group], [r[key] for r in group], color=colour, linewidth=1)
    for row in group:
        open_ = row.get("refined", 1) > 1
        axes.plot(row["N"], row[key], marker=marker, color=colour, markersize=6,
                  markerfacecolor="white" if open_ else colour)


def panel(axes, rows, key):
    for name in dict.fromkeys(row["preconditioner"] for row in rows):
        line(axes, [row for row in rows if row["preconditioner"] == name], name, key)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.grid(True, which="major", color="0.85", linewidth=0.6)
    axes.tick_params(which="both", labelsize=8)


def legend(rows):
    styles = {row["preconditioner"]: style(row["preconditioner"]) for row in rows}
    handles = [plt.Line2D([], [], color=colour, marker=marker, label=name)
               for name, (colour, marker) in styles.items()]
    if any(row.get("refined", 1) > 1 for row in rows):
        handles.append(plt.Line2D([], [], color="0.3", marker="o", markerfacecolor="white",
                                  linestyle="", label="open: filled more finely than the run"))
    return handles


def draw(rows, path):
    rows = [row for row in rows if row.get("iterations") and not row.get("note")]
    cases = list(dict.fromkeys(row["case"] for row in rows))
    if not cases:
        return
    fig, grid = plt.subplots(2, len(cases), figsize=(0.5 + 3.2 * len(cases), 6.2), squeeze=False,
                             sharex="col", sharey="row")
    for column, case in enumerate(cases):
        mine = [row for row in rows if row["case"] == case]
        panel(grid[0][column], mine, "iterations")
        panel(grid[1][column], mine, "seconds")
        grid[0][column].set_title(case, fontsize=10)
        grid[1][column].set_xlabel("particles", fontsize=9)
    grid[0][0].set_ylabel("iterations to 1e-8", fontsize=9)
    grid[1][0].set_ylabel("set-up and solve [s]", fontsize=9)
    fig.legend(handles=legend(rows), loc="lower center", ncol=5, fontsize=8, frameon=False)
    fig.tight_layout(rect=(0, 0.05, 1, 1))
    fig.savefig(path, dpi=130)
    plt.close(fig)
