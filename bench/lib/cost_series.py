# SPDX-License-Identifier: GPL-2.0-only
"""Cost of a step of moving particles, and memory, over the number of particles."""

from pathlib import Path

import common
import sizes
import timing

CASES = {scene.case: scene for scene in (sizes.TANK_2D, sizes.TANK_3D, sizes.PATCH)}
TOLERANCE = 1e-8    # the default of fix aleisph/ppe
WORK = 2e6          # particle-steps of a run, within the limits of the steps
FEWEST, MOST = 3, 100
WARM_UP = 5         # steps before, at most as many as those that are measured
REFERENCE = 10.0    # GB/s: a core for which the 3d tank is stated, too
BANDWIDTH = "bandwidth [GB/s]"
STATED = ("3d-tank", 2e5)
SAMPLE = "thermo_style custom step\nthermo_modify flush no\nthermo 0\nrun {}\nrun {} pre no\n"


def steps(nominal):
    return max(FEWEST, min(MOST, round(WORK / nominal)))


def script(scene, nominal):
    """Nothing is measured or written in the steps; the first ones start lists and pressure."""
    count = steps(nominal)
    sample = SAMPLE.format(min(WARM_UP, count), count)
    return scene.head() + sample + timing.WRITE_PEAK


def measure(scene, nominal, folder, ranks):
    """(row, {part: microseconds of the core per particle and step}): times the share of the core
    that the run had, so that other programs on the machine do not change them much."""
    path = Path(folder) / f"in.{scene.case}"
    path.write_text(script(scene, nominal), encoding="ascii")
    variables = {**scene.variables(nominal), "tol": TOLERANCE}
    text = common.run_lammps(path, variables, Path(folder), ranks)
    parts, atoms, count = timing.by_part(text)
    share = common.cpu_share(timing.last_run(text))  # of what is measured
    parts = {part: share * value for part, value in parts.items()}
    row = {"case": scene.case, "dimension": scene.dimension, "N": atoms, "steps": count,
           "ranks": ranks, **parts, "cpu share": share}
    return {**row, "peak [MB]": (timing.peak_bytes(Path(folder)) or 0) / 1e6}, parts


def lines(row, parts):
    """Result lines of a run."""
    for part, value in parts.items():
        yield {"case": row["case"], "N": row["N"], "part": part,
               "quantity": "microseconds-per-particle-step", "value": value,
               "ranks": row["ranks"]}


def at_reference(row):
    """What a core of another bandwidth would need if nothing but bandwidth counted."""
    return {"case": row["case"], "quantity": "microseconds-per-particle-step-at-10GB/s",
            "N": row["N"], "value": row["total"] * row[BANDWIDTH] / REFERENCE,
            "measured": row["total"], "bandwidth-GB/s": row[BANDWIDTH],
            "ranks": row["ranks"],
            "cpu-share": row["cpu share"]}


def slope(rows):
    """Of the time of a step (all particles) against N."""
    N = [row["N"] for row in rows]
    value = timing.slope(N, [row["total"] * row["N"] for row in rows])
    return {"case": rows[0]["case"], "quantity": "slope", "value": value, "from": min(N),
            "N": max(N), "ranks": rows[0]["ranks"]}


def memory(rows):
    """Of rank 0, so of runs on one rank only."""
    N, peak = ([row[key] for row in rows] for key in ("N", "peak [MB]"))
    return {"case": rows[0]["case"], "quantity": "bytes-per-particle", "from": min(N),
            "N": max(N), "value": 1e6 * timing.per_particle(N, peak)}


def summary(rows):
    """Time at the reference, slope and memory of the runs of one case."""
    stated = [at_reference(row) for row in rows if row.get(BANDWIDTH)]
    if len(rows) < 2:
        return stated
    known = rows[0]["ranks"] == 1 and all(row["peak [MB]"] for row in rows)
    return [*stated, slope(rows), *([memory(rows)] if known else [])]
