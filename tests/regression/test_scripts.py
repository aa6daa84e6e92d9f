#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""The scripts of the examples where things go wrong, and their columns: without Python, with a fluid
that has left the place where it is measured, and with names in YAML output.
"""

import json
import re
import unittest

from cases import CASES
from example import TOP, empty_folder, run_case, run_lammps
from result_table import read_results

NO_PYTHON = {"python": "/no/such/python3"}
SCRIPTS = sorted((TOP / "examples").glob("*/in.*"))


class WithoutPython(unittest.TestCase):
    def run_short(self, name, good, **variables):
        """(log, its result lines)"""
        case = CASES[name]
        here = TOP / "examples" / case.example
        log = run_lammps(here / f"in.{case.example}", empty_folder(f"{name}-no-python"),
                         {**case.variables, **NO_PYTHON, "here": here, **variables}, good=good)
        return log.read_text(), [row["quantity"] for row in read_results(log)]

    def test_particles_that_cannot_be_made(self):
        """The run ends, and says what wrote nothing and what it needs."""
        for name, tool in (("poiseuille", "pipe.py wrote no pipe.data"),
                           ("dam-break-obstacle", "tank.py wrote no tank.data"),
                           ("capillary-ellipse", "drop.py wrote no drop.data")):
            log, rows = self.run_short(name, good=False)
            self.assertRegex(log, f"(?m)^ERROR: {tool}.*it needs /no/such/python3 .Python 3")
            self.assertNotIn("Cannot open file", log)
            self.assertEqual(rows, [])

    def test_measurements_made_before_are_kept(self):
        for name, tool, kept in (("sloshing", "sloshing.py", ["penetration"]),
                                 ("laplace", "drops.py", ["p", "velocity"]),
                                 ("sessile-drop", "caps.py", ["speed"])):
            log, rows = self.run_short(name, good=True, T=0.1, frames=1, tend=0.05)
            self.assertRegex(log, f"(?m)^WARNING: {tool} wrote no .*it needs /no/such/python3 .Python 3")
            self.assertEqual(rows, kept)

    def test_the_loop_of_the_patch_goes_on(self):
        log, rows = self.run_short("square-patch", good=True, T=1)
        self.assertEqual(rows.count("energy"), 2)
        self.assertNotIn("area", rows)
        self.assertEqual(len(re.findall("^WARNING: square_patch.py", log, re.M)), 2)

    def test_every_script_looks_before_it_includes(self):
        """What Python has to write is looked for, with a word about Python if it is not there."""
        for path in SCRIPTS:
            text = path.read_text()
            commands = re.sub(r"&\n", "", re.sub(r"(?m)^#.*", "", text))
            runs = len(re.findall(r"\$\{python\} \$\{here\}", commands))
            self.assertEqual(runs, len(re.findall("it needs \\$\\{python\\}", commands)), path.name)
            self.assertNotRegex(commands, r"(?m)^include\s", path.name)


class FlownApart(unittest.TestCase):
    """The fluid is elsewhere from the start: no particle is where the pressure is measured. All of
    the run's results are there."""

    def test_results_are_complete(self):
        for name, distance in (("capillary", "1"), ("cube-drop", "1"), ("laplace", "1"),
                               ("square-patch", "9")):
            with self.subTest(name):
                far = {"(fix +sph .*)": f"reset_atoms id sort yes\ndisplace_atoms all move {distance} "
                                        r"0 0 units box\n\1"}
                whole = {row["quantity"] for row in run_case(name, CASES[name], "near")[1]}
                found = {row["quantity"] for row in run_case(name, CASES[name], "far",
                                                             changes=far)[1]}
                self.assertEqual(found, whole)


class Columns(unittest.TestCase):
    def test_every_numbered_output_has_a_name(self):
        for path in SCRIPTS:
            text = path.read_text().replace("&\n", "")
            style = re.search(r"^thermo_style +custom (.*)$", text, re.M)
            if not style:    # LAMMPS' own columns
                continue
            style = style[1].split()
            names = dict(re.findall(r"colname (\S+) (\S+)", re.search(
                r"^thermo_modify (.*)$", text, re.M)[1]))
            numbered = [word for word in style if re.match(r"[fc]_\w+\[", word)]
            self.assertEqual(sorted(numbered), sorted(word for word in names if "[" in word),
                             path.name)
            columns = [names.get(word, word) for word in style]
            self.assertEqual(len(set(columns)), len(columns), path.name)

    def test_in_yaml(self):
        for name in ("poiseuille-plane", "tank"):
            changes = {"(thermo_modify .*)": r"thermo_modify line yaml\n\1"}
            case = CASES[name]
            dump, _ = run_case(name, case, "yaml", changes=changes)
            log = (dump.parent / "log.lammps").read_text()
            head = re.findall(r"^keywords: \[(.*), \]$", log, re.M)[-1].replace("'", '"')
            keywords = json.loads(f"[{head}]")
            rows = [json.loads(f"[{line}]")
                    for line in re.findall(r"^  - \[([^\]]*), \]$", log, re.M)]
            self.assertTrue(rows)
            self.assertEqual({len(row) for row in rows}, {len(keywords)})
            values = dict(zip(keywords, zip(*rows)))
            self.assertGreater(max(values["iterations"]), 0)
            self.assertLess(max(values["residual"][1:]), 1e-11)    # the cases ask for 1e-12


if __name__ == "__main__":
    unittest.main(verbosity=2)
