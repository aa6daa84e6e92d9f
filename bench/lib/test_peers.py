#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""The driver of peers: turns, repeated short runs, flows that fit together."""

import sys
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[1]))

import peers  # noqa: E402  (found in bench)


class Flow:
    """Runs that take the given seconds, with half of the core."""

    def __init__(self, *seconds):
        self.seconds = list(seconds)

    def run(self, setup, folder):
        seconds = self.seconds.pop(0)
        return [{"seconds": seconds / 10, "cpu share": 0.5}, {"seconds": seconds, "cpu share": 0.5}]


class Driver(unittest.TestCase):
    def test_codes_take_turns(self):
        self.assertEqual(peers.alternate("ab", "123"), ["a", "1", "b", "2", "3"])

    def test_the_median_of_short_runs_counts(self):
        rows = peers.repeated(Flow(0.1, 0.5, 0.2, 0.3, 0.4), None, None)
        self.assertAlmostEqual(rows[1]["seconds"], 0.3)
        self.assertAlmostEqual(rows[0]["seconds"], 0.03)

    def test_over_milliseconds_it_is_that_of_the_wall_clock(self):
        rows = peers.repeated(Flow(0.01, 0.05, 0.02, 0.03, 0.02), None, None)
        self.assertAlmostEqual(rows[1]["seconds"], 0.04)

    def test_long_and_failed_runs_are_not_repeated(self):
        self.assertEqual(peers.repeated(Flow(3.0), None, None)[1]["seconds"], 3.0)
        flow = Flow()
        flow.run = lambda setup, folder: [{"failure": "lost atoms"}]
        self.assertEqual(peers.repeated(flow, None, None), [{"failure": "lost atoms"}])

    def test_every_flow_has_runs_of_ours_that_are_compared(self):
        for flow in peers.FLOWS:
            for quick in (True, False):
                ours, others = flow.runs(quick)
                self.assertTrue(set(flow.COMPARED) <= {setup.variant for setup in ours},
                                flow.NAME)
                self.assertTrue(others)
            self.assertEqual(len(set(flow.COMPARED.values())), len(flow.COMPARED))
            self.assertTrue(set(flow.COMPARED.values()) <= set(peers.COLUMNS))


if __name__ == "__main__":
    unittest.main()
