#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Error against run time with a free surface: rotating patch, and dam break beside RHEO.

The patch is the example square-patch over three resolutions, in both variants of shifting and
surface; the dam break is the example dam-break and LAMMPS' RHEO with the settings of its own dam
break, in the same geometry to the same physical time. Every run is one process on one core. Writes
free_surface.csv, free_surface.md and free_surface.png.
"""

import argparse
import csv
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "lib"))

import numpy as np  # noqa: E402

import common  # noqa: E402  (found in bench/lib)
import dam_break  # noqa: E402
import patch  # noqa: E402
import peers_dam_break  # noqa: E402
import plot  # noqa: E402

HERE = Path(__file__).resolve().parent
PATCH = {"variant": "variant", "n": "L/d", "step": "dt", "N": "N", "steps": "steps",
         "seconds": "seconds", "l2": "largest error of p", "p(2)": "error of p at 2",
         "energy": "energy", "angular-momentum": "angular momentum", "area": "area"}
DAM = {"code": "code", "variant": "settings", "n": "a/d", "step": "dt", "N": "N",
       "steps": "steps", "seconds": "seconds",
       **{f"Z({T})": f"Z({T})" for T in ("0.84", "1.19", "1.63", "1.98", "2.51", "2.83")},
       "rms experiment": "rms experiment", "delay": "delay", "rms delayed": "rms, delayed",
       "rms own finest": "rms own finest", "rms ours": "rms, our finest of that viscosity"}


# ---------------------------------------------------------------- rotating patch

def run_patch(setup, scratch):
    row = patch.run_own(setup, scratch)
    print("  " + common.result_line(case=row["case"], variant=row["variant"],
                                    quantity="p-deviation", time=2, linf=row["l2"],
                                    d=1 / row["n"], N=row["N"], seconds=row["seconds"], ranks=1),
          flush=True)
    return row


# ---------------------------------------------------------------- dam break

def series_name(row):
    return f"{row['code']} {row['variant']}"


def finest_of(rows, name):
    return max((r for r in rows if series_name(r) == name), key=lambda r: (r["n"], -r["step"]),
               default=None)


def add_errors(rows):
    for row in rows:
        ours = "aleisph viscous" if series_name(row) in ("rheo example", "aleisph viscous") \
            else "aleisph accurate"
        others = {"own finest": finest_of(rows, series_name(row)), "ours": finest_of(rows, ours)}
        row.update(dam_break.errors(row, {k: v for k, v in others.items() if v}))
        row.update(dam_break.fronts(row))


def run_dam(setup, scratch):
    row = dam_break.run(setup, scratch)
    print("  " + common.result_line(case="dam-break", code=setup.code, settings=setup.variant,
                                    quantity="front", time=1.98,
                                    value=dam_break.fronts(row)["Z(1.98)"], reference=2.33,
                                    d=dam_break.WIDTH / setup.n, N=row["N"],
                                    seconds=row["seconds"], ranks=1), flush=True)
    return row


# ---------------------------------------------------------------- report

def draw_fronts(curves):
    def draw(axes):
        T, Z = dam_break.experiment()
        axes.plot(T, Z, "k+", label="Martin & Moyce")
        for name in dict.fromkeys((row["series"], row["n"]) for row in curves):
            T, Z = np.array([(r["T"], r["Z"]) for r in curves if (r["series"], r["n"]) == name]).T
            axes.plot(T, Z, color=plot.STYLE[name[0]][0], linewidth=1,
                      label=f"{name[0]}, a/d = {name[1]:g}")
        axes.set(xlim=(0, dam_break.END), ylim=(1, 5), xlabel="T")
        axes.set_title("dam break, front Z over T", fontsize=10)
        axes.grid(True, color="0.85", linewidth=0.6)
        axes.legend(fontsize=7)
    return draw


def finest_curves(rows):
    """Front of the finest run of each series, in steps of 0.05."""
    times = np.arange(0, dam_break.END, 0.05)
    for name in dict.fromkeys(series_name(row) for row in rows):
        row = finest_of(rows, name)
        for T, Z in zip(times, np.interp(times, row["T"], row["Z"])):
            yield {"series": name, "n": row["n"], "T": T, "Z": Z}


def with_error(rows, key):
    return [{**row, "l2": row[key]} for row in rows if row.get(key)]


def stored(path, case=None):
    """Rows of an earlier report, of a case that is not run now."""
    if not path.exists():
        return []
    with open(path, encoding="ascii") as lines:
        rows = [{key: common.number_or_text(x) for key, x in row.items() if x}
                for row in csv.DictReader(lines)]
    return [row for row in rows if case is None or row["case"] == case]


def report(patches, dam, curves, out):
    rows = [{k: v for k, v in row.items() if k not in ("T", "Z")} for row in patches + dam]
    common.write_csv(out / "free_surface.csv", rows)
    common.write_csv(out / "free_surface_fronts.csv", curves)
    text = (f"Rotating patch, omega t = 0.1 to 2\n\n{common.markdown(patches, PATCH)}\n"
            f"Dam break, T = 0.41 to 3.33\n\n{common.markdown(dam, DAM)}")
    (out / "free_surface.md").write_text(text, encoding="ascii")
    panels = [("patch: error of the centre pressure (n = L/d)", patches),
              ("dam break: front, from the experiment (n = a/d)",
               with_error(dam, "rms experiment")),
              ("dam break: front, from each series' finest run",
               with_error(dam, "rms own finest"))]
    panels = [(title, rows) for title, rows in panels if rows]
    plot.figure(panels, out / "free_surface.png", "one process on one core per run",
                ylabel="error", last=draw_fronts(curves) if curves else None)
    return text


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=HERE / "results", help="folder of the report")
    parser.add_argument("--coarse", action="store_true", help="without the finest resolutions")
    parser.add_argument("--only", choices=("patch", "dam-break"),
                        help="this flow; what the report has of the other stays")
    return parser.parse_args()


def main():
    options = arguments()
    path, fronts = options.out / "free_surface.csv", options.out / "free_surface_fronts.csv"
    with tempfile.TemporaryDirectory(prefix="aleisph-bench-") as name:
        scratch = Path(name)
        if options.only == "dam-break":
            patches = stored(path, "square-patch")
        else:
            patches = [run_patch(setup, scratch / f"patch-{k}")
                       for k, setup in enumerate(patch.patch_runs(options.coarse))]
            report(patches, stored(path, "dam-break"), stored(fronts), options.out)
        if options.only == "patch":
            dam, curves = stored(path, "dam-break"), stored(fronts)
        else:
            dam = [run_dam(setup, scratch / f"dam-{k}")
                   for k, setup in enumerate(peers_dam_break.setups(options.coarse))]
            add_errors(dam)
            curves = list(finest_curves(dam))
    print(report(patches, dam, curves, options.out))


if __name__ == "__main__":
    main()
