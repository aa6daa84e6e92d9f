#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Elevation at the ends of a swaying tank next to linear theory: sloshing.py SERIES -L .. [options]

A tank of length L, filled to the depth H, is at rest for t < 0 and then at X(t) = A (1 - cos(w t)).
In the frame of the tank, xi from its left end, the water feels the acceleration -X'' along xi.
Linear potential theory: phi_xi = 0 at the ends, phi_z = 0 on the floor, and on the surface z = 0
  eta_t = phi_z,   phi_t + g eta + X'' (xi - L/2) = 0.
With k_n = n pi/L and
  xi - L/2 = sum a_n cos(k_n xi),  a_n = -4/(L k_n^2) for odd n, 0 for even n,
  phi = sum phi_n(t) cos(k_n xi) cosh k_n(z + H)/cosh k_n H,   eta = sum eta_n(t) cos(k_n xi)
each mode is an oscillator of frequency w_n,
  eta_n'' + w_n^2 eta_n = -K_n X'',   w_n^2 = g k_n tanh k_n H,   K_n = a_n k_n tanh k_n H,
which X'' = A w^2 cos(w t) drives from rest (X' = 0 at the start, so eta_n' = 0, too):
  eta_n = -K_n A w^2 (cos w t - cos w_n t)/(w_n^2 - w^2).
(The series of a tank that sways: Faltinsen, J. Ship Res. 22, 193, 1978.)

--print FILE writes result lines as LAMMPS commands: root mean square and largest difference over
the run, relative to the root mean square and to the largest elevation of the theory; and the factor on
all natural frequencies with which the theory fits the run best.
--plot FILE.png draws both (needs matplotlib; Debian: python3-matplotlib).
"""

import argparse
import math

from series import attempt, print_command, pyplot, read_series

SAMPLE = 300   # times of the fit of the frequency
MODES = 200    # the last terms are A (4/pi)(w/w_1)^2 n^-2 = 1e-5 A


def elevation(xi, t, tank, factor=1.0):
    """eta at the distance xi from the left end; factor: on all natural frequencies."""
    total = 0.0
    for n in range(1, MODES, 2):
        k = n * math.pi / tank.L
        bend = k * math.tanh(k * tank.H)
        drive = 4.0 / (tank.L * k**2) * bend * tank.A * tank.omega**2
        square = factor**2 * tank.g * bend
        total += (drive * (math.cos(tank.omega * t) - math.cos(math.sqrt(square) * t))
                  / (square - tank.omega**2) * math.cos(k * xi))
    return total


def differences(series, tank):
    """{name: (theory, run)} at both ends."""
    return {name: ([elevation(xi, t, tank) for t in series["t"]], series[name])
            for name, xi in (("eta0", 0.0), ("etaL", tank.L))}


def frequency(series, tank):
    """The factor on all natural frequencies with which the theory fits the run best: golden section
    of the sum of squares, of some of the times, to 1e-4."""
    k = math.pi / tank.L
    if series["t"][-1] < 2.0 * math.pi / math.sqrt(tank.g * k * math.tanh(k * tank.H)):
        raise ValueError("the run is shorter than the first natural period")
    rows = range(0, len(series["t"]), 1 + len(series["t"]) // SAMPLE)

    def misfit(factor):
        return sum((series[name][k] - elevation(xi, series["t"][k], tank, factor))**2
                   for k in rows for name, xi in (("eta0", 0.0), ("etaL", tank.L)))

    low, high = 0.9, 1.1
    share = 0.5 * (math.sqrt(5.0) - 1.0)
    while high - low > 1e-4:
        left, right = high - share * (high - low), low + share * (high - low)
        if misfit(left) < misfit(right):
            high = right
        else:
            low = left
    return 0.5 * (low + high)


def result_lines(series, tank):
    def line(name, *more):
        return print_command(["case=sloshing", f"quantity={name}",
                              f"time={series['t'][-1]:.4g}", *more])

    def measure(name, theory, run):
        error = [a - b for a, b in zip(run, theory)]
        l2 = math.sqrt(sum(e * e for e in error) / sum(e * e for e in theory))
        largest = max(map(abs, theory))
        return [line(name, f"l2={l2:.4g}", f"linf={max(map(abs, error)) / largest:.4g}",
                     f"value={max(map(abs, run)):.4g}", f"reference={largest:.4g}")]

    for name, (theory, run) in differences(series, tank).items():
        yield from attempt([name], lambda n=name, a=theory, b=run: measure(n, a, b), line)
    yield from attempt(["frequency"], lambda: [
        line("frequency", f"value={frequency(series, tank):.4f}", "reference=1")], line)


def draw(path, series, tank):
    plt = pyplot()
    figure, panels = plt.subplots(2, 1, figsize=(9, 6), sharex=True, constrained_layout=True)
    names = {"eta0": "left end", "etaL": "right end"}
    for axes, (name, (theory, run)) in zip(panels, differences(series, tank).items()):
        axes.plot(series["t"], theory, "k", label="linear theory")
        axes.plot(series["t"], run, "C0", label="ALE-ISPH")
        axes.set_ylabel(f"elevation, {names[name]} [m]")
        axes.grid(alpha=0.3)
    panels[0].legend()
    panels[1].set_xlabel("t [s]")
    figure.savefig(path, dpi=80)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("series", help="series.sloshing of a run")
    parser.add_argument("-L", type=float, default=1.0, help="length of the tank")
    parser.add_argument("-H", type=float, default=0.5125, help="depth of the water")
    parser.add_argument("-A", type=float, default=0.002, help="amplitude of the sway")
    parser.add_argument("--omega", type=float, required=True, help="its angular frequency")
    parser.add_argument("-g", type=float, default=9.81)
    parser.add_argument("--print", dest="commands", metavar="FILE")
    parser.add_argument("--plot", metavar="FILE.png")
    args = parser.parse_args()
    series = read_series(args.series)
    if args.commands:
        with open(args.commands, "w", encoding="ascii") as out:
            out.writelines(result_lines(series, args))
    if args.plot:
        draw(args.plot, series, args)


if __name__ == "__main__":
    main()
