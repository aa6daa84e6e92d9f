#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""What the pages show works, taken from them as it stands there: the two further scripts of the
Howto (for a few steps), its dumps for pictures, OVITO and ParaView and the two ways to give a closed
domain a level of pressure (fix aleisph/pressure), added to doc/in.channel, and the Python program.
"""

import os
import re
import subprocess
import sys
import tempfile
import textwrap
import unittest
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
DOC = TOP / "doc"
PLUGIN = Path(os.environ.get("LAMMPS_PLUGIN_PATH", "")) / "aleisphplugin.so"
PNG = b"\x89PNG\r\n\x1a\n"


def blocks(language, text):
    found = re.findall(rf"^\.\. code-block:: {language}\n\n((?:   .*\n|\n)+)", text, re.M)
    return [textwrap.dedent(block) for block in found]


def section(label):
    """From a label of the page to the next one."""
    return re.split(r"^\.\. _", (DOC / "Howto_aleisph.rst").read_text().split(
        f".. _{label}:\n")[1], maxsplit=1, flags=re.M)[0]


def output(command, folder):
    run = subprocess.run(command, cwd=folder, text=True, check=False, stdout=subprocess.PIPE,
                         stderr=subprocess.STDOUT)
    if run.returncode != 0:
        raise AssertionError(f"{' '.join(command)} failed:\n{run.stdout[-2000:]}")
    return run.stdout


def lmp(script, folder, *arguments):
    (Path(folder) / "in.test").write_text(script)
    return output([os.environ["ALEISPH_LMP"], "-in", "in.test", "-log", "none", *arguments], folder)


class Howto(unittest.TestCase):
    def test_scripts(self):
        scripts = [block for block in blocks("LAMMPS", (DOC / "Howto_aleisph.rst").read_text())
                   if "create_box" in block]
        self.assertEqual(len(scripts), 2)    # a free surface, a drop
        for script in scripts:
            short, count = re.subn(r"^run .*$", "run 5", script, flags=re.M)
            self.assertEqual(count, 1)
            with tempfile.TemporaryDirectory() as name:
                self.assertIn("for 5 steps", lmp(short, name))

    def test_level_of_pressure(self):
        text = (DOC / "fix_aleisph_pressure.rst").read_text()
        afterwards, prescribed = [block for block in blocks("LAMMPS", text)
                                  if block.startswith("group ")]
        # a force across the channel, too: the pressure on the wall is not the mean
        channel = (DOC / "in.channel").read_text().replace("vector 1 0 0", "vector 1 -1 0")
        dump = "dump p all custom 1 p.dump id {}\ndump_modify p sort id\n"
        for script, column in (
                (channel.replace("run           ", afterwards + dump.format("v_p_rel") + "run "),
                 "v_p_rel"),
                (channel.replace("fix           move", prescribed + "fix move").replace(
                    "run           ", dump.format("d_aleisph_p") + "run "), "d_aleisph_p")):
            with tempfile.TemporaryDirectory() as name:
                lmp(script, name, "-var", "n", "10", "-var", "T", "0.01")
                lines = (Path(name) / "p.dump").read_text().splitlines()
            pressure = [float(line.split()[1]) for line in lines[-110:]]    # 11 x 10 particles
            # LAMMPS hands variables on with 15 digits; rho0 G H = 1e-3, the force is at 45 degrees
            self.assertLess(abs(pressure[0]), 1.0e-17, column)
            self.assertAlmostEqual(min(pressure), -1.0e-3 / 2**0.5, delta=1.0e-9, msg=column)

    def test_dumps(self):
        recipes = blocks("LAMMPS", section("howto_pictures"))
        self.assertEqual(len(recipes), 3)
        script = (DOC / "in.channel").read_text().replace(
            "run           ", "\n".join(recipes) + "\nrun           ")
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            lmp(script, folder, "-var", "n", "10")
            pictures = sorted(folder.glob("flow.*.png"))
            tables = sorted(folder.glob("flow.*.csv"))
            self.assertGreaterEqual(len(pictures), 2)
            self.assertEqual(pictures[-1].read_bytes()[:8], PNG)
            self.assertEqual(len(tables), len(pictures))
            rows = [line.split(",") for line in tables[-1].read_text().splitlines()]
            self.assertEqual([int(row[0]) for row in rows], list(range(1, 111)))    # 11 x 10
            self.assertEqual({len(row) for row in rows}, {9})
            self.assertIn("ITEM: ATOMS id type x y z vx vy vz radius pressure\n",
                          (folder / "flow.dump").read_text())

    def test_python(self):
        programs = blocks("python", section("howto_python"))
        self.assertEqual(len(programs), 1)
        with tempfile.TemporaryDirectory() as name:
            (Path(name) / "doc").symlink_to(DOC)
            (Path(name) / "flow.py").write_text(programs[0])
            out = output([sys.executable, "flow.py"], name)
        # 2.90e-4 with n = 20, of second order; reproducible to rounding, as in test_channel.py
        error = float(re.search(r"^error (\S+)$", out, re.M)[1])
        self.assertAlmostEqual(error, 7.616e-5, delta=5e-3 * 7.616e-5)


if __name__ == "__main__":
    if not PLUGIN.exists():
        print("not run: this build has no plugin")
        sys.exit(0)
    unittest.main(verbosity=2)
