#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Iterations and run time of the pressure equation against N, for every preconditioner.

The first pressure of tanks at rest (disordered, 2d and 3d), of the pipe and of a dam break in
mid-splash (lib/splash.py), from zero, to a residual of 1e-8. Writes ppe.csv, ppe.md and ppe.png and
prints ALEISPH-RESULT lines.
"""

import argparse
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "lib"))

import common  # noqa: E402  (found in bench/lib)
import ppe_figure  # noqa: E402
import pressure  # noqa: E402
import sizes  # noqa: E402
import splash  # noqa: E402

HERE = Path(__file__).resolve().parent
SCENES = {scene.case: scene for scene in (sizes.TANK_2D, sizes.TANK_3D, sizes.PIPE)}
CASES = (*SCENES, "splash")
# Spacings across the column of the run, and how much finer its state is made
SPLASHES = {20: (1, 4, 11)}                 # 8e2 particles of the run; 1e4, 1e5
SPLASHES_FULL = {20: (1,), 40: (1, 2, 6, 18), 72: (1,)}   # to 1e6; 1e4 particles of a run


def measure(case, path, variables, preconditioners, options, notes):
    """Rows; a preconditioner that took too long is taken off the list."""
    rows = []
    for name in list(preconditioners):
        row = pressure.solve(path, variables, name, path.parent, options.limit, options.ranks)
        row = {"case": case, **row, **notes}
        print(common.result_line(**pressure.result(row)), flush=True)
        rows.append(row)
        if pressure.too_long(row):
            preconditioners.remove(name)
    return rows


def scene_rows(scene, names, options, folder):
    rows, names = [], list(names)
    for nominal in scene.upto(options.largest):
        path = folder / f"in.{scene.case}"
        path.write_text(scene.head(), encoding="ascii")
        names = pressure.affordable(names, nominal)
        rows += measure(scene.case, path, scene.variables(nominal), names, options, {})
    return rows


def splash_rows(names, options, folder):
    rows = []
    path = folder / "in.splash"
    path.write_text((HERE / "lib/splash.in").read_text(encoding="ascii"), encoding="ascii")
    for n, factors in (SPLASHES_FULL if options.full else SPLASHES).items():
        d = splash.COLUMN / n
        if 2 * n**2 > options.largest:
            continue
        x, v = splash.run(n, folder / f"run-{n}")
        rest = list(names)
        for m in factors:
            if 2 * (n * m)**2 > 1.2 * options.largest:
                continue
            count = splash.write_data(folder / "data", *splash.refine(x, v, d, m), d / m)
            variables = {"data": folder / "data", "d": d / m, "dt": splash.step(v, d / m)}
            rest = pressure.affordable(rest, count)
            rows += measure("splash", path, variables, rest, options, {"refined": m})
    return rows


def write(rows, options):
    growth = pressure.growth(rows)
    for row in growth:
        print(common.result_line(**row), flush=True)
    common.write_csv(options.out / "ppe.csv", rows)
    columns = {key: key for key in dict.fromkeys(key for row in rows for key in row)}
    heads = {"case": "case", "preconditioner": "preconditioner", "N": "to N", "from": "from N",
             "first": "iterations at first", "last": "and at last", "value": "growth"}
    text = common.markdown(rows, columns, digits=3) + "\n" + common.markdown(growth, heads, 3)
    (options.out / "ppe.md").write_text(text, encoding="ascii")
    print(text)
    ppe_figure.draw(rows, options.out / "ppe.png")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=HERE / "results",
                        help="folder of what is written")
    parser.add_argument("--full", action="store_true", help="up to 1e6 particles, not 1e5")
    parser.add_argument("--largest", type=float, help="largest number of particles, instead")
    parser.add_argument("--only", choices=CASES, nargs="+", default=CASES)
    parser.add_argument("--preconditioner", nargs="+", default=pressure.NAMES)
    parser.add_argument("--ranks", type=int, default=1)
    parser.add_argument("--limit", type=float, default=1200, help="seconds of one run")
    options = parser.parse_args()
    options.largest = options.largest or (1e6 if options.full else 1e5)
    with tempfile.TemporaryDirectory(prefix="aleisph-bench-") as scratch:
        folder = Path(scratch)
        names = pressure.available(options.preconditioner, folder)
        rows = []
        for case in options.only:
            if case in SCENES:
                rows += scene_rows(SCENES[case], names, options, folder)
            else:
                rows += splash_rows(names, options, folder)
            common.write_csv(options.out / "ppe.csv", rows)    # kept if a later case is stopped
    write(rows, options)


if __name__ == "__main__":
    main()
