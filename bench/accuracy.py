#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Error against run time over time steps and tolerances: channel, pipe, Taylor-Green vortices.

The pipe and the vortices are the examples `poiseuille` and `taylor-green`, each over resolutions,
two time steps and two solver tolerances; on the channel there are all of our series, RHEO and SPH.
Writes accuracy.csv, accuracy.md, accuracy.png, channel.csv, channel-ratios.csv and
channel-summary.csv. `peers` has the page with all peers.
"""

import argparse
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "lib"))

import channel  # noqa: E402  (found in bench/lib)
import channel_report  # noqa: E402
import common  # noqa: E402
import flows  # noqa: E402
import peers_channel  # noqa: E402
import plot  # noqa: E402

DEFAULT_OUT = Path(__file__).resolve().parent / "results"
PANELS = {("poiseuille", 0.05): "pipe, start-up, nu t/R^2 = 0.2 (n = 2R/d)",
          ("poiseuille", 0.5): "pipe, steady, nu t/R^2 = 2 (n = 2R/d)",
          ("taylor-green", 0.25): "Taylor-Green, Re = 100, t U/L = 0.25 (n = L/d)",
          ("taylor-green", 1.0): "Taylor-Green, Re = 100, t U/L = 1 (n = L/d)"}
COLUMNS = {"case": "case", "variant": "settings", "n": "n", "N": "N", "dt": "dt",
           "nu dt/d^2": "nu dt/d^2", "tol": "tol", "time": "time", "seconds": "seconds",
           "l2": "L2"}


def run_examples(scratch):
    table = []
    for index, run in enumerate([*flows.pipe_runs(), *flows.vortex_runs()]):
        rows = flows.run_example(run, scratch / f"example-{index}")
        table += rows
        for row in rows:
            print("  " + common.result_line(**{key: row[key] for key in (
                "case", "time", "l2", "linf", "d", "N", "dt", "seconds", "ranks", "tol")}),
                  flush=True)
    return table


def run_channel(long, scratch):
    print("Plane channel, one core per run", flush=True)
    table = []
    setups = [*peers_channel.own_setups(), *peers_channel.peer_setups(long)]
    for index, setup in enumerate(setups):
        rows = peers_channel.measure(setup, scratch / f"channel-{index}")
        table += rows
        errors = " ".join(f"{row['l2']:.2e}" for row in rows)
        print(f"  {setup.code:8s} {setup.variant:16s} n={setup.n:<3d} "
              f"{rows[-1]['seconds']:8.2f} s  L2 = {errors}", flush=True)
    return table


def panels(table):
    for time in channel.TIMES:
        yield (f"plane channel, nu t/H^2 = {time:g} (n = 2H/d)",
               flows.at(table, "plane-channel", time))
    for (case, time), title in PANELS.items():
        yield title, flows.at(table, case, time)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=DEFAULT_OUT, help="folder of what is written")
    parser.add_argument("--long", action="store_true",
                        help="RHEO's example at n = 60, too (10 min more)")
    return parser.parse_args()


def main():
    options = arguments()
    with tempfile.TemporaryDirectory(prefix="aleisph-bench-") as scratch:
        own = run_examples(Path(scratch))
        table = run_channel(options.long, Path(scratch))
    compared = channel_report.ratios(table)
    text = channel_report.write(table, compared, options.out)
    common.write_csv(options.out / "accuracy.csv", table + own)
    text += "\n" + common.markdown(own, COLUMNS)
    (options.out / "accuracy.md").write_text(text, encoding="ascii")
    plot.figure(list(panels(table + own)), options.out / "accuracy.png",
                "one process on one core per run; peers with their best-fitting wall position")
    print(text)
    for line in channel_report.verdicts(compared):
        print(line)


if __name__ == "__main__":
    main()
