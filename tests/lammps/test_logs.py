#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Logs of this package for programs that read logs: LAMMPS' own log2txt.py and lammps.formats. They
take every line between the head of the thermo output and "Loop time" for numbers, so that the
report after a run must stand elsewhere. And when it is printed: it obeys run ... post no, and
fix_modify report.
"""

import os
import re
import subprocess
import sys
import unittest
from pathlib import Path

import yaml
from lammps.formats import LogFile

SCENE = """
units         lj
dimension     2
atom_modify   sort 0 0.0
lattice       sq 1.0
region        box block 0 8 0 8 -0.5 0.5
create_box    1 box
create_atoms  1 box
mass          * 1.0
neighbor      0.3 bin
velocity      all set 0.1 0 0
fix           sph all aleisph spacing 1.0 rho0 1.0
fix           move all aleisph/predictor
fix           ppe all aleisph/ppe tol 1.0e-10
timestep      0.1
thermo_style  custom step time f_sph[1] f_ppe[1]
thermo        1
"""
TOOLS = Path(os.environ["LAMMPS_SOURCE_DIR"]) / "tools" / "python"
PARTS = ("time", "builds", "communication per step")


def log_of(*commands):
    Path("in.logs").write_text(SCENE + "\n".join(commands) + "\n", encoding="ascii")
    subprocess.run([os.environ["ALEISPH_LMP"], "-in", "in.logs", "-log", "log.logs", "-nocite",
                    "-screen", "none"], check=True)
    return Path("log.logs").read_text(encoding="ascii")


def reports(log):
    """(steps, last step) of each, in their order; each is whole."""
    found = re.findall(r"^ALEISPH time: \S+ s for (\d+) steps to step (\d+),", log, re.M)
    for part in PARTS:
        assert len(re.findall(f"^ALEISPH {part}", log, re.M)) == len(found), part
    return [tuple(map(int, pair)) for pair in found]


class Readers(unittest.TestCase):
    RUNS = ("run 3", "run 2")
    STEPS = [[0, 1, 2, 3], [3, 4, 5]]

    def test_log2txt(self):
        self.assertEqual(reports(log_of(*self.RUNS)), [(3, 3), (2, 5)])
        subprocess.run([sys.executable, "-W", "ignore", TOOLS / "log2txt.py", "log.logs", "table.txt"],
                       check=True, stdout=subprocess.DEVNULL,
                       env={**os.environ, "LAMMPS_PYTHON_TOOLS": str(TOOLS / "pizza")})
        rows = [line.split() for line in Path("table.txt").read_text().splitlines()]
        self.assertEqual([float(row[0]) for row in rows], [0, 1, 2, 3, 4, 5])
        self.assertEqual({row[2] for row in rows}, {"64.0"})

    def test_formats(self):
        for style in ("one", "multi", "yaml"):
            with self.subTest(style):
                # multi has the step in its head line, and that reader wants it there only
                columns = "custom time f_sph[1]" if style == "multi" else "custom step time f_sph[1]"
                log_of(f"thermo_style {columns}", f"thermo_modify line {style}", *self.RUNS)
                log = LogFile("log.logs")
                self.assertEqual([run["Step"] for run in log.runs], self.STEPS)
                self.assertEqual(log.errors, [])
                for run in log.runs:
                    if style != "multi":    # that reader knows no [ in a name
                        self.assertEqual(set(run["f_sph[1]"]), {64})

    def test_yaml_by_hand(self):    # as the manual of LAMMPS does it
        log = log_of("thermo_modify line yaml colname f_sph[1] particles", *self.RUNS)
        lines = re.findall(r"^(?:keywords:.*|data:|---|\.\.\.|  - \[.*\])$", log, re.M)
        runs = list(yaml.safe_load_all("\n".join(lines)))
        self.assertEqual([len(run["data"]) for run in runs], [4, 3])
        self.assertIn("particles", runs[0]["keywords"])


class Report(unittest.TestCase):
    def test_stands_behind_the_run(self):
        log = log_of("run 3", "print END")
        self.assertLess(log.index("Loop time"), log.index("ALEISPH time"))
        self.assertLess(log.index("ALEISPH time"), log.index("Total wall time"))

    def test_now(self):
        log = log_of("run 3", "fix_modify sph report now", "print END", "run 1")
        self.assertEqual(reports(log), [(3, 3), (1, 4)])
        self.assertLess(log.index("ALEISPH time"), log.index("END\nEND"))

    def test_post_no(self):
        self.assertEqual(reports(log_of("run 3 post no", "run 1")), [(1, 4)])
        self.assertEqual(reports(log_of("run 3", "run 1 pre no post no")), [(3, 3)])
        self.assertEqual(reports(log_of("variable p index no", "run 3 post ${p}")), [])

    def test_pre_no(self):    # each run has its own, and readers see runs of numbers
        self.assertEqual(reports(log_of("run 3", "run 1 pre no", "run 2")), [(3, 3), (1, 4), (2, 6)])
        self.assertEqual([run["Step"] for run in LogFile("log.logs").runs],
                         [[0, 1, 2, 3], [3, 4], [4, 5, 6]])

    def test_every(self):
        log = log_of('run 4 every 2 "print between"')
        self.assertEqual(reports(log), [(2, 2), (2, 4)])
        log = log_of('run 4 post no every 2 "print between"')
        self.assertEqual(reports(log), [])

    def test_switched_off(self):
        self.assertEqual(reports(log_of("fix_modify sph report no", "run 3")), [])
        self.assertEqual(reports(log_of("fix_modify sph report no", "run 3",
                                        "fix_modify sph report yes", "run 1")), [(1, 4)])


if __name__ == "__main__":
    unittest.main(verbosity=2)
