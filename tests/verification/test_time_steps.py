#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Shifted particles with a free surface: a smaller time step is never worse, beyond the error in
space. Shifts that are too weak for the strain open voids at small steps, shifts that are too strong
overshoot at large ones.
"""

import unittest

from examples import last

CFL = (0.3, 0.2, 0.1, 0.05)    # from large steps to small ones


def relative(row):
    return abs(float(row["value"]) / float(row["reference"]) - 1.0)


class TimeSteps(unittest.TestCase):
    def never_worse(self, error, space):
        """No error may be above any of a larger step by more than the error in space."""
        print(error, space)
        best = error[CFL[0]]
        for cfl in CFL:
            self.assertLessEqual(error[cfl], best + space, f"Courant number {cfl}")
            best = min(best, error[cfl])

    def test_ellipse(self):
        """Area, half axis b, energy of the drop of 20 spacings at t = 1."""
        runs = {cfl: last("ellipse", n=20, T=1.0, cfl=cfl) for cfl in CFL}
        # second order in space, of a body with the half thickness b = 0.44: (d/b)^2 = 1.3 %
        space = (0.05 / 0.44)**2
        for quantity in ("area", "b", "energy"):
            error = {cfl: relative(run[quantity]) for cfl, run in runs.items()}
            self.never_worse(error, space)
            self.assertLessEqual(max(error.values()), space, quantity)

    def test_patch(self):
        """Energy and pressure of the square patch at omega t = 2."""
        runs = {cfl: last("square-patch", d=0.02, T=2, cfl=cfl) for cfl in CFL}
        # (d/(L/2))^2; the pressure in units of rho omega^2 L^2, begins with 0.147
        space = (0.02 / 0.5)**2
        error = {cfl: relative(run["energy"]) for cfl, run in runs.items()}
        self.never_worse(error, space)
        self.assertLessEqual(max(error.values()), 2.0 * space)
        error = {cfl: float(run["p-deviation"]["linf"]) for cfl, run in runs.items()}
        self.never_worse(error, space)
        self.assertLessEqual(max(error.values()), space)


if __name__ == "__main__":
    unittest.main(verbosity=2)
