#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Every example, short and coarse, on one rank: its dump agrees with the stored one, its results
obey the bounds of cases.py. `test_examples.py --store [CASE...]` stores the dumps anew.
"""

import gzip
import sys
import unittest
from pathlib import Path

import dump_check
from cases import CASES
from example import HERE, TOP, empty_folder, run_case, run_lammps
from result_table import read_results


def reference(name):
    return HERE / "reference" / f"{name}.dump.gz"


def tolerances(name):
    return HERE / "tolerances" / f"{name}.txt"


class Examples(unittest.TestCase):
    longMessage = False

    def check_dump(self, name, dump):
        report, good = dump_check.compare(dump, reference(name), tolerances(name))
        print(f"{name}: {report}")
        self.assertTrue(good, f"{name}: {report}")

    def check_results(self, name, rows, bounds):
        last = {row["quantity"]: row for row in rows}    # later times come later
        for (quantity, key), bound in bounds.items():
            self.assertIn(quantity, last, f"{name} printed no result line for {quantity}")
            value = float(last[quantity][key])
            self.assertLessEqual(value, bound, f"{name}: {key} of {quantity} is {value}")

    def test_agree_with_stored_dumps_and_bounds(self):
        for name, case in CASES.items():
            with self.subTest(name):
                dump, rows = run_case(name, case)
                self.check_dump(name, dump)
                self.check_results(name, rows, case.bounds)

    def test_runs_from_another_folder(self):
        """The generator of the pipe is found by -var here, fluid properties by their path."""
        folder = empty_folder("elsewhere")
        for name, more in (("poiseuille", {"marks": 0.2}), ("closed-tank", {"steps": 1})):
            here = TOP / "examples" / name
            variables = {**CASES[name].variables, "here": here,
                         "fluid": TOP / "potentials" / "water.aleisph", **more}
            log = run_lammps(here / f"in.{name}", folder, variables)
            self.assertTrue(read_results(log), f"{name} printed no result line")

    def test_every_example_takes_part(self):
        there = {path.parent.name for path in (TOP / "examples").glob("*/in.*")}
        self.assertEqual(there, {case.example for case in CASES.values()})


def last_frame(path):
    """Text of the last snapshot of a dump."""
    text = Path(path).read_text(encoding="ascii")
    return text[text.rindex("ITEM: TIME\n"):]


def store(names):
    for name in names or CASES:
        dump, _ = run_case(name, CASES[name])
        # no name and no time of day in the file: the same dump gives the same file
        with open(reference(name), "wb") as out, gzip.GzipFile("", "wb", 9, out, 0) as packed:
            packed.write(last_frame(dump).encode("ascii"))
        print(f"{reference(name)}: {reference(name).stat().st_size} bytes")


if __name__ == "__main__":
    if sys.argv[1:2] == ["--store"]:
        store(sys.argv[2:])
    else:
        unittest.main(verbosity=2)
