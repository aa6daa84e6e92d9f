#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Reading runs of the drop: a drop at rest, one that exploded, one that failed."""

import unittest

import common
import drops

AT_REST = """ALEISPH-RESULT case=laplace quantity=p value=11.3 reference=10 l2=0.13 N=8 seconds=2
ALEISPH-RESULT case=laplace quantity=velocity value=0.01 reference=0
ALEISPH-RESULT case=laplace quantity=sphericity value=1.02 linf=0.3
ALEISPH-RESULT case=laplace quantity=volume value=1.01 outline=0.99
"""


def found(text):
    return {line["quantity"]: line for line in common.lines_with(common.RESULT, text)}


class Drops(unittest.TestCase):
    def test_at_rest(self):
        lines = found(AT_REST)
        self.assertEqual(drops.verdict("", lines), "")
        row = drops.measures(lines)
        self.assertAlmostEqual(row["p"], 1.13)
        self.assertEqual((row["N"], row["l2"], row["sphericity"], row["volume"]),
                         (8, 0.13, 0.3, 0.99))

    def test_exploded(self):
        for radius in ("55.8", "nan"):
            lines = found(AT_REST.replace("linf=0.3", f"linf={radius}"))
            self.assertEqual(drops.verdict("", lines), "explodes")

    def test_failed(self):
        self.assertEqual(drops.verdict("status 1", found(AT_REST)), "status 1")
        self.assertEqual(drops.verdict("", {}), "explodes")


if __name__ == "__main__":
    unittest.main(verbosity=2)
