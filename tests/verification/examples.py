# SPDX-License-Identifier: GPL-2.0-only
"""Runs an example to its end and reads its result lines."""

import os
import shutil
import subprocess
from pathlib import Path

from result_table import read_results

TOP = Path(os.environ["ALEISPH_SOURCE_DIR"])


def words_of(value):
    """The words of an index variable: a string is split, the words of a list are kept whole."""
    return list(value) if isinstance(value, list) else str(value).split()


def rows(example, **variables):
    """Its result lines."""
    name = "-".join([example] + [k + "_".join(words_of(v)) for k, v in variables.items()])
    name = name.replace(" ", "_")
    folder = Path(name)
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(TOP / "examples" / example, folder,
                    ignore=shutil.ignore_patterns("log.*", "*.png", "README*"))
    words = [os.environ["ALEISPH_LMP"], "-in", f"in.{example}", "-log", "log.lammps", "-nocite",
             "-var", "here", str(TOP / "examples" / example)]
    for key, value in variables.items():
        words += ["-var", key] + words_of(value)
    done = subprocess.run(words, cwd=folder, text=True, check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode:
        raise RuntimeError(f"{' '.join(words)}: {done.stdout[-2000:]}")
    return read_results(folder / "log.lammps")


def results(example, quantity="u", **variables):
    """{time: row of numbers} of one quantity; seconds is removed, it is no result."""
    table = {}
    for row in rows(example, **variables):
        if row["quantity"] != quantity:
            continue
        print(" ".join(f"{key}={value}" for key, value in row.items() if key != "seconds"))
        table[round(float(row["time"]), 9)] = {
            key: float(row[key]) for key in ("l2", "linf", "dt", "d") if key in row}
    return table


def last(example, **variables):
    """{quantity: its last row} of one run."""
    table = {row["quantity"]: row for row in rows(example, **variables)}
    for row in table.values():
        print(" ".join(f"{key}={value}" for key, value in row.items() if key != "seconds"))
    return table
