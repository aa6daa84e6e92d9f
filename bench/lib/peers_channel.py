# SPDX-License-Identifier: GPL-2.0-only
"""Plane channel of channel.py: the settings of every code, and their repeated runs."""

import statistics

import channel

NAME = "plane-channel"
PANEL = 2.0
TITLE = f"plane channel, nu t/H^2 = {PANEL:g} (n = 2H/d)"
ERROR = "L2 of the velocity"
REPEATS, SHORT = 5, 1.0  # runs below so many seconds are repeated; the median counts
# Our settings that are compared with the peers. The series "example" (forward Euler) is not among
# them: its error in time cancels a part of its error in space.
FAMILIES = ("ab2", "tuned", "lagrangian", "lagrangian tuned")
COMPARED = {"tuned": "ours, particles at rest", "lagrangian tuned": "ours, particles moving"}


def peer_setups(long=False, quick=False):
    """'example': settings of LAMMPS' examples. 'tuned': what was found to serve each peer best."""
    rheo = (15,) if quick else (15, 30, 60) if long else (15, 30)
    for n in rheo:
        yield channel.rheo("example", n, channel.MACH, 1, zeta=1, jitter=0.1)
    for n in (15,) if quick else (15, 30, 60):
        yield channel.sph("example", n, channel.MACH, 1)
    # u_max/cs = 0.1 is usual for weakly compressible SPH; the time step is near the largest stable
    # one (SPH fails at a factor of 6).
    for n in (15, 30) if quick else (15, 30, 60):
        yield channel.rheo("tuned", n, 0.1, 4, zeta=0, jitter=0)
        yield channel.sph("tuned", n, 0.1, 3)


def own_setups():
    # Settings of examples/poiseuille-plane
    for n in (15, 30):
        yield channel.aleisph("example", n, 0.1, 1e-10)
    # Explicit and of second order in time; 0.173 is the largest step without a warning.
    for n in (15, 30, 60):
        for step in (1, 0.5):
            yield channel.aleisph("ab2", n, 0.16, 1e-8, step=step, integrator="ab2")
    for n in (8, 15, 30):
        yield channel.aleisph("lagrangian", n, 0.16, 1e-8, frame="lagrangian", integrator="ab2")
    # Crank-Nicolson with steps proportional to d: at half of them the errors hardly change.
    for n in (8, 15, 30, 60):
        for step in (1, 0.5):
            for tol in (1e-6, 1e-9):
                yield tuned("tuned", n, tol, step=step)
        yield tuned("lagrangian tuned", n, 1e-6, frame="lagrangian")
    # Beyond three resolutions, so that less of the comparison is only a bound
    yield tuned("tuned", 5, 1e-9)
    yield tuned("tuned", 120, 1e-9)


def compared_setups(quick):
    """Those of our setups that are compared on the page of all cases."""
    finest = 30 if quick else 120
    return [s for s in own_setups() if s.variant in COMPARED and s.n <= finest
            and s.labels["step"] == 1 and (s.n in (5, 120) or s.labels["tol"] == 1e-6)]


def tuned(variant, n, tol, **options):
    """nu dt/H^2 = 4/(15 n), but no less than 6 steps until the first comparison."""
    return channel.aleisph(variant, n, min(n / 15, n**2 / 240), tol, scheme="cn", **options)


def measure(setup, scratch):
    """Rows of one setup. A short run is repeated, and the medians of its wall-clock times count:
    LAMMPS' share of the core is not meaningful over milliseconds."""
    rows = channel.run(setup, scratch)
    if rows[-1]["seconds"] < SHORT:
        all_rows = [rows] + [channel.run(setup, scratch) for _ in range(REPEATS - 1)]
        for index, row in enumerate(rows):
            row["seconds"] = statistics.median(again[index]["wall"] for again in all_rows)
    return rows


def runs(quick):
    return compared_setups(quick), list(peer_setups(quick=quick))


run = channel.run   # peers.py repeats short runs itself
