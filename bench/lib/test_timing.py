#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""The parser of the timing that the styles print."""

import tempfile
import unittest
from pathlib import Path

import common
import timing

LOG = """
Loop time of 9 on 1 procs for 9 steps with 50 atoms
50.0% CPU use with 1 MPI tasks

ALEISPH time: 9 s for 9 steps to step 9, 9 us per particle-step and rank
  stencil                 9 s  100.0 %
ALEISPH builds: stencil 1, gradient 1
Loop time of 0.75 on 2 procs for 100 steps with 50 atoms
80.0% CPU use with 2 MPI tasks

ALEISPH time: 0.5 s for 100 steps to step 109, 100 us per particle-step and rank
  stencil            0.1250 s   25.0 %
ALEISPH communication per step: 12 messages, 3.4 kB
  solve               0.375 s   75.0 % (waiting 0.1 s)
ALEISPH builds: stencil 1, gradient 1
Total wall time: 0:00:10
"""


class Timing(unittest.TestCase):
    def test_parts_of_the_last_run(self):
        parts, atoms, steps = timing.by_part(LOG)
        self.assertEqual((atoms, steps), (50, 100))
        # 5000 particle-steps: 0.125 s are 25 us each
        self.assertEqual(list(parts), ["stencil", "solve", "other", "total"])
        for part, value in zip(parts, (25, 75, 50, 150)):
            self.assertAlmostEqual(parts[part], value)

    def test_a_log_without_parts_is_an_error(self):
        with self.assertRaises(RuntimeError):
            timing.by_part("Loop time of 1 on 1 procs for 1 steps with 1 atoms\nALEISPH time: 1 s")

    def test_share_of_the_core_is_that_of_the_last_run(self):
        self.assertAlmostEqual(common.cpu_share(timing.last_run(LOG)), 0.8)

    def test_peak_memory_of_the_program(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            self.assertIsNone(timing.peak_bytes(folder))
            (folder / "peak-memory").write_text("", encoding="ascii")
            self.assertIsNone(timing.peak_bytes(folder))
            (folder / "peak-memory").write_text("VmHWM:\t   100 kB\n", encoding="ascii")
            self.assertEqual(timing.peak_bytes(folder), 102400)

    def test_bytes_per_particle_are_those_of_the_growth(self):
        # 5 MB of program and 1000 bytes per particle, in any order
        N = [2000, 1000, 10000]
        self.assertAlmostEqual(timing.per_particle(N, [5e6 + 1e3 * n for n in N]), 1000)

    def test_slope(self):
        self.assertAlmostEqual(timing.slope([1e3, 1e4, 1e5], [2.0, 20.0, 200.0]), 1.0)
        self.assertAlmostEqual(timing.slope([1e3, 1e5], [1.0, 10.0]), 0.5)

    def test_bandwidth_is_that_of_a_memory(self):
        self.assertTrue(1e8 < timing.bandwidth(length=1_000_000, repeats=3) < 1e12)


if __name__ == "__main__":
    unittest.main()
