# SPDX-License-Identifier: GPL-2.0-only
"""One plane channel for every code: its numbers in each code's units, its runs, its error.

Fluid at rest between walls 2H apart is driven along x by the acceleration G. All codes have the
same Reynolds number u_max H/nu (that of LAMMPS' example rheo/poiseuille), the same length
L = 4/3 H, the same n spacings across, and are compared at the same nu t/H^2.
"""

import math
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

import common

# From LAMMPS' example rheo/poiseuille: H = 7.5, nu = 0.1, G = 1e-4, cs = 1.
REYNOLDS = 1e-4 * 7.5**3 / (2 * 0.1**2)
MACH = 1e-4 * 7.5**2 / (2 * 0.1)
TIMES = (0.1, 0.5, 2.0)  # nu t/H^2: early, half-way and (nearly) steady: exp(-pi^2/4 2) = 0.7 %
SCRIPTS = Path(__file__).resolve().parents[1] / "peers"


@dataclass
class Setup:
    """A run: script, H, G, nu, d, dt in the units of that script, y of the centre plane."""
    code: str
    variant: str
    n: int
    H: float
    G: float
    nu: float
    d: float
    dt: float
    extra: dict = field(default_factory=dict)
    labels: dict = field(default_factory=dict)

    def steps(self):
        steps = [round(tau * self.H**2 / self.nu / self.dt) for tau in TIMES]
        if steps[0] < 5:
            raise ValueError(f"{self}: {steps[0]} steps until the first comparison are too few")
        return steps


def spacing_units(n, u_max):
    """H, G, nu of the channel with d = 1 and the given u_max."""
    H = n / 2
    nu = u_max * H / REYNOLDS
    return H, 2 * nu * u_max / H**2, nu


def rheo(variant, n, mach, dt_factor, zeta, jitter):
    """dt_factor 1 is the example's dt = 0.1 d/cs, zeta its artificial viscosity 1, jitter 0.1."""
    H, G, nu = spacing_units(n, mach)  # cs = 1
    # The viscous limit binds only for large steps: nu dt/d^2 = 0.57 lost all particles, 0.28 ran.
    dt = dt_factor * min(0.1, 0.07 / nu)
    extra = {"zeta": zeta, "jitter": jitter, "kernel": "quintic"}
    return Setup("rheo", variant, n, H, G, nu, 1.0, dt, extra)


def sph(variant, n, mach, dt_factor):
    """dt_factor 1: the ratios cs dt/d = 0.2 and nu dt/d^2 = 0.08 of the example cavity_flow."""
    H, nu = 5e-4, 1e-6
    u_max = REYNOLDS * nu / H
    cs, d = u_max / mach, 2 * H / n
    dt = dt_factor * min(0.2 * d / cs, 0.08 * d**2 / nu)
    return Setup("sph", variant, n, H, 2 * nu * u_max / H**2, nu, d, dt, {"cs": cs})


def aleisph(variant, n, viscous, tol, step=1, frame="eulerian", scheme="explicit",
            integrator="euler"):
    """viscous = nu dt/d^2 for step 1; step 0.5: half of it. dt is lowered to a part of TIMES[0]."""
    H, G, nu = spacing_units(n, MACH)
    first = TIMES[0] * H**2 / nu
    dt = first / math.ceil(first * nu / (step * viscous) - 1e-6)
    extra = {"tol": tol, "frame": frame, "scheme": scheme, "integrator": integrator}
    labels = {"nu dt/d^2": dt * nu, "tol": tol, "step": step}
    return Setup("aleisph", variant, n, H, G, nu, 1.0, dt, extra, labels)


def run(setup, folder):
    """Runs a setup in the folder; returns one row per compared time."""
    steps = setup.steps()
    variables = {"n": setup.n, "L": round(2 * setup.n / 3), "G": setup.G, "dt": setup.dt,
                 "s1": steps[0], "s2": steps[1], "s3": steps[2], "out": "profile", **setup.extra}
    if setup.code != "sph":
        variables["nu"] = setup.nu
    text = common.run_lammps(SCRIPTS / f"{setup.code}.in", variables, folder)
    report = common.lines_with("CHANNEL", text)[0]
    profiles = []
    for index, step in enumerate(steps, 1):
        y, u = common.read_dump(folder / f"profile.{index}").T
        if not np.all(np.isfinite(u)):
            raise RuntimeError(f"{setup}: the profile holds velocities that are not finite")
        profiles.append((y - setup.H, u, step * setup.dt))
    return rows(setup, report, profiles, common.cpu_share(text))


def rows(setup, report, profiles, share):
    # The peers get the wall position that suits them best; ours is where its wall particles are.
    shift = 0.0
    if setup.code != "aleisph":
        shift = common.fit_wall(profiles, setup.H, setup.G, setup.nu, setup.d)
    head = {"case": "plane-channel", "code": setup.code, "variant": setup.variant, "n": setup.n,
            "N": int(report["N"]), "dt nu/H^2": setup.dt * setup.nu / setup.H**2, **setup.labels}
    table = []
    for index, tau in enumerate(TIMES):
        y, u, t = profiles[index]
        error, nominal = (common.plane_l2(y, u, setup.H + s * setup.d, setup.G, setup.nu, t)
                          for s in (shift, 0.0))
        table.append({**head, "steps": setup.steps()[index], "time": tau,
                      "seconds": share * report[f"seconds{index + 1}"],
                      "wall": report[f"seconds{index + 1}"], "l2": error,
                      "l2 nominal wall": nominal, "wall shift/d": shift, "cpu share": share})
    return table
