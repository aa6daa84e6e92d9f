#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Error against run time next to LAMMPS' own RHEO and SPH: six flows, a page of plots and a table.

Plane channel, pipe, Taylor-Green vortices, rotating patch, dam break, Laplace pressure; and the
cost of a step of the patch. Every run is one process on one core; within a flow the codes take
turns.
Writes peers.csv (every run), peers-ratios.csv, peers-table.csv, peers-step.csv, peers.md and
peers.png, and prints ALEISPH-RESULT lines with the ratios.
"""

import argparse
import csv
import itertools
import statistics
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "lib"))

import common  # noqa: E402  (found in bench/lib)
import comparison  # noqa: E402
import patch  # noqa: E402
import patch_step  # noqa: E402
import peers_channel  # noqa: E402
import peers_dam_break  # noqa: E402
import peers_laplace  # noqa: E402
import pipe  # noqa: E402
import plot  # noqa: E402
import vortices  # noqa: E402

DEFAULT_OUT = Path(__file__).resolve().parent / "results"
FLOWS = (peers_channel, pipe, vortices, patch, peers_dam_break, peers_laplace)
STEP = "patch-step"
REPEATS, SHORT = 5, 1.0     # runs below so many seconds are repeated
TICKS = 0.05                # seconds over which the share of a core can be measured
COLUMNS = {"case": "case", "time": "time", "series": "series", "n": "n",
           "least error": "least error", "seconds": "in seconds",
           "ours, particles at rest": "over ours at rest",
           "ours, particles moving": "over ours moving", "failure": "remark"}


def alternate(one, other):
    """Elements of both in turns."""
    pairs = itertools.zip_longest(one, other)
    return [x for pair in pairs for x in pair if x is not None]


def median_time(rows):
    """Of the same run, repeated. Over milliseconds LAMMPS' share of the core means nothing, and the
    wall-clock times count as they are."""
    wall = statistics.median(row["seconds"] / (row["cpu share"] or 1) for row in rows)
    return wall if wall < TICKS else statistics.median(row["seconds"] for row in rows)


def repeated(flow, setup, folder):
    """Rows of one setup. A short run is repeated, and the medians of its run times count."""
    rows = flow.run(setup, folder)
    if rows[-1].get("seconds", SHORT) < SHORT:
        again = [rows] + [flow.run(setup, folder) for _ in range(REPEATS - 1)]
        times = [median_time(same) for same in zip(*again)]
        for row, seconds in zip(rows, times):
            row["seconds"] = seconds
    return rows


def run_flow(flow, quick, scratch):
    print(f"{flow.TITLE}: {flow.ERROR}", flush=True)
    rows = []
    for index, setup in enumerate(alternate(*flow.runs(quick))):
        new = repeated(flow, setup, scratch / f"{flow.NAME}-{index}")
        rows += new
        say(new)
    return rows


def say(rows):
    row = rows[-1]
    what = " ".join(f"{r['l2']:.2e}" if "l2" in r else r["failure"] for r in rows)
    print(f"  {comparison.peer_name(row):24s} n={row['n']:<4g} {row.get('seconds', 0):8.2f} s  "
          f"{what}", flush=True)


def analyse(rows):
    """(every ratio, the table, the result lines), flow by flow."""
    ratios, table, lines = [], [], []
    for flow in FLOWS:
        mine = [row for row in rows if row["case"] == flow.NAME]
        found = list(comparison.ratios(mine, flow.COMPARED))
        ratios += found
        table += comparison.table(mine, found, flow.COMPARED)
        lines += comparison.result_lines(mine, found, flow.COMPARED)
    return ratios, table, lines


def panels(rows):
    for flow in FLOWS:
        mine = [row for row in rows if row["case"] == flow.NAME and row["time"] == flow.PANEL]
        yield flow.TITLE, flow.ERROR, mine


def report(rows, steps, out):
    """Writes all files; returns the text and the result lines."""
    ratios, table, lines = analyse(rows)
    common.write_csv(out / "peers.csv", rows)
    common.write_csv(out / "peers-ratios.csv", ratios)
    common.write_csv(out / "peers-table.csv",
                     [{head: row.get(key) for key, head in COLUMNS.items()} for row in table])
    common.write_csv(out / "peers-step.csv", steps)
    text = ("Made by `./aleisph bench peers`. Over ours: its run time at equal error / its error "
            "at equal run time,\nat the run (n) of the peer where we are least ahead.\n\n"
            + common.markdown(table, COLUMNS, digits=3))
    if steps:
        text += ("\nOne step of the rotating patch, microseconds per particle:\n\n"
                 + common.markdown(steps, {key: key for key in steps[0]}, digits=3))
    (out / "peers.md").write_text(text, encoding="ascii")
    plot.page(list(panels(rows)), out / "peers.png", "one process on one core per run; "
              "channel and pipe: peers with their best-fitting wall position")
    return text, lines + list(patch_step.result_lines(steps))


def stored(path, keep):
    """Rows of an earlier report that are not measured now."""
    if not path.exists():
        return []
    with open(path, encoding="ascii") as lines:
        rows = [{key: common.number_or_text(x) for key, x in row.items() if x}
                for row in csv.DictReader(lines)]
    return [row for row in rows if keep(row)]


def arguments():
    names = [flow.NAME for flow in FLOWS] + [STEP]
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=DEFAULT_OUT, help="folder of the report")
    parser.add_argument("--quick", action="store_true", help="coarse runs only")
    parser.add_argument("--only", choices=names, action="append",
                        help="this flow (can be repeated); what the report has of the others stays")
    parser.add_argument("--report", action="store_true", help="no runs: the report anew")
    options = parser.parse_args()
    options.names = [] if options.report else options.only or names
    return options


def main():
    options = arguments()
    rows = stored(options.out / "peers.csv", lambda row: row["case"] not in options.names)
    steps = stored(options.out / "peers-step.csv", lambda row: STEP not in options.names)
    with tempfile.TemporaryDirectory(prefix="aleisph-bench-") as name:
        scratch = Path(name)
        if STEP in options.names:
            steps = patch_step.measure(100, 3 if options.quick else 5, scratch)
        for flow in FLOWS:
            if flow.NAME in options.names:
                rows += run_flow(flow, options.quick, scratch)
                report(rows, steps, options.out)
    text, lines = report(rows, steps, options.out)
    print(text)
    print("\n".join(lines))


if __name__ == "__main__":
    main()
