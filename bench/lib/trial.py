# SPDX-License-Identifier: GPL-2.0-only
"""One run of the stability report: an example with one factor changed, and what is measured."""

import math
import re
import sys
from dataclasses import dataclass

import numpy as np

import common
import dumps    # found by common
import scene
import shape

FRAMES = 20           # snapshots that are measured
ENERGY, VOLUME = 1.01, 0.05  # beyond these a run that finished has not held
GUARDS = ("walls", "collision", "pressure", "symmetric", "selfterm", "cap")


@dataclass
class Setup:
    """A case and its base values; walls at 0 and 1. short: the end at CFL 0.02."""
    example: str
    d: float
    end: float
    short: float
    cfl: float
    jitter: float
    variables: dict
    surface: str              # ID of fix aleisph/surface
    group: str                # of the fluid
    energy: tuple             # lines that define the variable bench_E
    result: str               # quantity of the result line that is the accuracy of the run
    key: str = "linf"
    until: float = math.inf   # the last time at which it is looked at
    guards: bool = False
    seeds: bool = False
    walls: int = 2            # type of wall particles
    dim: int = 2


TANK_E = ("variable bench_e atom 0.5*(vx^2+vy^2+vz^2)+$g*y",
          "variable bench_e0 atom $g*y",
          "compute bench_e fluid reduce sum v_bench_e",
          "run 0 post no",
          "variable bench_E0 equal $(c_bench_e)",
          "variable bench_E equal c_bench_e/v_bench_E0")

CASES = {
    "patch": Setup("square-patch", 0.04, 4.0, 1.0, 0.1, 0.0, {}, "open", "all",
                   ("variable bench_E equal v_energy/v_energy0",), "p-deviation", until=2.0),
    "tank": Setup("tank", 0.05, 8.8, 1.0, 0.2, 0.2, {"dim": 2}, "open", "fluid", TANK_E,
                  "v", key="l2"),
    "tank-3d": Setup("tank", 0.125, 6.2, 0.6, 0.2, 0.2, {"dim": 3}, "open", "fluid", TANK_E,
                     "v", key="l2", dim=3),
    "dam-break": Setup("dam-break", 0.02, 10.0, 3.0, 0.2, 0.01, {}, "surface", "fluid",
                       ("variable bench_E equal v_E",), "front", key="value", until=2.6,
                       guards=True, seeds=True),
}


@dataclass
class Trial:
    case: str
    factor: str
    value: object

    def setup(self):
        return CASES[self.case]

    def is_factor(self, name, other):
        return self.value if self.factor == name else other

    def ranks(self):
        return self.is_factor("ranks", 1)

    def name(self):
        return re.sub(r"[^\w.-]+", "-", f"{self.case}-{self.factor}-{self.value}")

    def spacing(self):
        """A whole number of spacings makes 1, the width of patch and tank."""
        return 1.0 / round(1.0 / (self.setup().d * self.is_factor("d x", 1)))

    def cfl(self):
        return self.is_factor("cfl", self.setup().cfl)

    def end(self):
        """In the unit of the example: 1/omega, s, sqrt(a/2g)."""
        return self.setup().short if self.cfl() < 0.03 else self.setup().end


def variables(one):
    """Of the example, on the command line."""
    setup = one.setup()
    common_ones = {"cfl": one.cfl(), "jitter": one.is_factor("jitter", setup.jitter),
                   **setup.variables}
    if one.factor == "seed":
        common_ones["seed"] = 1000 + one.value
    if setup.example == "square-patch":
        folder = scene.EXAMPLES / setup.example
        return {**common_ones, "d": one.spacing(), "T": one.end(), "here": folder,
                "python": sys.executable}
    if setup.example == "dam-break":
        return {**common_ones, "d": one.spacing(), "Tend": one.end()}
    n = round(1.0 / one.spacing())
    H = (n // 2 + 0.5) / n
    dt = one.cfl() / n / math.sqrt(9.81 * H)
    return {**common_ones, "n": n, "steps": 64 * max(1, round(one.end() / dt / 64))}


def unit_of_time(one):
    """Of end(), in the time of the run."""
    return math.sqrt(0.2 / (2 * 9.81)) if one.setup().example == "dam-break" else 1.0


def measurements(one):
    """Lines for the script: a row of sums in every step, and snapshots."""
    setup = one.setup()
    guards = [f"f_guard[{k}]" for k in range(7, 12)] if setup.guards else []
    columns = ["v_bench_t", "v_bench_E", f"f_{setup.surface}[1]", f"f_{setup.surface}[2]",
               "f_shift[3]", "f_ppe[1]", *guards]
    every = one.end() * unit_of_time(one) / FRAMES
    return [*setup.energy,
            "variable bench_t equal time",
            f"compute bench {setup.group} aleisph/atom surface",
            f"fix bench all ave/time 1 1 1 {' '.join(columns)} file series.bench",
            "dump bench all custom 1 dump.bench id type x y z vx vy vz d_aleisph_p c_bench",
            f"dump_modify bench every/time {every:.10g} first yes sort id time yes "
            "colname c_bench surface"]


def script(one):
    setup = one.setup()
    text = scene.script(setup.example)
    if one.factor == "kernel":
        text = scene.with_options(text, "sph", f"kernel {one.value}")
    if one.factor == "h/d":
        text = scene.with_options(text, "sph", f"h/d {one.value}")
    if one.factor == "guards":
        text = scene.bare_fix(text, "guard")
    return scene.before_run(text, measurements(one))


def frames(path):
    """Snapshots of a dump; one that is not whole is left out, and all if there is none."""
    if not path.exists():
        return
    try:
        for snapshot in dumps.snapshots(path):
            yield dumps.as_frame(snapshot)
    except ValueError as problem:
        print(problem, file=sys.stderr)


def shapes(one, path):
    """Area, surface particles over length of the edge, share of spray; a row per snapshot."""
    d = one.spacing()
    for frame in frames(path):
        wall = frame["type"] == one.setup().walls
        points = np.column_stack([frame["x"], frame["y"]])
        inside = None if not wall.any() else ((0.0, 1.0), (0.0, points[wall, 1].max()))
        if not np.all(np.isfinite(points)) or np.abs(points).max() > 1e3:
            return  # particles of a run that diverges would need a grid without end
        found = shape.measure(points[~wall], points[wall], d, inside)
        surface = (frame["surface"][~wall] > 0) & ~found.spray
        yield found.area, surface.sum() * d / found.edge if found.edge else 0.0, found.spray.mean()


def flat_shapes(one, text, series):
    """The same for the tank in three dimensions, whose surface stays flat."""
    n = round(1.0 / one.spacing()) - 1
    volumes = [line["value"] for line in common.lines_with(common.RESULT, text)
               if line["quantity"] == "volume"]
    for volume in [1.0, *volumes]:
        yield volume, np.mean(series[:, 3]) / n**2, 0.0


def read_series(path):
    """step, t, E/E0, surface, ballistic, shifts cut, iterations, guards; the last line may be a
    part of one."""
    lines = path.read_text(encoding="ascii").splitlines(keepends=True) if path.exists() else []
    rows = [line.split() for line in lines if line[:1].isdigit() and line.endswith("\n")]
    rows = [row for row in rows if len(row) == len(rows[0])]
    return np.array(rows, dtype=float) if rows else np.full((1, 7), np.nan)


def result(one, text):
    setup = one.setup()
    lines = [line for line in common.lines_with(common.RESULT, text)
             if line["quantity"] == setup.result and line["time"] < setup.until + 1e-6]
    return lines[-1][setup.key] if lines else None


def beyond(one, path):
    """Fluid particles on the wrong side of a wall, in any snapshot."""
    if one.setup().group == "all":
        return 0
    worst = 0
    for frame in frames(path):
        fluid = frame["type"] != one.setup().walls
        out = (frame["x"] < 0) | (frame["x"] > 1) | (frame["y"] < 0)
        if one.setup().dim == 3:
            out |= (frame["z"] < 0) | (frame["z"] > 1)
        worst = max(worst, int((out & fluid).sum()))
    return worst


def verdict(row):
    if row["failure"]:
        return row["failure"]
    grown = [name for name, bad in (("energy", not row["energy"] <= ENERGY),
                                    ("volume", not abs(row["volume"]) <= VOLUME),
                                    ("penetration", row["beyond"] > 0)) if bad]
    return "finished" + (": " + ", ".join(grown) if grown else "")


def run(one, folder, limit):
    """Runs it in the folder; a row of the report."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "in.bench").write_text(script(one), encoding="ascii")
    text, failure = common.attempt_lammps(folder / "in.bench", variables(one), folder,
                                          one.ranks(), limit)
    series = read_series(folder / "series.bench")
    found = list(flat_shapes(one, text, series) if one.setup().dim == 3
                 else shapes(one, folder / "dump.bench"))
    area, ratio, spray = np.array(found).T if found else np.full((3, 1), np.nan)
    change = area / area[0] - 1
    guards = series[-1, 7:]
    steps = int(np.nan_to_num(series[-1, 0]))
    row = {"case": one.case, "factor": one.factor, "value": one.value, "d": one.spacing(),
           "time": series[-1, 1] / unit_of_time(one), "end": one.end(), "steps": steps,
           "energy": np.nanmax(series[:, 2]), "last energy": series[-1, 2],
           "volume": change[np.argmax(np.abs(change))], "last volume": change[-1],
           "surface": ratio.mean(), "largest surface": ratio.max(), "spray": spray.max(),
           "ballistic": int(np.nan_to_num(series[:, 4]).max()),
           "limited": int(np.nan_to_num(series[-1, 5])),
           **{name: int(count) for name, count in zip(GUARDS, guards)},
           "beyond": beyond(one, folder / "dump.bench"), "measure": result(one, text),
           "iterations": np.nanmax(series[:, 6]),
           "seconds": sum(float(s) for s in re.findall(r"^Loop time of (\S+)", text, re.M)),
           "failure": failure}
    return {**row, "verdict": verdict(row)}
