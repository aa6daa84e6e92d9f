# SPDX-License-Identifier: GPL-2.0-only
"""One dam break for every code: a column a wide and 2 a high in a tank 5 a long; its front.

Front: foremost particle within four spacings of the floor, Z = 1 + (x - x(0))/a over
T = t sqrt(2 g/a).
"""

import csv
import math
import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

import common
import scene

TABLE = Path(__file__).resolve().parents[2] / "tests/reference/dambreak_martin_moyce.csv"
PEERS = Path(__file__).resolve().parents[1] / "peers"
RHEO, SPH = PEERS / "rheo-dam-break.in", PEERS / "sph-dam-break.in"
WIDTH, GRAVITY = 0.2, 9.81  # of the column, of examples/dam-break
END = 3.4                   # T; the last time of the experiment is 3.33

# LAMMPS' example rheo/dam-break: fluid 57 high, g = 1e-3, eta = 0.1, cs = 1, all in spacings
HEIGHT = 57.0
MACH = math.sqrt(2 * 1e-3 * HEIGHT)
REYNOLDS = HEIGHT * math.sqrt(1e-3 * HEIGHT) / 0.1


@dataclass
class Setup:
    code: str
    variant: str
    n: int             # spacings across the column
    step: float = 1    # 0.5: half the time step
    mach: float = MACH
    viscous: float = 1.0      # 1: the Reynolds number of RHEO's example; 0: inviscid, slip walls
    zeta: float = 0.1
    options: dict = field(default_factory=dict)


def experiment():
    """T and Z of Martin & Moyce."""
    with open(TABLE, encoding="ascii") as lines:
        rows = csv.DictReader(line for line in lines if not line.startswith("#"))
        return np.array([(float(r["T"]), float(r["Z"])) for r in rows if r["set"] == "table"]).T


def columns(path, time, front):
    """Two columns of a file of fix ave/time; its last line may be incomplete."""
    lines = [line.split() for line in Path(path).read_text(encoding="ascii").splitlines()]
    rows = [line for line in lines if line[0].isdigit()]
    table = np.array([row for row in rows if len(row) == len(rows[0])], dtype=float)
    return table[:, time], table[:, front]


def run_rheo(setup, folder):
    """cs = 1, d = 1; dt = 0.1 cut/(3 cs) as in the example."""
    height = 2 * setup.n
    g = setup.mach**2 / (2 * height)
    dt = 0.1 * 2.2 / 3 * setup.step
    variables = {"n": setup.n, "g": g, "zeta": setup.zeta, "dt": dt, "every": 5,
                 "eta": setup.viscous * height * math.sqrt(g * height) / REYNOLDS,
                 "end": END * math.sqrt(setup.n / (2 * g))}
    text = common.run_lammps(RHEO, variables, folder)
    report = common.lines_with("DAM-BREAK", text)[0]
    T, x = columns(folder / "series.rheo-dam-break", 1, 2)
    return text, report["N"], report["seconds"], T, 1 + (x - x[0]) / setup.n


def run_sph(setup, folder):
    """cs = 1, d = 1; dt = 0.1 h/cs as in the example water_collapse, h = 3 d."""
    g = setup.mach**2 / (4 * setup.n)
    variables = {"n": setup.n, "g": g, "alpha": setup.zeta, "dt": 0.3 * setup.step, "every": 5,
                 "end": END * math.sqrt(setup.n / (2 * g)), "sum": 1, **setup.options}
    text = common.run_lammps(SPH, variables, folder)
    report = common.lines_with("DAM-BREAK", text)[0]
    T, x = columns(folder / "series.dam-break", 1, 2)
    return text, report["N"], report["seconds"], T, 1 + (x - x[0]) / setup.n


def run_own(setup, folder):
    text = scene.script("dam-break")
    if setup.viscous:
        H = 2 * WIDTH
        nu = setup.viscous * H * math.sqrt(GRAVITY * H) / REYNOLDS
        text = scene.with_words(text, "wall", "condition slip", "condition no-slip")
        text = scene.with_options(text, "move", f"nu {nu:.6g}")
        # The example starts with the step for its body force; explicit viscosity is checked then.
        first = f"$(ternary(v_most<{0.25 / nu:.6g}*v_d^2,v_most,{0.25 / nu:.6g}*v_d^2))"
        text = scene.with_first_step(text, first)
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "in.dam-break").write_text(text, encoding="ascii")
    variables = {"d": WIDTH / setup.n, "a": WIDTH, "cfl": 0.2 * setup.step, "Tend": END,
                 "T": 3.33, "Z": 4.11, "every": END, **setup.options}
    text = common.run_lammps(folder / "in.dam-break", variables, folder)
    line = [x for x in common.lines_with(common.RESULT, text) if x["quantity"] == "energy"][0]
    T, Z = columns(folder / "series.dam-break", 1, 2)
    return text, line["N"], line["seconds"], T, 1 + Z - Z[0]


def run(setup, folder):
    """A row with the curve of the front in 'T' and 'Z'."""
    code = {"aleisph": run_own, "rheo": run_rheo, "sph": run_sph}[setup.code]
    text, N, seconds, T, Z = code(setup, folder)
    if not np.all(np.isfinite(Z)) or T[-1] < experiment()[0][-1]:
        raise RuntimeError(f"{setup}: no front up to the last time of the experiment")
    share = common.cpu_share(text)
    return {"case": "dam-break", "code": setup.code, "variant": setup.variant, "n": setup.n,
            "step": setup.step, "N": int(N), "steps": steps(text), "seconds": share * seconds,
            "cpu share": share, "T": T, "Z": Z}


def steps(text):
    """Of all runs of a log."""
    return sum(int(count) for count in re.findall(r"^Loop time .* for (\d+) steps", text, re.M))


def rms(curve, T, Z, shift=0.0):
    """Of the front against points (T, Z), with the run later by the shift."""
    return float(np.sqrt(np.mean((np.interp(T - shift, *curve) - Z)**2)))


def best_shift(curve, T, Z):
    """Delay of the run for which it fits the points best, to 0.002."""
    shifts = np.arange(-0.2, 0.6, 0.002)
    return float(shifts[np.argmin([rms(curve, T, Z, s) for s in shifts])])


def errors(row, finest):
    """Against the experiment, against it with the best delay, against a finest run of the code."""
    T, Z = experiment()
    curve = row["T"], row["Z"]
    shift = best_shift(curve, T, Z)
    out = {"rms experiment": rms(curve, T, Z), "delay": shift,
           "rms delayed": rms(curve, T, Z, shift)}
    for name, other in finest.items():
        if other is not row:
            out[f"rms {name}"] = rms(curve, T, np.interp(T, other["T"], other["Z"]))
    return out


def fronts(row, times=(0.84, 1.19, 1.63, 1.98, 2.51, 2.83)):
    return {f"Z({T:g})": float(np.interp(T, row["T"], row["Z"])) for T in times}
