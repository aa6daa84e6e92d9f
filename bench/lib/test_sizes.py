#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Examples at any size: what is cut off, and what must still be there."""

import unittest

import scene
import sizes


class Sizes(unittest.TestCase):
    def test_heads_are_scenes_without_runs_and_output(self):
        for case in (sizes.TANK_2D, sizes.TANK_3D, sizes.PATCH, sizes.PIPE):
            head = case.head()
            self.assertTrue(scene.find_fix(head, "ppe"), case.case)
            self.assertIn("\ntimestep ", head)
            for command in ("run ", "dump ", "thermo ", "compute "):
                self.assertNotIn("\n" + command, head, f"{case.case}: {command}")
            self.assertRegex(head, rf"(?m)^variable +{case.option} +index ")
            for name in case.fixed:
                self.assertRegex(head, rf"(?m)^variable +{name} +index ")

    def test_a_comment_that_is_not_there_is_an_error(self):
        with self.assertRaises(ValueError):
            sizes.until("run 1\n# --- other ---\n", "measurements")

    def test_sizes_up_to_a_largest(self):
        self.assertEqual(sizes.TANK_2D.upto(1e4), [1e3, 3e3, 1e4])


if __name__ == "__main__":
    unittest.main()
