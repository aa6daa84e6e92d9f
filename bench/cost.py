#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Where the time goes: microseconds per particle and step by part, on 1 and 2 ranks.

Short runs of examples and of vortices in a periodic cube (lib/vortices.in), with particles at rest
(Eulerian frame: everything is kept) and moving (Lagrangian frame: everything is built in every
step). Each run has two parts; the second is measured, when what is built once has been built.
Writes cost.csv and cost.md and prints ALEISPH-RESULT lines.
"""

import argparse
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "lib"))

import common  # noqa: E402  (found in bench/lib)
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
TOLERANCE = 1e-8  # the default of fix aleisph/ppe


def measure(case, dimension, frame, script, variables, ranks):
    with tempfile.TemporaryDirectory(prefix="aleisph-bench-") as scratch:
        text = common.run_lammps(script, {**variables, "tol": TOLERANCE}, Path(scratch), ranks)
    parts, atoms, steps = timing.by_part(text)
    for part, value in parts.items():
        print(common.result_line(case=f"{case}-{dimension}d-{frame}", N=atoms, part=part,
                                 quantity="microseconds-per-particle-step", value=value,
                                 ranks=ranks), flush=True)
    share = common.cpu_share(text)
    return {"case": case, "dimension": dimension, "frame": frame, "N": atoms, "steps": steps,
            "ranks": ranks, **parts, "cpu share": share}


def columns(rows):
    heads = ("case", "dimension", "frame", "N", "ranks")
    parts = dict.fromkeys(key for row in rows for key in row)
    return {key: key for key in (*heads, *(p for p in parts if p not in (*heads, "steps")))}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=HERE / "results",
                        help="folder of what is written")
    options = parser.parse_args()
    rows = [measure(*case, ranks) for case in CASES for ranks in RANKS]
    common.write_csv(options.out / "cost.csv", rows)
    text = common.markdown(rows, columns(rows), digits=2)
    (options.out / "cost.md").write_text(text, encoding="ascii")
    print(text)


if __name__ == "__main__":
    main()
