# SPDX-License-Identifier: GPL-2.0-only
"""One solve of the pressure equation of a scene, from zero, with a preconditioner."""

import re
import resource
import time

import common
import scene
import sizes
import timing

TOLERANCE = 1e-8
# Those of fix aleisph/ppe, and the largest N for which they are tried
NAMES = ("none", "jacobi", "ilu0", "amg")
LARGEST = {"none": 1.2e5}     # beyond, jacobi shows the same
MOST = 20000    # iterations
MISSING = re.compile(r"unknown preconditioner|preconditioner \w+ needs")     # in an error
REPLACED = re.compile(r"^WARNING: .*preconditioner \w+ failed.*jacobi was used", re.M)
SHORT, REPEATS = 1.0, 3     # seconds
RUN = """
thermo_style custom step f_ppe[1] f_ppe[2]
run 0
print "PRESSURE iterations=$(f_ppe[1]) residual=$(f_ppe[2]) restarts=$(f_ppe[4]) \
solves=$(f_ppe[9]/(f_ppe[1]+1.0e-300)) failed=$(f_ppe[8]) fluid=$(count(fluid))"
"""


def affordable(names, N):
    return [name for name in names if N <= LARGEST.get(name, N)]


def too_long(row):
    return str(row.get("note")).startswith("stopped-after")


def script(text, preconditioner):
    """A scene without run, with this preconditioner and a first solve."""
    words = f"preconditioner {preconditioner} maxiter {MOST} failure warn"
    return scene.with_options(text, "ppe", words) + RUN


def available(names, folder):
    """Those that this build has; says which it has not."""
    found = []
    path = folder / "in.probe"
    for name in names:
        text = script(sizes.TANK_2D.head(), name)
        path.write_text(text, encoding="ascii")
        variables = {"dim": 2, "n": 8, "tol": TOLERANCE}
        _, failure = common.attempt_lammps(path, variables, folder / "probe")
        if MISSING.search(failure):
            print(f"no preconditioner {name} in this build: left out", flush=True)
        elif failure:
            raise RuntimeError(f"preconditioner {name}: {failure}")
        else:
            found.append(name)
    return found


def solve(path, variables, name, folder, limit, ranks):
    """A row; path: the scene. Of short solves the quickest of some: the rest of such a run, and
    what the machine does besides, would count too much."""
    row = attempt(path, variables, name, folder, limit, ranks)
    if row.get("seconds", SHORT) < SHORT:
        again = [attempt(path, variables, name, folder, limit, ranks) for _ in range(REPEATS - 1)]
        differ = len({other.get("iterations") for other in (row, *again)}) > 1
        row = min((row, *again), key=lambda other: other.get("seconds", SHORT))
        row["note"] = "not-reproducible" if differ else row["note"]
    return row


def attempt(path, variables, name, folder, limit, ranks):
    """A solve that did not converge, or took too long, has a note."""
    run = folder / "in.solve"
    run.write_text(script(path.read_text(encoding="ascii"), name), encoding="ascii")
    start, before = time.perf_counter(), cpu_seconds()
    text, failure = common.attempt_lammps(run, {**variables, "tol": TOLERANCE},
                                          folder / "solve", ranks, limit)
    share = (cpu_seconds() - before) / (time.perf_counter() - start) if ranks == 1 else None
    if failure:
        found = re.search(r"^\s*(\d+) atoms$", text, re.M)
        return {"preconditioner": name, "N": int(found[1]) if found else None, "ranks": ranks,
                "note": failure.replace(" ", "-")}
    return read(text, name, ranks, share)


def cpu_seconds():
    """Of the programs that were run so far."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def read(text, name, ranks, share=None):
    """share: of its core that the process had; a note only, short runs wait for their start."""
    seconds, _, _, atoms = timing.last_block(text)
    line = common.lines_with("PRESSURE", text)[0]
    notes = ["not-converged"] if line["failed"] or not line["residual"] <= TOLERANCE else []
    notes += ["fallback"] if REPLACED.search(text) else []
    set_up, solve_ = seconds.get("preconditioner", 0.0), seconds["solve"]
    return {"preconditioner": name, "N": atoms, "fluid": int(line["fluid"]),
            "iterations": int(line["iterations"]), "residual": line["residual"],
            "set-up": set_up, "solve": solve_, "seconds": set_up + solve_, "ranks": ranks,
            "cpu share": share,
            "note": "+".join(notes) or None}


def result(row):
    """The pairs of the result line of a row."""
    return {"case": row["case"], "quantity": "iterations", "preconditioner": row["preconditioner"],
            "N": row["N"], "value": row.get("iterations", "none"), "seconds": row.get("seconds"),
            "set-up": row.get("set-up"), "solve": row.get("solve"), "ranks": row["ranks"],
            "cpu-share": row.get("cpu share"), "refined": row.get("refined"),
            "note": row.get("note")}


def growth(rows, first=1e4):
    """Iterations of the largest N over those of the one next to 1e4, of each series."""
    series = {}
    for row in rows:
        if row.get("iterations") and not row.get("note"):
            series.setdefault((row["case"], row["preconditioner"]), []).append(row)
    lines = []
    for (case, name), group in series.items():
        low = min(group, key=lambda row: max(row["N"] / first, first / row["N"]))
        high = max(group, key=lambda row: row["N"])
        if high["N"] > low["N"]:
            lines.append({"case": case, "quantity": "growth", "preconditioner": name,
                          "N": high["N"], "from": low["N"], "first": low["iterations"],
                          "last": high["iterations"],
                          "value": high["iterations"] / low["iterations"]})
    return lines
