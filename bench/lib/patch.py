# SPDX-License-Identifier: GPL-2.0-only
"""Rotating square patch: our example, and LAMMPS' RHEO and SPH in units of d and cs.

The error is the largest deviation of the pressure at the centre from the boundary-integral solution
for omega t from 0.1 to 2, over rho omega^2 L^2.
"""

import math
import sys
from dataclasses import dataclass

import numpy as np

import common
import dam_break
import peer_scene
import scene

NAME = "square-patch"
# published: as printed, but C in proportion to the time step (the paper's 0.005 at d = L/50 and 1 ms),
# so that steps can be compared
OPTIONS = {"accurate": {}, "published": {"rate": 0.1}}
PANEL = 2.0         # omega t
TITLE = "rotating patch, omega t = 0.1 to 2 (n = L/d)"
ERROR = "largest error of p at the centre"
COMPARED = {"accurate": "ours, particles moving"}
FAR = 1.0           # a deviation beyond this, seven times the pressure, is no pressure any more


# ---------------------------------------------------------------- ours

@dataclass
class Own:
    variant: str
    n: int
    step: float     # 1: cfl 0.2
    code: str = "aleisph"


def patch_runs(coarse):
    """cfl 0.2, and half of it but for the finest."""
    for variant in OPTIONS:
        for n in (25, 50) if coarse else (25, 50, 100):
            for step in (1, 0.5) if n < 100 else (1,):
                yield Own(variant, n, step)


def run_own(setup, scratch):
    folder = scene.EXAMPLES / NAME
    text = common.run_lammps(scene.with_exact_time(NAME, scratch),
                             {"d": 1 / setup.n, "variant": setup.variant, "cfl": 0.2 * setup.step,
                              "T": 2, "here": folder, "python": sys.executable, "frames": 0.5,
                              **OPTIONS[setup.variant]},
                             scratch)
    last = {line["quantity"]: line for line in common.lines_with(common.RESULT, text)
            if line["time"] == 2}
    share = common.cpu_share(text)
    head = last["p-deviation"]
    p = last["p"]
    ratios = {name: last[name]["value"] / last[name]["reference"]
              for name in ("energy", "angular-momentum", "area")}
    return {"case": NAME, "code": "aleisph", "variant": setup.variant, "n": setup.n,
            "step": setup.step, "N": int(head["N"]), "steps": dam_break.steps(text),
            "time": PANEL, "seconds": share * head["seconds"], "cpu share": share,
            "l2": head["linf"], "p(2)": p["value"] - p["reference"], **ratios}


# ---------------------------------------------------------------- peers

@dataclass
class Peer:
    code: str
    variant: str
    n: int
    mach: float     # omega L/cs
    dt: float       # cs dt/d
    options: dict   # of the script


def peer_setups(quick):
    """'example': the artificial viscosity and the time step of the examples."""
    for n in (25,) if quick else (25, 50, 100):
        yield Peer("sph", "example", n, 0.1, 0.2, {"alpha": 1})
    for n in (25,) if quick else (25, 50):
        # eta: a Reynolds number omega L^2/nu of 1e5
        yield Peer("rheo", "tuned", n, 0.1, 0.4, {"zeta": 1, "damp": 1, "eta": 1e-6 * n,
                                                  "warm": 0})
    if not quick:
        yield Peer("rheo", "example", 25, 0.1, 0.1, {"zeta": 1, "damp": 1, "eta": 2.5e-5,
                                                     "warm": 0})


def reference(t):
    """The rational function of examples/square-patch, from the boundary-integral solution."""
    s = np.asarray(t)**2
    return -0.1473427 * (1 + s * (0.44659141 + s * 0.0660690155)) / (
        1 + s * (0.882873523 + s * (0.247598050 + s * (0.0157543388 + s * 4.48624722e-4))))


def first_pressure(n, omega, terms=12):
    """Formula in x and y (in d) of the pressure at the start, rho = 1: of laplace(p) = 2 omega^2
    with p = 0 on the square, as a double series of cosines."""
    k = math.pi / n
    odd = range(1, 2 * terms, 2)
    parts = []
    for a, b in ((a, b) for a in odd for b in odd if a + b <= 2 * terms):
        sign = (-1)**((a + b) // 2 - 1)
        c = -32 * sign * omega**2 / (math.pi**2 * a * b * (a * a + b * b) * k * k)
        parts.append(f"{c:+.8g}*cos({a * k:.10g}*x)*cos({b * k:.10g}*y)")
    return "".join(parts)


def run_peer(setup, folder):
    omega = setup.mach / setup.n
    end = math.ceil(PANEL / omega / setup.dt)
    variables = {"n": setup.n, "omega": omega, "dt": setup.dt, "end": end,
                 "every": max(1, end // 1000), "p0": first_pressure(setup.n, omega),
                 **setup.options}
    text, failure = common.attempt_lammps(peer_scene.SCRIPTS / f"{setup.code}-patch.in", variables,
                                          folder, limit=peer_scene.LIMIT)
    row = {"case": NAME, "code": setup.code, "variant": setup.variant, "n": setup.n,
           "mach": setup.mach, "dt": setup.dt, "time": PANEL}
    t, p = dam_break.columns(folder / "series.patch", 1, 2)
    failure = verdict(t, p) or failure
    if failure:
        return {**row, "failure": failure}
    report = common.lines_with("PATCH", text)[0]
    share = common.cpu_share(text)
    dev = deviation(t, p)
    return {**row, "N": int(report["N"]), "steps": end, "cpu share": share,
            "seconds": share * report["seconds"], "l2": float(np.max(dev)),
            "rms": float(np.sqrt(np.mean(dev**2)))}


def deviation(t, p):
    counted = (t > 0.099) & (t < PANEL + 1e-6)
    return np.abs(p - reference(t))[counted]


def verdict(t, p):
    """At which omega t the pressure was lost; "" if it never was."""
    lost = ~(np.abs(p - reference(t)) < FAR)
    return f"fails at omega t = {t[np.argmax(lost)]:.2g}" if np.any(lost) else ""


def run(setup, folder):
    return [run_own(setup, folder) if isinstance(setup, Own) else run_peer(setup, folder)]


def runs(quick):
    own = [setup for setup in patch_runs(quick) if setup.variant in COMPARED and setup.step == 1]
    return [Own("accurate", 13, 1), *own], list(peer_setups(quick))
