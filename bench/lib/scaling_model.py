# SPDX-License-Identifier: GPL-2.0-only
"""A step on many ranks from what one rank computes and what a few ranks say to each other.

The styles print reductions, halo exchanges, messages and bytes of a step ("ALEISPH communication
per step"). They are measured on 2^dimension ranks, where each rank has one neighbour in each
direction; inside of a larger grid it has 3^dimension - 1 of them, and faces on both sides.

    T(P) = n t_1 + messages latency + bytes/bandwidth + reductions log2(P) latency

n particles per rank, t_1 seconds per particle and step on one rank without communication. Nothing
is hidden behind computation and messages go out one after the other, so that it errs upwards; the
iterations are those that were measured. Multigrid sends more: EXCHANGES_A_LEVEL on each level below
the finest, twice an iteration, too small for the bandwidth to matter.
"""

import math
import re
from dataclasses import dataclass

LINE = re.compile(r"^ALEISPH communication per step: (\S+) reductions, (\S+) halo exchanges, "
                  r"(\S+) messages, (\S+) bytes per rank$", re.M)
EXCHANGES_A_LEVEL = 3   # smoothing down and up, residual
COARSEST = 100          # unknowns that are solved for directly


def traffic(text):
    """{quantity: number per step and rank} of the last run of a log."""
    found = LINE.findall(text)
    if not found:
        raise RuntimeError("the log has no line 'ALEISPH communication per step'")
    names = ("reductions", "exchanges", "messages", "bytes")
    return dict(zip(names, map(float, found[-1])))


@dataclass(frozen=True)
class Network:
    latency: float = 1.5e-6     # of one message [s]
    bandwidth: float = 1.0e10   # of one rank [byte/s]


@dataclass(frozen=True)
class Step:
    """What was measured of one step."""
    dimension: int
    seconds: float      # per particle, on one rank, without communication
    particles: float    # per rank, where the rest was counted, on 2^dimension ranks
    reductions: float
    exchanges: float
    messages: float     # per rank
    bytes: float        # per rank
    iterations: float

    def neighbours(self):
        """Messages of an exchange on a rank that has ranks all round it."""
        corner = 2**self.dimension - 1
        return self.messages / self.exchanges * (3**self.dimension - 1) / corner

    def surface(self, n):
        """Bytes of a step on such a rank with n particles."""
        return 2 * self.bytes * (n / self.particles)**(1 - 1 / self.dimension)

    def communication(self, n, ranks, network, multigrid=False):
        """Seconds of a step."""
        messages = self.exchanges * self.neighbours()
        if multigrid:
            levels = max(0.0, math.log2(n * ranks / COARSEST) / self.dimension)
            messages += 2 * self.iterations * levels * EXCHANGES_A_LEVEL * self.neighbours()
        reductions = self.reductions * math.log2(ranks)
        return ((messages + reductions) * network.latency
                + self.surface(n) / network.bandwidth)

    def efficiency(self, n, ranks, network, multigrid=False):
        """Of ranks with n particles each, beside one rank with n particles."""
        alone = n * self.seconds
        return alone / (alone + self.communication(n, ranks, network, multigrid))
