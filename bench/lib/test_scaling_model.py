#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""The model of many ranks: its limits, and the line that it reads."""

import unittest

from scaling_model import Network, Step, traffic

CUBE = Step(dimension=3, seconds=1e-5, particles=1000, reductions=40, exchanges=50, messages=350,
            bytes=1e5, iterations=10)


class Model(unittest.TestCase):
    def test_the_line_of_the_last_run(self):
        text = ("ALEISPH communication per step: 1 reductions, 1 halo exchanges, 1 messages, "
                "1 bytes per rank\n"
                "ALEISPH communication per step: 18.2 reductions, 13.1 halo exchanges, "
                "13 messages, 5.421e+04 bytes per rank\n")
        self.assertEqual(traffic(text), {"reductions": 18.2, "exchanges": 13.1, "messages": 13.0,
                                         "bytes": 54210.0})
        with self.assertRaises(RuntimeError):
            traffic("no such line")

    def test_a_rank_inside_has_26_neighbours_and_faces_on_both_sides(self):
        self.assertAlmostEqual(CUBE.neighbours(), 26)
        self.assertAlmostEqual(CUBE.surface(1000), 2e5)
        self.assertAlmostEqual(CUBE.surface(8000), 8e5)   # twice the length, four times the face

    def test_each_term_by_hand(self):
        # 50 exchanges of 26 messages, 40 reductions of log2(1024) stages, 2e5 bytes
        seconds = CUBE.communication(1000, 1024, Network(latency=1e-6, bandwidth=1e9))
        self.assertAlmostEqual(seconds, (1300 + 400) * 1e-6 + 2e-4)
        self.assertAlmostEqual(CUBE.efficiency(1000, 1024, Network(1e-6, 1e9)),
                               1e-2 / (1e-2 + seconds))

    def test_levels_of_multigrid(self):
        # 1e5 * 8^2 unknowns: two levels above those of 1e5
        network = Network(latency=1e-6, bandwidth=1e30)
        more = [CUBE.communication(n, 1, network, True) - CUBE.communication(n, 1, network)
                for n in (1e5, 6.4e6)]
        self.assertAlmostEqual(more[1] - more[0], 2 * 2 * 10 * 3 * 26 * 1e-6)

    def test_a_network_without_cost_is_perfect(self):
        self.assertEqual(CUBE.efficiency(1000, 10**6, Network(0.0, float("inf"))), 1.0)


if __name__ == "__main__":
    unittest.main()
