#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Shows the ALEISPH-RESULT lines of LAMMPS logs as a table: result_table.py LOG...

A line is `ALEISPH-RESULT key=value key=value ...`; read_results() returns them for other tools.
"""

import sys

MARK = "ALEISPH-RESULT"
HEADINGS = {"l2": "L2 error", "linf": "Linf error", "N": "particles", "time": "time",
            "d": "spacing", "seconds": "seconds"}


def read_results(path):
    """The result lines of a log, in order, each as a dict of strings. One that the end of the file
    cuts may lack digits: it is left out, and stderr says so."""
    with open(path, errors="replace") as log:
        lines = [line for line in log if line.startswith(MARK)]
    if lines and not lines[-1].endswith("\n"):
        print(f"{path}: the last result line is cut and is left out", file=sys.stderr)
        lines.pop()
    rows = [line.split()[1:] for line in lines]
    return [dict(item.split("=", 1) for item in row if "=" in item) for row in rows]


def short(text):
    """A number with four digits, anything else as it is."""
    try:
        return text if text.lstrip("-").isdigit() else f"{float(text):.4g}"
    except ValueError:
        return text


def table(rows):
    """Lines of a table with the columns that occur, in the order in which they occur."""
    keys = list(dict.fromkeys(key for row in rows for key in row))
    cells = [[HEADINGS.get(key, key) for key in keys]]
    cells += [[short(row.get(key, "")) for key in keys] for row in rows]
    widths = [max(len(row[k]) for row in cells) for k in range(len(keys))]
    lines = ["  ".join(cell.rjust(width) for cell, width in zip(row, widths)) for row in cells]
    lines.insert(1, "  ".join("-" * width for width in widths))
    return lines


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    rows = [row for path in sys.argv[1:] for row in read_results(path)]
    if not rows:
        sys.exit(f"no {MARK} line in {' '.join(sys.argv[1:])}")
    print("\n".join(table(rows)))


if __name__ == "__main__":
    main()
