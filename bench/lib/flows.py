# SPDX-License-Identifier: GPL-2.0-only
"""Our runs of the examples poiseuille and taylor-green: resolutions, time steps, tolerances."""

import sys
from dataclasses import dataclass

import common
import scene


@dataclass
class Run:
    """An example with the variables that it is run with; n spacings across."""
    case: str
    variant: str
    n: int
    step: float        # time step over the largest one of the series
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
    folder = scene.EXAMPLES / run.case
    variables = {"vn": run.viscous, "tol": run.tol, **run.variables}
    if run.case == "poiseuille":
        variables.update(here=folder, python=sys.executable)
    text = common.run_lammps(scene.with_exact_time(run.case, scratch), variables, scratch)
    share = common.cpu_share(text)
    rows = []
    for line in common.lines_with(common.RESULT, text):
        if line["quantity"] == "u":
            rows.append({"case": run.case, "code": "aleisph", "variant": run.variant, "n": run.n,
                         "step": run.step, "nu dt/d^2": run.viscous, "tol": run.tol, **line,
                         "N": int(line["N"]), "seconds": share * line["seconds"],
                         "cpu share": share})
    if not rows:
        raise RuntimeError(f"{run.case} printed no {common.RESULT} line of the velocity")
    return rows


def at(rows, case, time):
    return [r for r in rows if r["case"] == case and abs(r["time"] - time) < 1e-6 * time]
