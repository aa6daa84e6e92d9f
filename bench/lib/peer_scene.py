# SPDX-License-Identifier: GPL-2.0-only
"""Runs of a peer's script in bench/peers that writes snapshots at given times of comparison."""

from pathlib import Path

import numpy as np

import common

SCRIPTS = Path(__file__).resolve().parents[1] / "peers"
REPORT = "PEER"     # the scripts print "PEER N=.. seconds1=.. seconds2=.. " when they are through
LIMIT = 1800        # seconds


def run(case, setup, script, variables, snapshot, moments, error, folder):
    """One row per moment (time, step). error: a function of the columns of a snapshot and its step.

    A run that fails has rows with 'failure' from there on.
    """
    text, failure = common.attempt_lammps(SCRIPTS / script, variables, folder, limit=LIMIT)
    head = {"case": case, "code": setup.code, "variant": setup.variant, "n": setup.n,
            "mach": setup.mach, "dt": setup.dt}
    share = common.cpu_share(text)
    marks = {key: value for line in common.lines_with(REPORT, text) for key, value in line.items()}
    rows = []
    for index, (time, step) in enumerate(moments, 1):
        row = {**head, "steps": step, "time": time, "cpu share": share}
        value = snapshot_error(folder / f"{snapshot}.{index}", error, step)
        seconds = marks.get(f"seconds{index}")
        if value is None or seconds is None:
            rows.append({**row, "failure": failure or "not finite"})
        else:
            rows.append({**row, "N": int(marks[f"N{index}"]), "seconds": share * seconds,
                         "l2": value})
    return rows


def snapshot_error(path, error, step):
    try:
        columns = common.read_dump(path).T
    except (OSError, ValueError):    # a run that failed has none, or a part of one
        return None
    return error(columns, step) if np.all(np.isfinite(columns)) else None
