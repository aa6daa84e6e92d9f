# SPDX-License-Identifier: GPL-2.0-only
"""Reads the timing that the styles print after a run ("ALEISPH time: ..."), and growth with N."""

import re
import time

import numpy as np

PART = re.compile(r"^  (\w[\w -]*?) +(\S+) s +\S+ %")
LOOP = re.compile(r"^Loop time of (\S+) on \d+ procs for (\d+) steps with (\d+) atoms", re.M)
PEAK = re.compile(r"^VmHWM:\s+(\d+) kB")

# Peak resident memory of rank 0, as its system counts it. What a parent reads of its child would
# include the parent's own memory at the time of the fork. $PPID: LAMMPS itself; LAMMPS does not
# substitute in quotes.
WRITE_PEAK = 'shell "grep VmHWM /proc/$PPID/status > peak-memory"\n'


def last_block(text):
    """Of the last run of a log: seconds by part (mean over the ranks), loop time, steps, atoms.

    Lines that are no part, such as counts, may stand between and behind the parts.
    """
    before, _, report = text.rpartition("ALEISPH time:")
    loops = list(LOOP.finditer(before))
    seconds = {m[1]: float(m[2]) for m in map(PART.match, report.splitlines()) if m}
    if not loops or not seconds:
        raise RuntimeError("the log has no 'Loop time' before an 'ALEISPH time' with its parts")
    loop = loops[-1]
    return seconds, float(loop[1]), int(loop[2]), int(loop[3])


def last_run(text):
    """What a log says of the last run that has a report: "Loop time" and what follows it."""
    end = text.rindex("ALEISPH time:")
    return text[text.rindex("Loop time of", 0, end):end]


def by_part(text):
    """({part: microseconds per particle and step}, atoms, steps).

    total: the time between first and last step. other: what of it is in no part, which is LAMMPS'
    own work: neighbor lists, forces, output.
    """
    seconds, loop, steps, atoms = last_block(text)
    scale = 1e6 / (steps * atoms)
    parts = {part: scale * s for part, s in seconds.items()}
    parts["other"] = scale * max(0.0, loop - sum(seconds.values()))
    parts["total"] = scale * loop
    return parts, atoms, steps


def peak_bytes(folder):
    """Of a run in this folder whose script ends with WRITE_PEAK; None where systems do not say."""
    path = folder / "peak-memory"
    found = PEAK.match(path.read_text(encoding="ascii")) if path.exists() else None
    return 1024 * int(found[1]) if found else None


def slope(N, value):
    """Exponent k of value ~ N^k, least squares in logarithms."""
    return float(np.polyfit(np.log(N), np.log(value), 1)[0])


def per_particle(N, peak):
    """Bytes per particle between the smallest and the largest run: the program itself cancels."""
    low, high = min(zip(N, peak)), max(zip(N, peak))
    return (high[1] - low[1]) / (high[0] - low[0])


def bandwidth(length=40_000_000, repeats=5):
    """Bytes per second of a = b + c over doubles on one core; 24 bytes per element, as STREAM
    counts, and seconds of the core, not of the clock. The best of the repeats."""
    b, c, a = np.ones(length), np.full(length, 2.0), np.zeros(length)
    best = np.inf
    for _ in range(repeats):
        start = time.process_time()
        np.add(b, c, out=a)
        best = min(best, time.process_time() - start)
    return 24.0 * length / best
