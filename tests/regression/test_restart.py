#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""A run that is continued from a restart file written half-way ends, to the last bit, like the one
that was not interrupted, on one rank. Two ways to write the file: by `restart N` during one run of
2N steps, and by `write_restart` between two runs of N.

LAMMPS sorts the particles when a run starts, and then every so many steps: the order in which
numbers are added. fix aleisph has them sorted in the step in which a file is written, too.
"""

import itertools
import re
import unittest

from dumps import read_frames
from example import HERE, empty_folder, run_lammps

# steps of one half: for `shear`, enough to rebuild the neighbor lists several times
STEPS = {"channel": 20, "shear": 60, "dam": 60}
# every so many steps, size of the bins: never, often, once in a run
SORTS = ("0 0.0", "7 2.4", "1000 2.0")
FORMS = ("restart", "write_restart")


def run(scene, form, part, folder, sort=SORTS[0]):
    """Text of the log and path of the dump."""
    log = run_lammps(HERE / "in.restart", folder, {"scene": scene, "form": form, "part": part,
                                                   "steps": STEPS[scene], "here": HERE,
                                                   "sort": sort.split()[0], "bin": sort.split()[1]})
    return log.read_text(), folder / f"dump.{part}"


class Restart(unittest.TestCase):
    longMessage = False

    def test_continues_to_the_last_bit(self):
        for scene in STEPS:
            for form, sort in itertools.product(FORMS, SORTS):
                with self.subTest(scene, form=form, sort=sort):
                    folder = empty_folder(f"{scene}-{form}-{sort.split()[0]}")
                    whole = run(scene, form, "all", folder, sort)[1].read_text()
                    rest = run(scene, form, "rest", folder, sort)[1].read_text()
                    self.assertEqual(rest, whole,
                                     f"{scene}, {form}, sort {sort}: the continued run differs")

    def test_the_scene_is_worth_it(self):
        """Lists are rebuilt in both halves, the particles move, there is pressure."""
        log, dump = run("shear", "write_restart", "all", empty_folder("shear-check"))
        builds = [int(n) for n in re.findall(r"Neighbor list builds = (\d+)", log)]
        self.assertEqual(len(builds), 2)
        self.assertGreater(min(builds), 3, f"neighbor lists were built {builds} times")
        frame = read_frames(dump)[-1]
        self.assertGreater(abs(frame["vx"][frame["type"] == 1]).max(), 0.5)
        self.assertGreater(abs(frame["d_aleisph_p"]).max(), 0.1)


if __name__ == "__main__":
    unittest.main(verbosity=2)
