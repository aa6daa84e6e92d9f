# SPDX-License-Identifier: GPL-2.0-only
"""Drops that come to rest: runs of examples/laplace, their pressure against 2 sigma/R."""

import math
from dataclasses import dataclass

import common
import dam_break
import scene

SIDE = 0.002    # of the cube [m]
OFF = 2.0       # a surface that is farther than this from the sphere, in spacings, is none of a drop


@dataclass
class Setup:
    variant: str       # accurate: model tangent; published
    n: int             # L/d
    step: float = 1    # 0.5: half the time step

    def variables(self):
        folder = scene.EXAMPLES / "laplace"
        model = "tangent" if self.variant == "accurate" else self.variant
        return {"L": SIDE, "n": self.n, "model": model, "step": 0.5 * self.step, "here": folder}


def verdict(failure, found):
    """Why a run has no pressure of a drop at rest; "" if it has. found: result lines by quantity"""
    if failure:
        return failure
    off = found["sphericity"]["linf"] if "sphericity" in found else math.inf
    return "" if off < OFF else "explodes"


def measures(found):
    """The columns of the report."""
    p = found["p"]
    return {"N": int(p["N"]), "l2": p["l2"], "p": p["value"] / p["reference"],
            "velocity": found["velocity"]["value"], "sphericity": found["sphericity"]["linf"],
            "volume": found["volume"]["outline"]}


def run(setup, folder, python, limit=None):
    """A row of the report; measures only if the run came to its end and there is a drop."""
    script = scene.EXAMPLES / "laplace" / "in.laplace"
    text, failure = common.attempt_lammps(script, {**setup.variables(), "python": python}, folder,
                                          limit=limit)
    found = {line["quantity"]: line for line in common.lines_with(common.RESULT, text)}
    row = {"case": "laplace", "code": "aleisph", "variant": setup.variant, "n": setup.n,
           "step": setup.step, "verdict": verdict(failure, found)}
    if row["verdict"]:
        return row
    share = common.cpu_share(text)
    row.update({"steps": dam_break.steps(text), "seconds": share * found["p"]["seconds"],
                "cpu share": share, **measures(found)})
    return row
