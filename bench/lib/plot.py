# SPDX-License-Identifier: GPL-2.0-only
"""Log-log figure: error against run time, one panel per case and time, one line per series."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend must be chosen first)

# Colours that stay apart for the colour-blind (Okabe and Ito)
STYLE = {
    "aleisph example": ("#999999", "o"), "aleisph ab2": ("#0072B2", "o"),
    "aleisph tuned": ("#000000", "D"), "aleisph lagrangian": ("#56B4E9", "v"),
    "aleisph lagrangian tuned": ("#CC79A7", "v"), "rheo example": ("#D55E00", "s"),
    "rheo tuned": ("#E69F00", "s"), "sph example": ("#009E73", "^"), "sph tuned": ("#A6D854", "^"),
    "aleisph accurate": ("#0072B2", "o"), "aleisph published": ("#CC79A7", "v"),
    "aleisph viscous": ("#56B4E9", "D"),
}


def series_of(rows):
    """{(label, step, tol): rows sorted by resolution}; one line of the plot each."""
    series = {}
    for row in rows:
        key = (f"{row['code']} {row['variant']}", row.get("step", 1), row.get("tol", 0))
        series.setdefault(key, []).append(row)
    return {key: sorted(group, key=lambda r: r["n"]) for key, group in series.items()}


def panel(axes, title, rows):
    series = series_of(rows)
    named = set()
    for (label, step, tol), group in series.items():
        mine = [key for key in series if key[0] == label]
        largest_step = step == max(key[1] for key in mine)
        loosest = tol == max(key[2] for key in mine)
        colour, marker = STYLE[label]
        axes.plot([r["seconds"] for r in group], [r["l2"] for r in group], marker=marker,
                  color=colour, markersize=6, linewidth=1, linestyle="-" if loosest else "--",
                  markerfacecolor=colour if largest_step else "white")
        for row in group if largest_step else ():
            if (label, row["n"]) in named:
                continue
            named.add((label, row["n"]))
            axes.annotate(f"{row['n']:g}", (row["seconds"], row["l2"]), xytext=(4, 4),
                          textcoords="offset points", fontsize=7, color=colour)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_title(title, fontsize=10)
    axes.set_xlabel("run time on one core [s]", fontsize=9)
    axes.grid(True, which="major", color="0.85", linewidth=0.6)
    axes.tick_params(which="both", labelsize=8)
    axes.margins(0.12)


def legend_entries(panels):
    seen = dict.fromkeys(label for _, rows in panels for label, _, _ in series_of(rows))
    handles = [plt.Line2D([], [], color=STYLE[s][0], marker=STYLE[s][1], label=s) for s in seen]
    handles.append(plt.Line2D([], [], color="0.3", marker="o", markerfacecolor="white",
                              linestyle="", label="open: half the time step"))
    if any("tol" in row for _, rows in panels for row in rows):
        handles.append(plt.Line2D([], [], color="0.3", linestyle="--",
                                  label="dashed: tighter tolerance"))
    return [*handles, plt.Line2D([], [], linestyle="", label="numbers: n")]


def figure(panels, path, caption, ylabel="relative L2 error of the velocity", last=None):
    """panels: [(title, rows)]; last: a function that draws into the axes behind them"""
    count = len(panels) + bool(last)
    columns = 2 if count == 4 else min(3, count)
    lines = -(-count // columns)
    height = 3.6 * lines + 0.7
    fig, grid = plt.subplots(lines, columns, figsize=(4.2 * columns, height), squeeze=False)
    for axes, (title, rows) in zip(grid.flat, panels):
        panel(axes, title, rows)
    for axes in list(grid.flat)[count:]:
        axes.set_visible(False)
    for line in grid:
        line[0].set_ylabel(ylabel, fontsize=9)
    if last:
        last(grid.flat[len(panels)])
    fig.legend(handles=legend_entries(panels), loc="lower center", ncol=5, fontsize=8,
               frameon=False, bbox_to_anchor=(0.5, 0.2 / height))
    fig.text(0.5, 0.1 / height, caption, ha="center", fontsize=7, color="0.35")
    fig.tight_layout(rect=(0, 0.75 / height, 1, 1))
    fig.savefig(path, dpi=100)
    plt.close(fig)


# ---------------------------------------------------------------- one page, one colour per code

CODE = {"aleisph": ("#0072B2", "o"), "rheo": ("#D55E00", "s"), "sph": ("#009E73", "^")}
NAMES = {"aleisph": "this package", "rheo": "LAMMPS RHEO", "sph": "LAMMPS SPH"}


def page(panels, path, caption):
    """panels: [(title, label of the error, rows)]. A filled marker and a full line: the settings
    that serve the code best; open and dashed: those of its examples, or of a moving frame."""
    lines = -(-len(panels) // 3)
    fig, grid = plt.subplots(lines, 3, figsize=(13.0, 3.9 * lines + 0.8), squeeze=False)
    for axes, (title, label, rows) in zip(grid.flat, panels):
        page_panel(axes, title, label, rows)
    for axes in list(grid.flat)[len(panels):]:
        axes.set_visible(False)
    handles = [plt.Line2D([], [], color=colour, marker=marker, label=NAMES[code])
               for code, (colour, marker) in CODE.items()]
    for style, face, label in (("-", "0.3", "default or tuned"),
                               ("--", "white", "its example, or ours with moving particles")):
        handles.append(plt.Line2D([], [], color="0.3", marker="o", markerfacecolor=face,
                                  linestyle=style, label=label))
    fig.legend(handles=handles, loc="lower center", ncol=5, fontsize=9, frameon=False,
               bbox_to_anchor=(0.5, 0.025))
    fig.text(0.5, 0.012, caption, ha="center", fontsize=8, color="0.35")
    fig.tight_layout(rect=(0, 0.07, 1, 1))
    fig.savefig(path, dpi=100)
    plt.close(fig)


def page_panel(axes, title, label, rows):
    done = sorted((row for row in rows if "l2" in row), key=lambda row: row["n"])
    for code, variant in dict.fromkeys((row["code"], row["variant"]) for row in done):
        group = [row for row in done if (row["code"], row["variant"]) == (code, variant)]
        colour, marker = CODE[code]
        second = variant in ("example", "ale") or variant.startswith("lagrangian")
        axes.plot([r["seconds"] for r in group], [r["l2"] for r in group], marker=marker,
                  color=colour, markersize=6, linewidth=1.2, linestyle="--" if second else "-",
                  markerfacecolor="white" if second else colour)
        for row in group:
            axes.annotate(f"{row['n']:g}", (row["seconds"], row["l2"]), xytext=(4, 4),
                          textcoords="offset points", fontsize=7, color=colour)
    axes.set(xscale="log", yscale="log")
    axes.set_title(title, fontsize=10)
    axes.set_xlabel("run time on one core [s]", fontsize=9)
    axes.set_ylabel(label, fontsize=9)
    axes.grid(True, which="major", color="0.85", linewidth=0.6)
    axes.tick_params(which="both", labelsize=8)
    axes.margins(0.12)
