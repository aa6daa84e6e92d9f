#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Loops of the linear solver as a share of the memory bandwidth measured in the same run.

Builds and runs bench/lib/bandwidth.cpp, on one core, or on several at once (--cores): then each
value is the mean per core. The bandwidth is the larger of that of STREAM's triad and of a sum.
Writes bandwidth.csv and bandwidth.md and prints ALEISPH-RESULT lines.
"""

import argparse
import os
import subprocess
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "lib"))

import common  # noqa: E402  (found in bench/lib)

HERE = Path(__file__).resolve().parent
REFERENCES = ("triad", "sum")
COLUMNS = {"kernel": "kernel", "dimension": "dimension", "rows": "rows",
           "entries per row": "entries per row", "gigabytes per second": "GB/s",
           "fraction": "of bandwidth"}


def build():
    """Path of the program, built where the plugin was."""
    folder = os.environ.get("LAMMPS_PLUGIN_PATH") or sys.exit(
        "no LAMMPS_PLUGIN_PATH: use ./aleisph bench bandwidth, or --program")
    root = Path(folder).parent
    subprocess.run(["cmake", "--build", root, "--target", "aleisph_bandwidth"], check=True,
                   stdout=subprocess.DEVNULL)
    return root / "bench/aleisph_bandwidth"


def run(program, share, cores):
    """Rows of the table, mean of programs that run at the same time."""
    started = [subprocess.Popen([program, str(share)], stdout=subprocess.PIPE, text=True)
               for _ in range(cores)]
    texts = [process.communicate()[0] for process in started]
    if any(process.returncode for process in started):
        sys.exit(f"{program} ended with an error")
    return mean([parse(text) for text in texts])


def parse(text):
    rows = []
    for line in text.splitlines():
        kernel, dimension, count, entries, speed = line.split()
        rows.append({"kernel": kernel, "dimension": int(dimension), "rows": int(count),
                     "entries per row": float(entries) / int(count),
                     "gigabytes per second": float(speed)})
    return rows


def mean(tables):
    rows = [dict(row) for row in tables[0]]
    for k, row in enumerate(rows):
        speeds = [table[k]["gigabytes per second"] for table in tables]
        row["gigabytes per second"] = sum(speeds) / len(speeds)
    return rows


def add_fractions(rows):
    limit = max(row["gigabytes per second"] for row in rows if row["kernel"] in REFERENCES)
    for row in rows:
        row["fraction"] = row["gigabytes per second"] / limit
    return rows


def result_lines(rows, cores):
    for row in rows:
        # the dimension belongs to the matrices only
        where = {"kernel": row["kernel"], "N": row["rows"], "cores": cores,
                 "dim": row["dimension"] if row["entries per row"] else None}
        yield common.result_line(**where, quantity="gigabytes-per-second",
                                 value=row["gigabytes per second"])
        yield common.result_line(**where, quantity="fraction-of-bandwidth", value=row["fraction"])


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--out", type=Path, default=HERE / "results",
                        help="folder of what is written")
    parser.add_argument("--program", type=lambda name: Path(name).resolve(),
                        help="a program built before")
    parser.add_argument("--share", type=float, default=1.0,
                        help="of the usual sizes; below 0.3 caches begin to count")
    parser.add_argument("--cores", type=int, default=1, help="programs at the same time")
    options = parser.parse_args()
    rows = add_fractions(run(options.program or build(), options.share, options.cores))
    for line in result_lines(rows, options.cores):
        print(line)
    common.write_csv(options.out / "bandwidth.csv", rows)
    text = common.markdown(rows, COLUMNS, digits=3)
    (options.out / "bandwidth.md").write_text(text, encoding="ascii")
    print(text)


if __name__ == "__main__":
    main()
