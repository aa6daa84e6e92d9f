#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Error against run time with surface tension: Laplace pressure of a cube that became a sphere.

The example laplace with L/d = 10, 14 and 20; time step half of the capillary limit, and a quarter;
model tangent, and everything as published; at the finest spacing only model tangent and the larger
step. Every run is one process on one core.
Writes tension.csv, tension.md and tension.png.
"""

import argparse
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "lib"))

import common  # noqa: E402  (found in bench/lib)
import drops  # noqa: E402
import peers_laplace  # noqa: E402
import plot  # noqa: E402

HERE = Path(__file__).resolve().parent
COLUMNS = {"variant": "variant", "n": "L/d", "step": "dt", "N": "N", "steps": "steps",
           "seconds": "seconds", "l2": "error of p", "velocity": "largest velocity",
           "sphericity": "radius off by [d]", "volume": "volume", "verdict": "failure"}


def run(setup, scratch):
    row = drops.run(setup, scratch, sys.executable)
    print("  " + common.result_line(case="laplace", variant=setup.variant, quantity="p", time=3,
                                    d=drops.SIDE / setup.n, step=setup.step,
                                    **{key: row[key] for key in ("l2", "N", "seconds")
                                       if key in row}, ranks=1), flush=True)
    return row


def report(rows, out):
    common.write_csv(out / "tension.csv", rows)
    text = ("Laplace pressure at t = 3 sqrt(rho R^3/sigma), sigma = 0.007, L = 2 mm, nu = 9.3e-6\n\n"
            + common.markdown(rows, COLUMNS))
    (out / "tension.md").write_text(text, encoding="ascii")
    done = [row for row in rows if "l2" in row]
    panels = [("error of the mean pressure (n = L/d)", done),
              ("error of the volume inside the outline", as_error(done, "volume", 1)),
              ("largest velocity over sqrt(sigma/(rho R))", as_error(done, "velocity", 0))]
    if done:
        plot.figure(panels, out / "tension.png", "one process on one core per run",
                    ylabel="relative error")
    return text


def as_error(rows, key, exact):
    return [{**row, "l2": abs(row[key] - exact)} for row in rows]


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=HERE / "results", help="folder of the report")
    parser.add_argument("--coarse", action="store_true", help="without the finest resolution")
    return parser.parse_args()


def main():
    options = arguments()
    rows = []
    with tempfile.TemporaryDirectory(prefix="aleisph-bench-") as name:
        for k, setup in enumerate(peers_laplace.setups(options.coarse)):
            rows.append(run(setup, Path(name) / str(k)))
            text = report(rows, options.out)
    print(text)


if __name__ == "__main__":
    main()
