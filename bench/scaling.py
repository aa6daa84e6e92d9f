#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Strong and weak scaling over the ranks at hand, and a model of many ranks.

Tanks with a free surface, fluid at rest that is shifted, 2d and 3d. Strong: 1e5 particles on 1 and 2
ranks; weak: 5e4 per rank. Runs follow one another, each size and number of ranks in turn, and the
quickest of each counts; let nothing else run. More ranks than cores are not timed: with 2^dimension
of them only messages are counted. The model (lib/scaling_model.py) takes them, and assumptions on
the network, to many ranks. Writes scaling.csv, scaling.md, scaling-model.csv and prints
ALEISPH-RESULT lines.
"""

import argparse
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "lib"))

import common  # noqa: E402  (found in bench/lib)
import scaling_model as model  # noqa: E402
import sizes  # noqa: E402
import timing  # noqa: E402

HERE = Path(__file__).resolve().parent
SCENES = {2: sizes.TANK_2D, 3: sizes.TANK_3D}
FEW = {2: 316, 3: 46}            # spacings across a tank of 5e4 particles
WARM_UP = 2                      # steps before those that count
MODEL_RANKS = (1000, 10000)
MODEL_PARTICLES = (1e4, 1e5)     # per rank

# each rank has the same number of particles although the tank is half empty
HEAD = "processors {grid}\n"
TAIL = """
balance 1.01 shift {axes} 30 1.01
thermo_style custom step f_ppe[9]
thermo {steps}
run {warm_up} post no
run {steps}
"""


def script(dimension, ranks, steps):
    grid = "* * 1" if dimension == 2 else "* * *"
    if ranks <= 2:
        grid = f"{ranks} 1 1"    # across the tank: no rank has the air
    return (HEAD.format(grid=grid) + SCENES[dimension].head()
            + TAIL.format(axes="xyz"[:dimension], steps=steps, warm_up=WARM_UP))


def run(dimension, n, ranks, options):
    """What one run says: seconds per step and its parts, traffic, iterations."""
    with tempfile.TemporaryDirectory(prefix="aleisph-bench-") as scratch:
        folder = Path(scratch)
        (folder / "in.tank").write_text(script(dimension, ranks, options.steps), encoding="ascii")
        variables = {**SCENES[dimension].fixed, "n": n, "tol": options.tol}
        text = common.run_lammps(folder / "in.tank", variables, folder, ranks)
    seconds, loop, steps, atoms = timing.last_block(text)
    return {"dimension": dimension, "N": atoms, "ranks": ranks, "seconds": loop / steps,
            "communication": seconds.get("communication", 0.0) / steps,
            "iterations": iterations(text, steps), "cpu share": common.cpu_share(text),
            **model.traffic(text)}


def iterations(text, steps):
    """Per step: f_ppe[9], their total, in the rows of the last two outputs."""
    rows = [line.split() for line in text.splitlines()]
    table = [row for row in rows if len(row) == 2 and row[0].isdigit()
             and int(row[0]) in (WARM_UP, WARM_UP + steps)]
    return (float(table[-1][1]) - float(table[-2][1])) / steps


def quickest(cases, options):
    """Runs all cases in turn, `repeats` times; the quickest of each."""
    best = {}
    for _ in range(options.repeats):
        for case in cases:
            row = run(*case, options)
            if case not in best or row["seconds"] < best[case]["seconds"]:
                best[case] = row
    return [best[case] for case in cases]


def series(dimension, options):
    """Rows of the strong and of the weak series, with efficiency."""
    many = SCENES[dimension].sizes[1e5]
    one, two, half = quickest([(dimension, many, 1), (dimension, many, 2),
                               (dimension, FEW[dimension], 1)], options)
    rows = [{"series": "strong", **one}, {"series": "strong", **two},
            {"series": "weak", **half}, {"series": "weak", **two}]
    for row in rows:
        base = one if row["series"] == "strong" else half
        row["speedup"] = (base["seconds"] / base["N"]) / (row["seconds"] / row["N"])
        row["efficiency"] = row["speedup"] / row["ranks"]
    return rows


def report_series(rows):
    for row in rows:
        for quantity in ("seconds", "speedup", "efficiency"):
            name = "seconds-per-step" if quantity == "seconds" else quantity
            print(common.result_line(case=f"{row['dimension']}d-tank", series=row["series"],
                                     N=row["N"], ranks=row["ranks"], quantity=name,
                                     value=row[quantity]), flush=True)


def step_of(one, options):
    """What the model needs: seconds from a run on one rank, counts from 2^dimension ranks."""
    dimension = one["dimension"]
    many = run(dimension, SCENES[dimension].sizes[1e4], 2**dimension, options)
    return model.Step(dimension=dimension,
                      seconds=one["cpu share"] * (one["seconds"] - one["communication"])
                      / one["N"],
                      particles=many["N"] / many["ranks"], reductions=many["reductions"],
                      exchanges=many["exchanges"], messages=many["messages"],
                      bytes=many["bytes"], iterations=many["iterations"])


def predictions(step, network):
    rows = []
    for ranks in MODEL_RANKS:
        for n in MODEL_PARTICLES:
            for multigrid in (False, True):
                rows.append({"dimension": step.dimension, "ranks": ranks, "per rank": n,
                             "multigrid": "yes" if multigrid else "no",
                             "efficiency": step.efficiency(n, ranks, network, multigrid)})
    return rows


def report_model(step, rows):
    case = f"{step.dimension}d-tank"
    for name in ("reductions", "exchanges", "messages", "bytes", "iterations"):
        print(common.result_line(case=case, quantity=f"{name}-per-step", value=getattr(step, name),
                                 ranks=2**step.dimension, per_rank=step.particles), flush=True)
    for row in rows:
        print(common.result_line(case=case, quantity="predicted-efficiency", ranks=row["ranks"],
                                 per_rank=row["per rank"], multigrid=row["multigrid"],
                                 value=row["efficiency"]), flush=True)


def parse():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=HERE / "results",
                        help="folder of what is written")
    parser.add_argument("--steps", type=int, default=10)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--tol", type=float, default=1e-8, help="of the pressure equation")
    parser.add_argument("--dimension", type=int, choices=(2, 3), action="append",
                        help="only this one")
    parser.add_argument("--latency", type=float, default=model.Network.latency, help="[s]")
    parser.add_argument("--bandwidth", type=float, default=model.Network.bandwidth,
                        help="per rank [byte/s]")
    options = parser.parse_args()
    options.dimension = options.dimension or [2, 3]
    return options


def main():
    options = parse()
    network = model.Network(options.latency, options.bandwidth)
    rows, predicted = [], []
    for dimension in options.dimension:
        measured = series(dimension, options)
        report_series(measured)
        step = step_of(measured[0], options)
        table = predictions(step, network)
        report_model(step, table)
        rows += measured
        predicted += table
    common.write_csv(options.out / "scaling.csv", rows)
    common.write_csv(options.out / "scaling-model.csv", predicted)
    text = (common.markdown(rows, {key: key for key in rows[0]}, digits=3) + "\n"
            + f"Predicted for a latency of {network.latency:g} s and {network.bandwidth:g} byte/s "
            + "per rank, from the counts above and those of 2^dimension ranks:\n\n"
            + common.markdown(predicted, {key: key for key in predicted[0]}, digits=3))
    (options.out / "scaling.md").write_text(text, encoding="ascii")
    print(text)


if __name__ == "__main__":
    main()
