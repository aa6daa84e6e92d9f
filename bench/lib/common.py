# SPDX-License-Identifier: GPL-2.0-only
"""What the benchmarks share: running LAMMPS, exact solutions, error norm, comparing two codes."""

import csv
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np

sys.path.append(str(Path(__file__).resolve().parents[2] / "tools"))

import dumps  # noqa: E402  (found in tools)

RESULT = "ALEISPH-RESULT"


# ---------------------------------------------------------------- running LAMMPS

def find_lammps():
    """Path of the LAMMPS program: the variable ALEISPH_LMP, else the first 'lmp' in PATH."""
    lmp = os.environ.get("ALEISPH_LMP") or shutil.which("lmp")
    if not lmp:
        sys.exit("no LAMMPS: put 'lmp' in PATH, set ALEISPH_LMP, or use ./aleisph bench")
    return lmp


def find_mpi():
    return os.environ.get("ALEISPH_MPIEXEC") or shutil.which("mpirun") or sys.exit("no mpirun")


def command_line(script, variables, ranks=1):
    launcher = [find_mpi(), "-np", str(ranks)] if ranks > 1 else []
    command = [*launcher, find_lammps(), "-in", str(script), "-nocite"]
    for name, value in variables.items():  # a tuple: a variable that takes one value after another
        values = value if isinstance(value, tuple) else (value,)
        command += ["-var", name, *map(str, values)]
    return command


def environment():
    # RHEO links BLAS and LAPACK; more than one thread there would not be a run on one core.
    return dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")


def run_lammps(script, variables, folder, ranks=1):
    """One process on one core, or one per rank; returns what it prints. What it writes goes to the
    folder."""
    folder.mkdir(parents=True, exist_ok=True)
    command = command_line(script, variables, ranks)
    done = subprocess.run(command, cwd=folder, env=environment(), text=True, check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        tail = "\n".join(done.stdout.splitlines()[-12:])
        raise RuntimeError(f"{' '.join(command)}\nended with status {done.returncode}:\n{tail}")
    return done.stdout


def attempt_lammps(script, variables, folder, ranks=1, limit=None):
    """The same for a run that may fail or last too long (limit in seconds): what it printed, and
    how it failed, "" if it did not."""
    folder.mkdir(parents=True, exist_ok=True)
    with open(folder / "output", "w", encoding="ascii") as output:
        process = subprocess.Popen(command_line(script, variables, ranks), cwd=folder,
                                   env=environment(), stdin=subprocess.DEVNULL, stdout=output,
                                   stderr=subprocess.STDOUT)
        try:
            failure = f"status {status}" if (status := process.wait(limit)) else ""
        except subprocess.TimeoutExpired:
            process.terminate()  # mpirun ends its ranks, which it could not if it were killed
            process.wait()
            failure = f"stopped after {limit:g} s"
    text = (folder / "output").read_text(encoding="ascii", errors="replace")
    return text, (error_of(text) or failure) if failure else ""


def error_of(text):
    """The first error that LAMMPS named, without the line in its source; "" if there is none."""
    named = re.search(r"^ERROR.*?(?= \(src/|$)", text, re.MULTILINE)
    return named[0].strip() if named else ""


def cpu_share(text):
    """Share of its core that a run had, from LAMMPS' own timing ("99.8% CPU use").

    Run times are multiplied by it: what other programs on the machine took is not counted.
    """
    # A run with "post no" has a loop time and no CPU use: it is left out.
    pairs = re.findall(r"^Loop time of (\S+) on(?:(?!^Loop time of)[\s\S])*?^([\d.]+)% CPU use",
                       text, re.MULTILINE)
    total = sum(float(time) for time, _ in pairs)
    return min(1.0, sum(float(t) * float(s) / 100 for t, s in pairs) / total) if total > 0 else 1.0


def fields(line):
    """The key=value pairs of one result line; numbers as numbers."""
    pairs = {}
    for key, value in re.findall(r"(\S+?)=(\S+)", line):
        try:
            pairs[key] = float(value)
        except ValueError:
            pairs[key] = value
    return pairs


def lines_with(tag, text):
    return [fields(line) for line in text.splitlines() if line.startswith(tag + " ")]


def number_or_text(word):
    for kind in (int, float):
        try:
            return kind(word)
        except ValueError:
            pass
    return word


def read_dump(path):
    """Rows of the last snapshot of a text dump."""
    return np.array(dumps.last_snapshot(path).rows)


# ---------------------------------------------------------------- plane Poiseuille start-up

def plane_steady(y, H, G, nu):
    """u = G (H^2 - y^2) / (2 nu) between walls at y = -H and y = H, zero in the wall."""
    return G / (2 * nu) * np.maximum(H * H - y * y, 0)


def plane_start_up(y, H, G, nu, t):
    """From rest: steady profile minus the decaying cosine series (separation of variables)."""
    tau = nu * t / H**2
    # Terms below exp(-40) do not change a double; 2000 terms resolve tau of 1e-6.
    count = min(2000, 2 + int(np.sqrt(40 / max(tau, 1e-12)) / np.pi))
    n = np.arange(count)
    k = (n + 0.5) * np.pi
    weight = 2 * (-1.0)**n / k**3 * np.exp(-k**2 * tau)
    eta = np.clip(y / H, -1, 1)
    series = np.cos(np.outer(eta, k)) @ weight
    return plane_steady(y, H, G, nu) - G * H * H / nu * series


def plane_l2(y, u, H, G, nu, t):
    """rms(u - u_exact) / rms(u_steady) over the fluid particles at y (0 = centre plane)."""
    error = u - plane_start_up(y, H, G, nu, t)
    return np.sqrt(np.mean(error**2) / np.mean(plane_steady(y, H, G, nu)**2))


def fit_wall(profiles, H, G, nu, d):
    """Shift of both walls (in d, outwards) for which the profiles fit the exact solution best.

    profiles: [(y, u, t), ...] of one run. A code whose wall particles do not lie on the wall has a
    no-slip plane somewhere near them; one position per run minimises the sum of squares of L2.
    """
    return least_at(lambda shift: sum(plane_l2(y, u, H + shift * d, G, nu, t)**2
                                      for y, u, t in profiles))


def least_at(cost):
    """Where a function of the shift of a wall is least, within 1.5 d of the nominal one."""
    centre, width = 0.0, 1.5
    for _ in range(4):  # 4 scans of 31 points narrow the range to 1e-4 d, ample for a 1e-4 error
        shifts = centre + width * np.linspace(-1, 1, 31)
        centre = shifts[np.argmin([cost(s) for s in shifts])]
        width /= 10
    return centre


# ---------------------------------------------------------------- comparing two codes

def envelope(points):
    """Best points of a code: sorted by run time, each with less error than all quicker ones."""
    best = []
    for seconds, error in sorted(points):
        if not best or error < best[-1][1]:
            best.append((seconds, error))
    return best


def time_for_error(points, error):
    """Run time that reaches this error, log-log along the envelope: (seconds, relation).

    relation "<": even the quickest run is better, so the true time is below; None: out of reach.
    """
    best = envelope(points)
    if error >= best[0][1]:
        return best[0][0], "<" if error > best[0][1] else "="
    if error < best[-1][1]:
        return None, None
    seconds, errors = np.array(best).T
    order = np.argsort(errors)
    return float(np.exp(np.interp(np.log(error), np.log(errors[order]),
                                  np.log(seconds[order])))), "="


def error_at_time(points, seconds):
    """Error reached within this run time, log-log along the envelope: (error, relation).

    relation "<": this much time was never used up, so the true error is below; None: too short.
    """
    best = envelope(points)
    times, errors = np.array(best).T
    if seconds < times[0]:
        return None, None
    relation = "<" if seconds > times[-1] else "="
    return float(np.exp(np.interp(np.log(seconds), np.log(times), np.log(errors)))), relation


# ---------------------------------------------------------------- tables

def write_csv(path, rows):
    columns = list(dict.fromkeys(key for row in rows for key in row))
    path.parent.mkdir(parents=True, exist_ok=True)
    with open(path, "w", newline="", encoding="ascii") as out:
        writer = csv.DictWriter(out, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows({k: number(v) for k, v in row.items()} for row in rows)


def markdown(rows, columns, digits=4):
    """A table; columns: {key: heading}."""
    body = [[number(row.get(key, ""), digits) for key in columns] for row in rows]
    lines = ["| " + " | ".join(columns.values()) + " |", "|" + "---|" * len(columns)]
    return "\n".join(lines + ["| " + " | ".join(cells) + " |" for cells in body]) + "\n"


def number(value, digits=4):
    if isinstance(value, (float, np.floating)):
        return f"{value:.{digits}g}"
    return "" if value is None else str(value)


def result_line(**pairs):
    return RESULT + " " + " ".join(f"{k}={number(v)}" for k, v in pairs.items() if v is not None)
