# SPDX-License-Identifier: GPL-2.0-only
"""Orders in space and in time: series of runs of one flow, and what they show.

A series in space halves the spacing and keeps nu dt/d^2 or the Courant number; its order is that of
the error beside the exact or reference solution. A series in time halves the step on the same
particles; its order is that of the difference from the run with the smallest step, since the error
beside the exact solution tends to the error in space, not to zero.
"""

import math
import sys
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

import common
import scene

LIB = Path(__file__).resolve().parent
STATE = "write_dump all custom final.order id type x y z vx vy vz d_aleisph_p &\n" \
        "  modify sort id format float %.15g\n"
NO_ORDER = ""    # of a pair of runs of which the finer one is not better


@dataclass
class Series:
    """Runs of one flow, from coarse to fine, or from large steps to small ones."""
    case: str          # an example, or a script of bench/lib
    frame: str
    what: str          # that tells it from other series of the case and frame
    kind: str          # space or time
    runs: list         # of (label of the run, its variables)
    errors: dict       # {quantity: key of its result line, or relative: of the value}
    n: int = 0         # spacings across, of a series in time
    fields: tuple = ("u",)    # of which a series in time takes the differences
    wanted: dict = field(default_factory=dict)    # {quantity: order that theory has}
    changes: tuple = ()       # options that the fixes of an example get: (fix, options)

    def title(self):
        return f"{self.case} {self.what}".strip()


# ---------------------------------------------------------------- orders

def order_of_errors(coarse, fine):
    """Of two (spacing, error)."""
    if not coarse[1] > fine[1] > 0:
        return NO_ORDER
    return math.log(coarse[1] / fine[1]) / math.log(coarse[0] / fine[0])


def order_of_differences(large, small, least):
    """The p of an error in proportion to dt^p that explains two (dt, difference from the run with
    the step least): (dt1^p - dt0^p)/(dt2^p - dt0^p) is their ratio, which grows with p."""
    if not large[1] > small[1] > 0:
        return NO_ORDER
    wanted = math.log(large[1] / small[1])
    low, high = -8.0, 8.0
    for _ in range(60):
        p = 0.5 * (low + high)
        low, high = (p, high) if log_ratio(p, large[0], small[0], least) < wanted else (low, p)
    return 0.5 * (low + high)


def log_ratio(p, large, small, least):
    if abs(p) < 1e-9:    # its limit
        return math.log(math.log(large / least) / math.log(small / least))
    return math.log((large**p - least**p) / (small**p - least**p))


# ---------------------------------------------------------------- one run

def script_of(series, folder):
    """A copy of the script that ends by writing the state."""
    folder.mkdir(parents=True, exist_ok=True)
    own = LIB / f"{series.case}.in"
    text = own.read_text(encoding="ascii") if own.exists() else scene.script(series.case)
    for name, options in series.changes:
        text = scene.with_options(text, name, options)
    path = folder / f"in.{series.case}"
    path.write_text(text + "\n" + STATE, encoding="ascii")
    return path


def last_lines(text):
    """{quantity: its last result line}"""
    return {line["quantity"]: line for line in common.lines_with(common.RESULT, text)}


def error_of(line, key):
    """The error of a result line: its l2 or linf, or the relative one of its value."""
    if key == "relative":
        return abs(line["value"] / line["reference"] - 1)
    return line[key]


def state_of(path):
    """{"u": velocities, "p": pressures without their mean} of the fluid, in the order of the ids"""
    rows = common.read_dump(path)
    fluid = rows[rows[:, 1] == 1]
    p = fluid[:, 8]
    return {"u": fluid[:, 5:8], "p": p - np.mean(p)}


def difference(mine, theirs):
    """Root mean square of the difference over that of theirs."""
    return float(np.sqrt(np.sum((mine - theirs)**2) / np.sum(theirs**2)))


@dataclass
class Result:
    label: float
    dt: float
    d: float
    seconds: float
    errors: dict
    state: dict


def run(series, label, variables, folder):
    script = script_of(series, folder)
    needed = {"here": scene.EXAMPLES / series.case, "python": sys.executable}
    text = common.run_lammps(script, {**needed, **variables}, folder)
    lines = last_lines(text)
    some = next(iter(lines.values()))
    errors = {name: error_of(lines[name], key) for name, key in series.errors.items()}
    return Result(label, some["dt"], some["d"], common.cpu_share(text) * some["seconds"], errors,
                  state_of(folder / "final.order"))


# ---------------------------------------------------------------- a series

def rows_in_space(series, results):
    rows = []
    for k, result in enumerate(results):
        for name, error in result.errors.items():
            row = row_of(series, result, name)
            row.update({"n": result.label, "error": error})
            if k:
                before = results[k - 1]
                row["order"] = order_of_errors((before.d, before.errors[name]), (result.d, error))
            rows.append(row)
    return rows


def rows_in_time(series, results):
    """A row for each quantity with an error, and for each field with a difference."""
    rows = []
    least = results[-1]
    for name in dict.fromkeys([*series.fields, *series.errors]):
        off = {}
        if name in series.fields:
            off = {r.label: difference(r.state[name], least.state[name]) for r in results[:-1]}
        for k, result in enumerate(results):
            row = row_of(series, result, name)
            row.update({"n": series.n, "error": result.errors.get(name)})
            if result.label in off:
                row["difference"] = off[result.label]
            if k and result.label in off:
                before = results[k - 1]
                row["order"] = order_of_differences((before.dt, off[before.label]),
                                                    (result.dt, off[result.label]), least.dt)
            rows.append(row)
    return rows


def row_of(series, result, name):
    return {"series": series.kind, "case": series.case, "what": series.what, "frame": series.frame,
            "quantity": name, "wanted": series.wanted.get(name, ""), "step": result.label,
            "d": result.d, "dt": result.dt, "seconds": result.seconds}


def measure(series, folder):
    """The rows of the table; one run after the other."""
    results = [run(series, label, variables, folder / str(k))
               for k, (label, variables) in enumerate(series.runs)]
    return rows_in_space(series, results) if series.kind == "space" else \
        rows_in_time(series, results)
