# SPDX-License-Identifier: GPL-2.0-only
"""Start-up of flow in a pipe: our example, and LAMMPS' RHEO and SPH in units of d and cs.

All codes have the Reynolds number of examples/poiseuille, its length 4 R, and its error:
rms(u - u_exact)/rms(u_steady) over the fluid particles. The peers' pipe is periodic, its walls are
layers of particles at rest on the lattice of the fluid, and each of their runs gets the radius for
which its profiles fit the exact solution best, as on the channel.
"""

from dataclasses import dataclass

import numpy as np

import common
import peer_scene
from flows import Run, run_example

NAME = "poiseuille"
PANEL = 0.4
TITLE = f"pipe, nu t/R^2 = {PANEL:g} (n = 2R/d)"
ERROR = "L2 of the velocity"
COMPARED = {"tuned": "ours, particles at rest"}
MARKS = {5: 0.2, 10: 0.4}       # of the example, in units of 0.04 R^2/nu
TIMES = tuple(MARKS.values())   # nu t/R^2
REYNOLDS = 15.625               # u_max R/nu of the example


# ---------------------------------------------------------------- exact solution

def bessel(order, x):
    """J0 or J1 by Bessel's integral; the midpoint rule is exact to rounding with these points."""
    x = np.asarray(x, dtype=float)
    count = 30 + int(np.max(x)) // 2
    theta = (np.arange(count) + 0.5) * np.pi / count
    return np.mean(np.cos(order * theta - x[..., None] * np.sin(theta)), axis=-1)


def zeros(count):
    """The first zeros of J0, by Newton's method from McMahon's expansion."""
    x = (np.arange(1, count + 1) - 0.25) * np.pi
    x += 1 / (8 * x)
    for _ in range(4):
        x += bessel(0, x) / bessel(1, x)    # J0' = -J1
    return x


def start_up(r, tau):
    """u/u_max at r/R from rest, tau = nu t/R^2 (Szymanski); zero in the wall."""
    # terms below exp(-40) do not change a double; 30 resolve tau of 0.005
    count = min(30, 2 + int(np.sqrt(40 / tau) / np.pi))
    k = zeros(count)
    weight = 8 / (k**3 * bessel(1, k)) * np.exp(-k**2 * tau)
    # linear between 401 radii: off by at most u_rr/8 (1/400)^2 = 3e-6
    grid = np.linspace(0, 1, 401)
    return np.interp(r, grid, 1 - grid**2 - bessel(0, np.outer(grid, k)) @ weight)


def l2(r, u, R, G, nu, t):
    """rms(u - u_exact)/rms(u_steady) over particles at the radii r"""
    u_max = G * R * R / (4 * nu)
    steady = u_max * np.maximum(0, 1 - (r / R)**2)
    error = u - u_max * start_up(r / R, nu * t / R**2)
    return float(np.sqrt(np.mean(error**2) / np.mean(steady**2)))


def fit_radius(profiles, R, G, nu):
    """Shift of the wall (in d = 1, outwards) for which [(r, u, t), ...] fit the solution best."""
    return common.least_at(lambda shift: sum(l2(r, u, R + shift, G, nu, t)**2
                                             for r, u, t in profiles))


# ---------------------------------------------------------------- runs

@dataclass
class Setup:
    code: str
    variant: str
    n: int
    mach: float     # u_max/cs
    dt: float       # cs dt/d
    options: dict   # of the script

    def radius(self):
        return self.n / 2

    def nu(self):
        return self.mach * self.radius() / REYNOLDS

    def force(self):
        return 4 * self.nu() * self.mach / self.radius()**2

    def steps(self):
        return [round(tau * self.radius()**2 / self.nu() / self.dt) for tau in TIMES]


def rheo(n, mach=0.1, factor=4):
    """The tuned settings of the channel: no artificial viscosity, 4 times the step."""
    dt = factor * min(0.1, 0.07 * REYNOLDS / (mach * n / 2))
    return Setup("rheo", "tuned", n, mach, dt, {"zeta": 0, "jitter": 0})


def sph(variant, n, mach, factor):
    """factor 1: the ratios cs dt/d = 0.2 and nu dt/d^2 = 0.08 of the example cavity_flow."""
    dt = factor * min(0.2, 0.08 * REYNOLDS / (mach * n / 2))
    return Setup("sph", variant, n, mach, dt, {})


def peer_setups(quick):
    """RHEO with the settings of its example would take 14 times as long as tuned: left out."""
    for n in (10,) if quick else (10, 16, 20):
        yield sph("tuned", n, 0.1, 2)   # 3, as on the channel, loses the fluid
    if not quick:
        yield sph("example", 10, 0.028, 1)
    for n in (10,) if quick else (10, 16):
        yield rheo(n)


def own_setups(quick):
    """Crank-Nicolson, dt proportional to d; beyond three resolutions for the comparison."""
    return [Run(NAME, "tuned", n, 1, 0.05 * n, 1e-6,
                {"d": 1e-3 / n, "scheme": "cn", "marks": tuple(MARKS), "every": 100})
            for n in ((6, 10, 16) if quick else (6, 10, 16, 20))]


def run_own(setup, folder):
    rows = run_example(setup, folder)
    for row, tau in zip(rows, TIMES):
        row["time"] = tau       # the example's is in seconds
    return rows


def run_peer(setup, folder):
    steps, R = setup.steps(), setup.radius()
    variables = {"n": setup.n, "L": 2 * setup.n, "nu": setup.nu(), "G": setup.force(),
                 "dt": setup.dt, "s1": steps[0], "s2": steps[1], **setup.options}

    def profile(snapshot, step):
        y, z, u = snapshot
        return np.hypot(y, z), u, step * setup.dt
    rows = peer_scene.run(NAME, setup, f"{setup.code}-pipe.in", variables, "profile",
                          zip(TIMES, steps), profile, folder)
    return with_fitted_wall(rows, R, setup.force(), setup.nu())


def with_fitted_wall(rows, R, G, nu):
    """Replaces the profiles in 'l2' by their errors."""
    profiles = [row["l2"] for row in rows if "l2" in row]
    shift = fit_radius(profiles, R, G, nu) if profiles else 0.0
    for row in rows:
        if "l2" in row:
            r, u, t = row["l2"]
            row.update({"l2": l2(r, u, R + shift, G, nu, t),
                        "l2 nominal wall": l2(r, u, R, G, nu, t), "wall shift/d": shift})
    return rows


def run(setup, folder):
    return run_own(setup, folder) if isinstance(setup, Run) else run_peer(setup, folder)


def runs(quick):
    return own_setups(quick), list(peer_setups(quick))
