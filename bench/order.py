#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Orders in space, and in time at fixed spacing, of six flows in every frame.

Taylor-Green vortices, a Stokes mode between walls, the cavity with a smooth lid, an array of
cylinders, a standing wave, the rotating patch. --full: one more resolution, half an hour.
Writes order.csv, order-space.csv, order-time.csv, order.md and order.png.
"""

import argparse
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent / "lib"))

import common  # noqa: E402  (found in bench/lib)
import order_cases  # noqa: E402
import order_report  # noqa: E402
import orders  # noqa: E402

DEFAULT_OUT = Path(__file__).resolve().parent / "results"


def measure(series, folder):
    rows = orders.measure(series, folder)
    for row in rows:
        print("  " + common.result_line(
            case=series.case, what=series.what.replace(" ", "_") or None, frame=series.frame,
            series=series.kind, quantity=row["quantity"], n=row["n"], dt=row["dt"],
            error=row.get("error"), difference=row.get("difference"),
            order=row.get("order") or None, seconds=row["seconds"]), flush=True)
    return rows


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--out", type=Path, default=DEFAULT_OUT, help="folder of what is written")
    parser.add_argument("--full", action="store_true", help="one more resolution of each flow")
    parser.add_argument("--only", action="append", choices=list(order_cases.CASES), default=[],
                        metavar="FLOW", help="this flow; can be repeated")
    return parser.parse_args()


def main():
    options = arguments()
    rows = []
    with tempfile.TemporaryDirectory(prefix="aleisph-bench-") as scratch:
        for k, series in enumerate(order_cases.all_series(options.only, options.full)):
            rows += measure(series, Path(scratch) / str(k))
    print(order_report.write(rows, options.out))


if __name__ == "__main__":
    main()
