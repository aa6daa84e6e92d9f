#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Second order beside exact and spectral solutions: lid-driven cavity, standing wave, free elliptical
drop, impacts. The bounds are those that are asked for, in the field's units; a smaller step must not be
worse.
"""

import math
import unittest

from examples import last


def number(row, key="value"):
    return float(row[key])


def off(row):
    """Relative difference from the reference."""
    return number(row) / number(row, "reference") - 1


def order(errors):
    """Of errors at spacings that are halved."""
    return [math.log2(a / b) for a, b in zip(errors, errors[1:])]


class Cavity(unittest.TestCase):
    def test_smooth_lid(self):
        """No singular corner: the order in space."""
        runs = [last("cavity", lid="smooth", Re=100, T=20, n=n) for n in (20, 40, 80)]
        for quantity, wanted in (("u", 1.8), ("p", 1.5)):
            orders = order([number(run[quantity], "l2") for run in runs])
            print(quantity, orders)
            self.assertGreaterEqual(min(orders), wanted)

    def test_time_steps(self):
        """A steady flow does not depend on the step. 2 % of u-min are asked for."""
        runs = [last("cavity", Re=400, n=50, cfl=cfl) for cfl in (0.2, 0.1, 0.05)]
        for run in runs:
            self.assertLess(abs(off(run["u-min"])), 0.02)
            # steady: a unit of time changes the energy by less than the last digits of the bounds
            self.assertLess(abs(off(run["energy"])), 1e-3)

    def test_high_reynolds_number(self):
        """Against Botella and Peyret."""
        run = last("cavity", Re=1000, n=100, T=60, every=60)
        for quantity, key, bound in (("u", "linf", 0.01), ("v", "linf", 0.01), ("p", "l2", 5e-4)):
            self.assertLess(number(run[quantity], key), bound, quantity)


class Wave(unittest.TestCase):
    def test_inviscid(self):
        for n in (32, 64):
            run = last("wave", n=n)
            self.assertLess(abs(off(run["amplitude"])), 0.03)
            self.assertLess(abs(off(run["frequency"])), 0.005)
            self.assertEqual(number(run["penetration"]), 0)

    def test_viscous(self):
        """The layer below the surface is 1.5 and 3 spacings thick."""
        for n, share in ((32, 0.10), (64, 0.05)):
            run = last("wave", n=n, nu=0.002)
            self.assertLess(abs(off(run["decay"])), share)
            self.assertLess(abs(off(run["frequency"])), 0.005)


class Ellipse(unittest.TestCase):
    def test_shape_and_pressure(self):
        for cfl in (0.2, 0.05):
            run = last("ellipse", n=40, T=1, cfl=cfl)
            for quantity, share in (("area", 0.005), ("a", 0.005), ("b", 0.005), ("p", 0.02)):
                self.assertLess(abs(off(run[quantity])), share, f"{quantity} at cfl {cfl}")


class Impact(unittest.TestCase):
    def check(self, scene, sizes, bound):
        """Bound on the second size; first order: twice the spacing, twice the error, less a fifth for
        what is of higher order."""
        errors = [abs(off(last("impact", scene=scene, n=n)["impulse"])) for n in sizes]
        print(scene, errors)
        self.assertLess(errors[1], bound)
        self.assertGreater(order(errors)[-1], 0.8)

    def test_plate(self):
        self.check("plate", (20, 40, 80), 0.04)

    def test_patch(self):
        self.check("patch", (25, 50, 100), 0.01)

    def test_in_one_step(self):
        """What later steps add is the flow that follows: after ten steps of 1e-4 d/U, ten times the
        pressure rho U^2 of a jet, over a length of a few d, 1e-3 d/U times that: below 1e-2."""
        for scene in ("plate", "patch"):
            self.assertLess(abs(number(last("impact", scene=scene)["later"])), 1e-2)


if __name__ == "__main__":
    unittest.main(verbosity=2)
