#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""examples/dam-break/in.minimal leaves what it can to defaults, and gives the flow of in.dam-break."""

import re
import unittest

import numpy as np

from dumps import read_frames
from example import TOP, edit, empty_folder, run_lammps

FOLDER = TOP / "examples" / "dam-break"
D = 0.01            # spacing
EVERY = 0.02        # a frame [s]
END = 0.08          # T = 0.8: the front has run a third of the width of the column, 3 d a frame
WIDTH = 0.2

# Both: steps end on the times of the frames
FRAMES = (f"dump_modify frames every/time {EVERY} first yes sort id time yes format float %.12g\n"
          f"variable time equal time\n"
          f"fix end all halt 1 v_time >= {END - 1e-9} error continue message no\n")


def minimal():
    """The dump of in.minimal."""
    folder = empty_folder("minimal")
    text = (FOLDER / "in.minimal").read_text(encoding="ascii")
    (folder / "in.minimal").write_text(text, encoding="ascii")
    edit(folder / "in.minimal", {r"(dump +frames .*)": rf"\1\n{FRAMES}",
                                 r"(fix +dt all aleisph/dt 1)": rf"\1 align {EVERY}"})
    run_lammps("in.minimal", folder, {})
    return folder / "dump.minimal"


def whole():
    """That of in.dam-break, which ends at its first comparison with the experiment: later than END."""
    folder = empty_folder("whole")
    text = (FOLDER / "in.dam-break").read_text(encoding="ascii")
    text = text.replace("align ${goal}", f"align {EVERY}").replace("v_goal*(1.0-1.0e-9)", f"{END-1e-9}")
    text = re.sub(r"every/time \S+ first yes", f"every/time {EVERY} first yes", text)
    text = text.replace("next          T Z", "quit")
    (folder / "in.dam-break").write_text(text, encoding="ascii")
    run_lammps("in.dam-break", folder, {})
    return folder / "dump.dam-break"


class Minimal(unittest.TestCase):
    def test_is_short(self):
        lines = (FOLDER / "in.minimal").read_text(encoding="ascii").splitlines()
        self.assertLessEqual(len(lines), 30)

    def test_same_flow(self):
        frames = [read_frames(dump) for dump in (minimal(), whole())]
        self.assertEqual(*([frame.time for frame in f] for f in frames))
        self.assertAlmostEqual(frames[0][-1].time, END)
        for step, (a, b) in enumerate(zip(*frames)):
            np.testing.assert_array_equal(a["id"], b["id"])
            fluid = a["type"] == 1
            self.assertEqual(fluid.sum(), 800)
            way = np.hypot(a["x"] - b["x"], a["y"] - b["y"])[fluid]
            # At the start they are the same particles. in.dam-break sets up a first shift with a
            # tiny time step, in.minimal with the real one: there the limit of the shift acts, which
            # is 0.1 d and the most that they can differ by because of it. Other differences, those
            # of tolerance and velocity scale (0.3 %), are smaller.
            self.assertLess(way.max(), 0.1 * D if step else 1e-12)
            # The limit acts on a few particles of the surface only.
            self.assertLess(np.sqrt(np.mean(way**2)), 0.01 * D if step else 1e-12)
        front = [max(f[-1]["x"][f[-1]["type"] == 1]) for f in frames]
        self.assertAlmostEqual(front[0], front[1], delta=0.1 * D)
        self.assertGreater(front[0], 1.3 * WIDTH)      # it flows


if __name__ == "__main__":
    unittest.main(verbosity=2)
