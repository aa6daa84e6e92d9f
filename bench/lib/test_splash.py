#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""The refined splash: as much water as before, no coincident particles, its velocities."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

import common
import splash


def block(d=0.05, jitter=0.1):
    """A block of 8 x 6 particles in the corner of the tank, disordered, and one far drop."""
    i, j = np.meshgrid(np.arange(1, 9), np.arange(1, 7), indexing="ij")
    x = d * np.column_stack((i.ravel(), j.ravel()))
    x += np.random.default_rng(0).uniform(-jitter, jitter, x.shape) * d
    return np.concatenate((x, [[0.8, 1.0]])), d


def smallest_distance(x):
    r = np.linalg.norm(x[:, None] - x[None], axis=2)
    return np.min(r[np.triu_indices(len(x), 1)])


class Refinement(unittest.TestCase):
    def test_one_is_the_state_itself(self):
        x, d = block()
        same, speed = splash.refine(x, x, d, 1)
        self.assertIs(same, x)
        self.assertIs(speed, x)

    def test_no_two_particles_coincide_also_with_the_walls(self):
        x, d = block()
        fine, _ = splash.refine(x, 0 * x, d, 4)
        everything = np.concatenate((fine, splash.walls(d / 4)))
        self.assertGreater(smallest_distance(everything), 0.6 * d / 4 * 0.999)

    def test_the_water_keeps_its_area_without_holes(self):
        x, d = block()
        m = 4
        fine, _ = splash.refine(x, 0 * x, d, m)
        drop = fine[:, 1] > 0.9
        # a drop is a disc of the reach, up to the lattice
        self.assertAlmostEqual(np.sum(drop) / m**2, np.pi * splash.REACH**2, delta=0.3)
        # inside the block, from the walls on, every point of the lattice is filled
        lattice = np.rint(fine[~drop] * m / d).astype(int)
        inside = np.all((lattice >= 1) & (lattice <= (8 * m, 6 * m)), axis=1)
        self.assertGreaterEqual(np.sum(inside), 0.995 * 8 * 6 * m**2)
        self.assertEqual(len(np.unique(lattice, axis=0)), len(lattice))

    def test_velocities_are_means_of_those_nearby(self):
        x, d = block()
        shear = np.column_stack((2.0 + 0 * x[:, 0], x[:, 0]))
        fine, speed = splash.refine(x, shear, d, 3)
        inner = np.all(fine > 3 * d, axis=1)
        np.testing.assert_allclose(speed[inner, 0], 2.0, rtol=1e-12)
        self.assertLess(np.max(np.abs(speed[:, 1] - fine[:, 0])[inner]), d)

    def test_velocities_at_walls_are_along_them(self):
        x, d = block()
        fine, speed = splash.refine(x, 1.0 + 0 * x, d, 4)
        wall, floor = (fine[:, axis] < 0.3 * d for axis in (0, 1))
        self.assertLess(np.max(speed[wall, 0]), 0.5)
        self.assertLess(np.max(speed[floor, 1]), 0.5)
        np.testing.assert_allclose(speed[floor & (fine[:, 0] > 3 * d), 0], 1.0, rtol=1e-12)


class Files(unittest.TestCase):
    def test_walls_are_closed_below_and_distinct(self):
        solid = splash.walls(0.1)
        self.assertEqual(len(solid), 11 + 2 * 16)
        self.assertAlmostEqual(smallest_distance(solid), 0.1)

    def test_data_file(self):
        x, d = block()
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "data"
            count = splash.write_data(path, x, x, d)
            lines = path.read_text(encoding="ascii").splitlines()
        self.assertIn(f"{count} atoms", lines)
        self.assertEqual(count, len(x) + len(splash.walls(d)))
        start = lines.index("Velocities") + 2
        self.assertEqual(len(lines) - start, count)

    def test_last_frame(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "dump"
            frames = ("ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS id x\n1 2\n"
                      "ITEM: TIMESTEP\n1\nITEM: NUMBER OF ATOMS\n2\nITEM: ATOMS id x\n1 3\n2 4\n")
            path.write_text(frames, encoding="ascii")
            np.testing.assert_array_equal(common.read_dump(path), [[1, 3], [2, 4]])


if __name__ == "__main__":
    unittest.main()
