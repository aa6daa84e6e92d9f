#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Where the time goes: microseconds per particle and step by part, and how they grow with N.

By part: short runs of examples and of vortices in a periodic cube (lib/vortices.in), with particles
at rest (Eulerian frame: everything is kept) and moving (Lagrangian frame: everything is built in
every step), on 1 and 2 ranks. Each run has two parts; the second is measured, when what is built
once has been built.
Series: steps of moving particles in tanks with a free surface and in a patch, from 1e3 particles to
1e5 (--full: 1e6), with the slope and the memory.
Writes cost.csv, cost.md, cost-series.csv, cost-series.md and prints ALEISPH-RESULT lines.
"""

import argparse
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "lib"))

import common  # noqa: E402  (found in bench/lib)
import cost_series as series  # noqa: E402
import timing  # noqa: E402

HERE = Path(__file__).resolve().parent
EXAMPLES = HERE.parent / "examples"
WATER = HERE.parent / "potentials/water.aleisph"
VORTICES = EXAMPLES / "taylor-green/in.taylor-green"
CUBE = HERE / "lib/vortices.in"
PIPE = EXAMPLES / "poiseuille/in.poiseuille"
TANK = EXAMPLES / "closed-tank/in.closed-tank"
SQUARE = {"N": 64, "marks": (1, 4), "every": 100}

# (case, dimension, frame, script, variables). The tank has one part only: its first step counts.
CASES = [
    ("taylor-green", 2, "eulerian", VORTICES, {**SQUARE, "frame": "eulerian"}),
    ("taylor-green", 2, "lagrangian", VORTICES, {**SQUARE, "frame": "lagrangian", "marks": (1, 2)}),
    ("vortices", 3, "eulerian", CUBE, {"n": 20, "frame": "eulerian", "steps": 100}),
    ("vortices", 3, "lagrangian", CUBE, {"n": 20, "frame": "lagrangian", "steps": 20}),
    ("poiseuille", 3, "eulerian", PIPE, {"d": 6.25e-5, "marks": (1, 5), "every": 100,
                                        "here": PIPE.parent, "python": sys.executable}),
    ("closed-tank", 3, "lagrangian", TANK, {"dim": 3, "n": 20, "steps": 20, "fluid": WATER}),
]
RANKS = (1, 2)
TOLERANCE = series.TOLERANCE


def report(pairs):
    print(common.result_line(**pairs), flush=True)


def measure(case, dimension, frame, script, variables, ranks):
    with tempfile.TemporaryDirectory(prefix="aleisph-bench-") as scratch:
        text = common.run_lammps(script, {**variables, "tol": TOLERANCE}, Path(scratch), ranks)
    parts, atoms, steps = timing.by_part(text)
    for part, value in parts.items():
        report({"case": f"{case}-{dimension}d-{frame}", "N": atoms, "part": part,
                "quantity": "microseconds-per-particle-step", "value": value, "ranks": ranks})
    share = common.cpu_share(text)
    return {"case": case, "dimension": dimension, "frame": frame, "N": atoms, "steps": steps,
            "ranks": ranks, **parts, "cpu share": share}


def columns(rows, heads=("case", "dimension", "frame", "N", "ranks")):
    parts = dict.fromkeys(key for row in rows for key in row)
    return {key: key for key in (*heads, *(p for p in parts if p not in (*heads, "steps")))}


def run_parts(options):
    rows = [measure(*case, ranks) for case in CASES for ranks in RANKS]
    common.write_csv(options.out / "cost.csv", rows)
    text = common.markdown(rows, columns(rows), digits=2)
    (options.out / "cost.md").write_text(text, encoding="ascii")
    print(text)


def run_case(scene, largest, ranks):
    """Rows of one case; prints its lines. The bandwidth is the larger of before and after."""
    rows = []
    for nominal in scene.upto(largest):
        stated = (scene.case, nominal) == series.STATED
        before = timing.bandwidth() if stated else 0.0
        with tempfile.TemporaryDirectory(prefix="aleisph-bench-") as scratch:
            row, parts = series.measure(scene, nominal, scratch, ranks)
        for line in series.lines(row, parts):
            report(line)
        if stated:
            row[series.BANDWIDTH] = max(before, timing.bandwidth()) / 1e9
        rows.append(row)
    for line in series.summary(rows):
        report(line)
    return rows


def run_series(options):
    largest = {case: options.largest or (1e6 if options.full else 1e5) for case in series.CASES}
    if not options.largest and not options.full:
        largest["3d-tank"] = series.STATED[1]
    rows = [row for case in options.case
            for row in run_case(series.CASES[case], largest[case], options.ranks)]
    common.write_csv(options.out / "cost-series.csv", rows)
    summary = [line for case in options.case
               for line in series.summary([row for row in rows if row["case"] == case])]
    names = {key: key for key in ("case", "quantity", "value", "N", "from")}
    text = (common.markdown(rows, columns(rows, ("case", "N", "ranks")), digits=3) + "\n"
            + common.markdown(summary, names, digits=3))
    (options.out / "cost-series.md").write_text(text, encoding="ascii")
    print(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=HERE / "results",
                        help="folder of what is written")
    parser.add_argument("--only", choices=("parts", "series"), help="one of the two")
    parser.add_argument("--full", action="store_true", help="series to 1e6 particles")
    parser.add_argument("--largest", type=float, help="series to this many, instead")
    parser.add_argument("--case", choices=series.CASES, nargs="+", default=list(series.CASES),
                        help="of the series")
    parser.add_argument("--ranks", type=int, default=1, help="of the series")
    options = parser.parse_args()
    if options.only != "series":
        run_parts(options)
    if options.only != "parts":
        run_series(options)


if __name__ == "__main__":
    main()
