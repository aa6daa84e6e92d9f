#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Shifted particles: a smaller time step is never worse, beyond the error in space. Shifts that are
too weak for the strain open voids at small steps, shifts that are too strong overshoot at large ones.
"""

import math
import unittest

from examples import last

CFL = (0.3, 0.2, 0.1, 0.05)    # from large steps to small ones


def relative(row):
    return abs(float(row["value"]) / float(row["reference"]) - 1.0)


class TimeSteps(unittest.TestCase):
    def never_worse(self, error, space):
        """No error may be above any of a larger step by more than the error in space."""
        print(error, space)
        best = max(error.values())
        for step in sorted(error, reverse=True):
            self.assertLessEqual(error[step], best + space, f"time step {step}")
            best = min(best, error[step])

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

    def test_vortices(self):
        """Velocity at t = 1, N = 32; the error in space is that of particles which do not move."""
        space = float(last("taylor-green", N=32, vn=0.05, marks=20)["u"]["l2"])
        runs = {vn: last("taylor-green", N=32, vn=vn, marks=20, frame="ale")
                for vn in (0.1, 0.05, 0.025)}
        error = {vn: float(run["u"]["l2"]) for vn, run in runs.items()}
        self.never_worse(error, space)
        self.assertLessEqual(max(error.values()), 2.0 * space)

    def test_wave(self):
        """Frequency without viscosity. A layer of particles that keeps half a spacing below the
        surface slows a wave by k d/4, that is of first order; other errors are of (k d)^2."""
        kd = math.pi / 16
        runs = {cdt: last("wave", n=16, cdt=cdt, periods=6) for cdt in (0.4, 0.2, 0.1)}
        error = {cdt: relative(run["frequency"]) for cdt, run in runs.items()}
        self.never_worse(error, kd**2)
        self.assertLessEqual(max(error.values()), kd / 4)

    def test_dam_break(self):
        """Energy gained; the largest E/E0 is printed with five decimals."""
        for d in (0.04, 0.02, 0.01):
            runs = {cfl: last("dam-break", d=d, cfl=cfl) for cfl in (0.2, 0.1, 0.05)}
            for run in runs.values():
                self.assertEqual(float(run["penetration"]["value"]), 0)
                self.assertEqual(float(run["lost"]["value"]), 0)
            gain = {cfl: float(run["energy"]["value"]) - 1.0 for cfl, run in runs.items()}
            self.never_worse(gain, 1.0e-5)
            self.assertLessEqual(max(gain.values()), 1.5e-3)


if __name__ == "__main__":
    unittest.main(verbosity=2)
