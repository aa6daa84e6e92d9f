# SPDX-License-Identifier: GPL-2.0-only
"""Laplace pressure of a drop: ours alone, since RHEO and SPH of LAMMPS have no surface tension."""

import sys

import drops
from drops import Setup

NAME = "laplace"
PANEL = 3.0
TITLE = "Laplace pressure of a drop (n = L/d; peers: no model)"
ERROR = "error of the mean pressure"
COMPARED = {"accurate": "ours, particles moving"}
NO_MODEL = "no surface tension in this package"


def setups(coarse):
    for n in (10, 14) if coarse else (10, 14, 20):
        for step in (1, 0.5) if n < 20 else (1,):
            yield Setup("accurate", n, step)
        if n < 20:    # it explodes at any spacing
            yield Setup("published", n)


def run(setup, folder):
    if isinstance(setup, str):
        return [{"case": NAME, "code": setup, "variant": "any", "n": 0, "time": PANEL,
                 "failure": NO_MODEL}]
    row = drops.run(setup, folder, sys.executable)
    row["time"] = PANEL
    if row["verdict"]:
        row["failure"] = row["verdict"]
    return [row]


def runs(quick):
    own = [s for s in setups(quick) if s.variant == "accurate" and s.step == 1]
    return own[:1] if quick else own, ["rheo", "sph"]
