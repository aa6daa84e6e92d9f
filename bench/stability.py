#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Stability report: patch, tank and dam break over time step, spacing, disorder, kernel and ranks.

One factor at a time is changed from a base case. Every run is an example with a few more options
and measurements; for each the table has how far it came, energy, volume, surface and what the
guards did. Writes stability.csv and stability.md.
"""

import argparse
import csv
import os
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "lib"))

import common  # noqa: E402  (found in bench/lib)
import trial  # noqa: E402
from trial import CASES, Trial  # noqa: E402

HERE = Path(__file__).resolve().parent
KERNELS = ("wendland-c2", "wendland-c4", "quintic-spline")
RATIOS = (1.3, 1.4, 1.5)
COLUMNS = {"case": "case", "factor": "factor", "value": "value", "time": "time", "end": "of",
           "steps": "steps", "energy": "max E/E0", "last energy": "last E/E0", "volume": "volume",
           "surface": "FS d/perimeter", "spray": "spray", "ballistic": "ballistic",
           "limited": "shifts cut", "walls": "wall guard", "collision": "collisions",
           "symmetric": "symmetric", "selfterm": "self term", "pressure": "p < 0 cut",
           "beyond": "beyond walls", "measure": "result", "verdict": "verdict"}


def one_factor(case, factor, values):
    for value in values:
        yield Trial(case, factor, value)


def trials(quick):
    """The base case of each, then one factor at a time. Base values: CASES in lib/trial.py."""
    for case, setup in CASES.items():
        yield Trial(case, "base", "")
        steps = (0.1, 0.3) if quick else (0.02, 0.05, 0.1, 0.2, 0.3)
        jitter = (0.2,) if quick else (0.0, 0.1, 0.2)
        yield from one_factor(case, "cfl", [c for c in steps if c != setup.cfl])
        yield from one_factor(case, "d x", (2,) if quick else (2, 0.5))
        yield from one_factor(case, "jitter", [j for j in jitter if j != setup.jitter])
        if not quick:
            yield from one_factor(case, "seed", (1, 2, 3) if setup.seeds else ())
            yield from one_factor(case, "kernel", KERNELS)
            yield from one_factor(case, "h/d", RATIOS)
            yield from one_factor(case, "guards", ("none",) if setup.guards else ())
        yield from one_factor(case, "ranks", (2,))


def run_all(chosen, jobs, limit, keep):
    """Runs of one rank side by side, those of more ranks one by one."""
    def run(one):
        with tempfile.TemporaryDirectory(prefix="aleisph-bench-") as scratch:
            folder = keep / one.name() if keep else Path(scratch)
            row = trial.run(one, folder, limit)
        print("  " + common.result_line(**{key.replace(" ", "-"): str(value).replace(" ", "_")
                                           if isinstance(value, str) else value
                                           for key, value in row.items()}), flush=True)
        return row

    alone = [one for one in chosen if one.ranks() > 1]
    with ThreadPoolExecutor(jobs) as pool:
        rows = list(pool.map(run, [one for one in chosen if one.ranks() == 1]))
    rows += [run(one) for one in alone]
    order = {(one.case, one.factor, str(one.value)): k for k, one in enumerate(chosen)}
    return sorted(rows, key=lambda r: order[r["case"], r["factor"], str(r["value"])])


def stored(path, left_out):
    """Rows of an earlier report of the cases that are not run now."""
    if not path.exists():
        return []
    with open(path, encoding="ascii") as lines:
        return [row for row in csv.DictReader(lines) if row["case"] not in left_out]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=HERE / "results", help="folder of the report")
    parser.add_argument("--quick", action="store_true", help="a few coarse runs of each case")
    parser.add_argument("--only", nargs="+", choices=list(CASES), default=list(CASES),
                        help="these cases; the rows of others stay as they are")
    parser.add_argument("--factor", nargs="+", help="these factors only; for trying things out")
    parser.add_argument("--jobs", type=int, default=2, help="runs at a time")
    parser.add_argument("--limit", type=float, default=600, help="seconds for one run")
    parser.add_argument("--keep", type=Path, help="folder where the runs are kept, with dumps")
    return parser.parse_args()


def main():
    options = arguments()
    os.nice(10)
    chosen = [one for one in trials(options.quick) if one.case in options.only
              and (not options.factor or one.factor in options.factor)]
    path = options.out / "stability.csv"
    rows = stored(path, options.only) + run_all(chosen, options.jobs, options.limit,
                                                options.keep and options.keep.resolve())
    rows.sort(key=lambda row: list(CASES).index(row["case"]))
    common.write_csv(path, rows)
    text = common.markdown(rows, COLUMNS)
    (options.out / "stability.md").write_text(text, encoding="ascii")
    print(text)


if __name__ == "__main__":
    main()
