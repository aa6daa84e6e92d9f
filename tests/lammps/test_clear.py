#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""After a command clear a script starts anew: nothing that the fixes of the one before have set in
LAMMPS or in the particles is left."""

import os
import subprocess
import unittest
from pathlib import Path

SCENE = """
units         lj
dimension     2
lattice       sq 1.0
region        box block 0 8 0 8 -0.5 0.5
create_box    1 box
create_atoms  1 box
displace_atoms all random 0.1 0.1 0 3 units box
fix           sph all aleisph spacing 1.0 rho0 1.0 h/d {h}
fix           move all aleisph/predictor frame ale nu 0.1
fix           ppe all aleisph/ppe tol 1.0e-10
fix           shift all aleisph/shift density velocity 1.0
timestep      0.05
run           5
info          comm
write_dump    all custom {out} id x y vx vy d_aleisph_p modify sort id format float %.17g
"""


def run(*scenes):
    Path("in.clear").write_text("clear\n".join(scenes), encoding="ascii")
    subprocess.run([os.environ["ALEISPH_LMP"], "-in", "in.clear", "-log", "log.clear", "-nocite",
                    "-screen", "none"], check=True)
    return Path("log.clear").read_text(encoding="ascii")


class Clear(unittest.TestCase):
    def test_begins_anew(self):
        other = SCENE.format(h=1.6, out="other.dump")
        once = run(SCENE.format(h=1.2, out="once.dump"))
        twice = run(other, SCENE.format(h=1.2, out="twice.dump"))
        self.assertEqual(Path("once.dump").read_text(encoding="ascii"),
                         Path("twice.dump").read_text(encoding="ascii"))
        cutoff = [line for line in once.splitlines() if "ghost atom cutoff" in line]
        self.assertEqual([line for line in twice.splitlines() if "ghost atom cutoff" in line][-1:],
                         cutoff[-1:])


if __name__ == "__main__":
    unittest.main()
