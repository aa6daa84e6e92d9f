# SPDX-License-Identifier: GPL-2.0-only
"""One time step of the rotating patch: this package and LAMMPS' RHEO, with the same particles.

Microseconds per particle and step, without output and measurements: LAMMPS' loop time, multiplied
by the share of the core that the run had. The codes take turns, so that what slows the machine
slows both; medians of the rounds count. A step of this package covers much more time than one of
RHEO, which must resolve sound; the rows have both in units of 1/omega.
"""

import re
import statistics
from pathlib import Path

import common
import scene

RHEO = Path(__file__).resolve().parents[1] / "peers/rheo-patch.in"
OURS = {"lagrangian": {"shift": "none"}, "ale": {}}   # examples/square-patch; the second as it is
OMEGA = 1e-3            # of RHEO: U/cs = 0.1 at n = 100
WARM, STEPS = 20, 60    # steps before those that count; those that count
RHEO_FACTOR = 3         # its steps are shorter
LOOP = re.compile(r"^Loop time of (\S+) on 1 procs for (\d+) steps with (\d+) atoms(?:(?!^Loop)"
                  r"[\s\S])*?^([\d.]+)% CPU use", re.M)


def own_script():
    """The example up to its measurements, and two runs."""
    text = scene.script("square-patch")
    head, found, _ = text.partition("# --- measurements")
    if not found:
        raise ValueError("examples/square-patch has no part 'measurements'")
    return f"{head}\nthermo 1000\nrun {WARM}\nrun {STEPS}\n"


def last_loop(text):
    """(microseconds per particle and step, particles) of the last run of a log."""
    loops = LOOP.findall(text)
    if not loops:
        raise ValueError("the log has no loop time with CPU use")
    seconds, steps, atoms, share = (float(x) for x in loops[-1])
    return 1e6 * seconds * min(1.0, share / 100) / (steps * atoms), int(atoms)


def time_step(text):
    return float(re.findall(r"^ +Time step +: +(\S+)", text, re.M)[-1])


def run_own(variables, n, folder):
    folder.mkdir(parents=True, exist_ok=True)
    script = folder / "in.patch-step"
    script.write_text(own_script(), encoding="ascii")
    text = common.run_lammps(script, {"d": 1 / n, **variables}, folder)
    return (*last_loop(text), time_step(text))


def run_rheo(n, folder):
    variables = {"n": n, "omega": OMEGA, "zeta": 1, "eta": 1e-3, "damp": 1, "dt": 0.1, "p0": 0.0,
                 "warm": WARM, "end": WARM + RHEO_FACTOR * STEPS, "every": 0}
    text = common.run_lammps(RHEO, variables, folder)
    return (*last_loop(text), OMEGA * time_step(text))


def measure(n, rounds, scratch):
    """One row per code: the medians, and the ratio to RHEO."""
    runs = {"rheo": [], **{name: [] for name in OURS}}
    for k in range(rounds):
        runs["rheo"].append(run_rheo(n, scratch / f"rheo-{k}"))
        for name, variables in OURS.items():
            runs[name].append(run_own(variables, n, scratch / f"{name}-{k}"))
    return rows(runs)


def rows(runs):
    """Of the ratio the median of the rounds, in each of which the codes ran one after another."""
    return [{"code": "rheo" if name == "rheo" else "aleisph", "frame": name, "N": of[0][1],
             "omega dt": of[0][2], "microseconds": statistics.median(run[0] for run in of),
             "least": min(run[0] for run in of), "most": max(run[0] for run in of),
             "ratio": statistics.median(run[0] / its[0] for run, its in zip(of, runs["rheo"])),
             "rheo": statistics.median(its[0] for its in runs["rheo"])}
            for name, of in runs.items()]


def result_lines(table):
    for row in table:
        if row["code"] == "aleisph":
            yield common.result_line(case="patch-step", quantity="ratio", peer="rheo",
                                     frame=row["frame"], value=row["ratio"], reference=1,
                                     microseconds=row["microseconds"], N=row["N"], ranks=1,
                                     **{"peer-microseconds": row["rheo"]})
