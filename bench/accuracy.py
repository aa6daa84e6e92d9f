#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Error against run time: plane channel with its peers, pipe and Taylor-Green vortices.

The pipe and the vortices are the examples `poiseuille` and `taylor-green`, each over resolutions,
two time steps and two solver tolerances; the channel is that of peers.py. Writes accuracy.csv,
accuracy.md and accuracy.png besides the files of peers.py and repeats all result lines.
"""

import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import peers

import channel
import common
import plot

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
PANELS = {("poiseuille", 0.05): "pipe, start-up, nu t/R^2 = 0.2 (n = 2R/d)",
          ("poiseuille", 0.5): "pipe, steady, nu t/R^2 = 2 (n = 2R/d)",
          ("taylor-green", 0.25): "Taylor-Green, Re = 100, t U/L = 0.25 (n = L/d)",
          ("taylor-green", 1.0): "Taylor-Green, Re = 100, t U/L = 1 (n = L/d)"}
COLUMNS = {"case": "case", "variant": "settings", "n": "n", "N": "N", "dt": "dt",
           "nu dt/d^2": "nu dt/d^2", "tol": "tol", "time": "time", "seconds": "seconds",
           "l2": "L2"}


@dataclass
class Run:
    """An example with the variables that it is run with; n spacings across."""
    case: str
    variant: str
    n: int
    step: float        # 1, or 0.5 for half the time step
    viscous: float     # nu dt/d^2, before it is lowered to divide the times of comparison
    tol: float
    variables: dict


def pipe_runs():
    """nu t/R^2 = 0.2 and 0.4 for all runs, and 2 with the larger implicit steps."""
    for n, d in ((10, 1e-4), (16, 6.25e-5), (20, 5e-5)):
        for tol in (1e-6, 1e-10):
            yield Run("poiseuille", "example", n, 1, 0.1, tol, {"d": d, "marks": (5, 10)})
            # dt proportional to d, as for the channel
            for step, marks in ((1, (5, 10, 50)), (0.5, (5, 10))):
                yield Run("poiseuille", "tuned", n, step, 0.05 * step * n, tol,
                          {"d": d, "scheme": "cn", "marks": marks})


def vortex_runs():
    """t U/L = 0.25 for all runs, and 1 where that does not take long."""
    for n in (32, 64, 128):
        for step in (1, 0.5):
            for tol in (1e-4, 1e-8):
                short = n == 128 and (step, tol) != (1, 1e-4)
                yield Run("taylor-green", "ab2", n, step, 0.15 * step, tol,
                          {"N": n, "marks": 5 if short else (5, 20)})


def run_example(run, scratch):
    """One row per result line of the velocity."""
    folder = EXAMPLES / run.case
    variables = {"vn": run.viscous, "tol": run.tol, **run.variables}
    if run.case == "poiseuille":
        variables.update(here=folder, python=sys.executable)
    text = common.run_lammps(folder / f"in.{run.case}", variables, scratch)
    share = common.cpu_share(text)
    rows = []
    for line in common.lines_with(common.RESULT, text):
        if line["quantity"] == "u":
            rows.append({"case": run.case, "code": "aleisph", "variant": run.variant, "n": run.n,
                         "step": run.step, "nu dt/d^2": run.viscous, "tol": run.tol, **line,
                         "N": int(line["N"]), "seconds": share * line["seconds"],
                         "cpu share": share})
            print("  " + common.result_line(**{**line, "tol": run.tol}), flush=True)
    if not rows:
        raise RuntimeError(f"{run.case} printed no {common.RESULT} line of the velocity")
    return rows


def run_cases():
    table = []
    for run in [*pipe_runs(), *vortex_runs()]:
        with tempfile.TemporaryDirectory(prefix="aleisph-bench-") as scratch:
            table += run_example(run, Path(scratch))
    return table


def at(rows, case, time):
    return [r for r in rows if r["case"] == case and abs(r["time"] - time) < 1e-6 * time]


def panels(table):
    for time in channel.TIMES:
        yield (f"plane channel, nu t/H^2 = {time:g} (n = 2H/d)", at(table, "plane-channel", time))
    for (case, time), title in PANELS.items():
        yield title, at(table, case, time)


def main():
    options = peers.arguments(__doc__).parse_args()
    own = run_cases()
    table, compared = peers.run_channel(options.long, only_peers=False)
    text = peers.write_report(table, compared, options.out)
    common.write_csv(options.out / "accuracy.csv", table + own)
    text += "\n" + common.markdown(own, COLUMNS)
    (options.out / "accuracy.md").write_text(text, encoding="ascii")
    plot.figure(list(panels(table + own)), options.out / "accuracy.png",
                "one process on one core per run; peers with their best-fitting wall position")
    print(text)
    for line in peers.verdicts(compared):
        print(line)


if __name__ == "__main__":
    sys.exit(main())
