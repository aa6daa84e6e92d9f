# SPDX-License-Identifier: GPL-2.0-only
"""Tables and figure of bench/order.py: a line for each flow, frame and quantity."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402  (the backend must be chosen first)

import common  # noqa: E402

COLOURS = {"taylor-green": "#0072B2", "stokes-box": "#D55E00", "cavity": "#009E73",
           "cylinder-array": "#CC79A7", "wave": "#E69F00", "square-patch": "#56B4E9"}
MARKERS = {"eulerian": "s", "lagrangian": "^", "ale": "o"}
PRESSURES = ("p", "p-deviation")


def lines_of(rows, kind):
    """[rows of one series and quantity, in the order in which they ran]"""
    groups = {}
    for row in rows:
        if row["series"] == kind:
            key = (row["case"], row["what"], row["frame"], row["quantity"])
            groups.setdefault(key, []).append(row)
    return list(groups.values())


# ---------------------------------------------------------------- tables

def brief(values):
    """Numbers in a cell; "-" where there is none."""
    return " ".join(f"{v:.2g}" if isinstance(v, float) else "-" for v in values)


def orders_of(group):
    return " ".join(f"{row['order']:.2f}" if row["order"] != "" else "-"
                    for row in group if "order" in row)


def head_of(group):
    first = group[0]
    return {"flow": first["case"], "series": first["what"], "frame": first["frame"],
            "quantity": first["quantity"]}


def space_table(rows):
    return [{**head_of(group), "n": " ".join(f"{row['n']:g}" for row in group),
             "error": brief([row["error"] for row in group]), "order": orders_of(group),
             "wanted": group[-1]["wanted"]} for group in lines_of(rows, "space")]


def time_table(rows):
    table = []
    for group in lines_of(rows, "time"):
        has_error = any(row["error"] is not None for row in group)
        table.append({**head_of(group), "n": group[0]["n"],
                      "dt/d": brief([row["dt"] / row["d"] for row in group]),
                      "difference": brief([row["difference"] for row in group
                                           if "difference" in row]),
                      "order": orders_of(group), "wanted": group[-1]["wanted"],
                      "error": brief([row["error"] for row in group]) if has_error else ""})
    return table


def headings(table):
    return {key: key for key in table[0]} if table else {}


def write(rows, out):
    """All files; returns the text of order.md."""
    common.write_csv(out / "order.csv", rows)
    text = ""
    for title, table, name in (("Space: spacing halved", space_table(rows), "space"),
                               ("Time: step halved, same particles", time_table(rows), "time")):
        common.write_csv(out / f"order-{name}.csv", table)
        text += f"{title}\n\n{common.markdown(table, headings(table))}\n"
    (out / "order.md").write_text(text, encoding="ascii")
    figure(rows, out / "order.png")
    return text


# ---------------------------------------------------------------- figure

def figure(rows, path):
    fig, grid = plt.subplots(2, 2, figsize=(11.0, 9.0))
    space, time = lines_of(rows, "space"), lines_of(rows, "time")
    panels = (("space: velocity, frequency, drag, energy", space, False),
              ("space: pressure", space, True),
              ("time: velocity", time, False), ("time: pressure", time, True))
    for axes, (title, groups, pressure) in zip(grid.flat, panels):
        chosen = [g for g in groups if (g[0]["quantity"] in PRESSURES) == pressure]
        panel(axes, title, chosen, "space" in title)
    entries = handles(rows)
    fig.legend(handles=entries, loc="lower center", ncol=5, fontsize=8, frameon=False)
    fig.tight_layout(rect=(0, 0.09, 1, 1))
    fig.savefig(path, dpi=100)
    plt.close(fig)


def panel(axes, title, groups, space):
    for group in groups:
        key = "error" if space else "difference"
        points = [(abscissa(row, space), row[key]) for row in group if row.get(key)]
        first = group[0]
        if points:
            axes.plot(*zip(*points), marker=MARKERS[first["frame"]], color=COLOURS[first["case"]],
                      markersize=5, linewidth=1, markerfacecolor="white")
    axes.set(xscale="log", yscale="log")
    guides(axes)
    axes.set_title(title, fontsize=10)
    axes.set_xlabel("spacing over size of the flow" if space else "time step over spacing",
                    fontsize=9)
    axes.set_ylabel("error" if space else "difference from the smallest step", fontsize=9)
    axes.grid(True, which="major", color="0.9", linewidth=0.6)
    axes.tick_params(which="both", labelsize=8)


def abscissa(row, space):
    return 1 / row["n"] if space else row["dt"] / row["d"]


def guides(axes):
    """Slopes 1 and 2, through the middle of the panel."""
    low, high = axes.get_xlim()
    bottom, top = axes.get_ylim()
    middle = (low * high)**0.5, (bottom * top)**0.5
    for slope, style in ((1, ":"), (2, "--")):
        axes.plot([low, high], [middle[1] * (x / middle[0])**slope for x in (low, high)], style,
                  color="0.6", linewidth=1, zorder=0)
    axes.set(xlim=(low, high), ylim=(bottom, top))


def handles(rows):
    cases = dict.fromkeys(row["case"] for row in rows)
    frames = dict.fromkeys(row["frame"] for row in rows)
    return ([plt.Line2D([], [], color=COLOURS[c], label=c) for c in cases]
            + [plt.Line2D([], [], color="0.3", linestyle="", marker=MARKERS[f],
                          markerfacecolor="white", label=f) for f in frames]
            + [plt.Line2D([], [], color="0.6", linestyle=s, label=f"order {k}")
               for k, s in ((1, ":"), (2, "--"))])
