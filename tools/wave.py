#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Standing gravity waves: linear theory; frequency and decay of a series. Standard library only.

wave.py SERIES... -L .. -H .. -A .. [-g ..] [--nu ..] --print FILE | --plot FILE.png

A tank of length L with slip walls holds liquid of depth H; first mode, wave number k = pi/L. The flow
with the time factor exp(s t) is a potential flow and a vortical one (H. Lamb, Hydrodynamics, 1932,
349, there for infinite depth): with z from the floor and m^2 = k^2 + s/nu
  v = (a sinh kz + b sinh mz) cos kx,  u = -(a cosh kz + b (m/k) cosh mz) sin kx,
  p = -rho s (a/k) cosh kz cos kx
which a slip floor and slip walls admit. On the surface z = H, with s eta = v,
  no shear stress      2 k^2 a sinh kH + (k^2 + m^2) b sinh mH = 0
  no normal stress     p - 2 rho nu v_z = rho g eta.
The first gives b, the second s = -gamma +- i omega. For small nu, gamma is 2 nu k^2, less a share of
order sqrt(nu). Without viscosity omega is that of I. Tadjbakhsh, J. B. Keller, J. Fluid Mech. 8, 442
(1960), for a finite amplitude A: omega_0 (1 + (kA)^2 c/2), omega_0^2 = g k tanh kH.

--print FILE writes result lines as LAMMPS commands: frequency and decay of the velocity of the mode
(exp(-gamma t) cos(omega t + a) fitted to all but the first period), and its amplitude in the last
period over that in the first. --plot draws the elevation of one or more runs over that of the theory.
"""

import argparse
import cmath
import math

from oscillation import fit
from series import attempt, mean, print_command, pyplot, read_series

SAMPLE = 600    # times of the fit


def weakly_nonlinear(kH, kA):
    """omega/omega_0 of an inviscid standing wave with the amplitude A of the first mode."""
    w = math.sqrt(math.tanh(kH))
    return 1.0 + kA**2 / (64.0 * w) * (9.0 / w**7 - 12.0 / w**3 - 3.0 * w - 2.0 * w**5)


def boundary(wave, s):
    """What is left of the condition of no normal stress, over cosh kH; b sinh mH with the first."""
    k, T = wave.k, math.tanh(wave.k * wave.H)
    m = cmath.sqrt(k * k + s / wave.nu)
    b = -2.0 * k * k * T / (k * k + m * m)
    slope = k + b * m / cmath.tanh(m * wave.H)           # v_z
    return s * s / k + 2.0 * wave.nu * s * slope + wave.g * (T + b)


class Wave:
    def __init__(self, L, H, A, g, nu):
        self.k, self.H, self.A, self.g, self.nu = math.pi / L, H, A, g, nu
        self.omega0 = math.sqrt(g * self.k * math.tanh(self.k * H))
        self.omega, self.gamma = self.theory()

    def theory(self):
        """(omega, gamma)"""
        shift = weakly_nonlinear(self.k * self.H, self.k * self.A)
        if self.nu == 0.0:
            return self.omega0 * shift, 0.0
        last = complex(-2.0 * self.nu * self.k**2, self.omega0)
        s, rest = 1.001 * last, boundary(self, last)
        for _ in range(50):
            value = boundary(self, s)
            if abs(s - last) < 1e-13 * self.omega0 or value == rest:
                break
            last, s, rest = s, s - value * (s - last) / (value - rest), value
        return s.imag * shift, -s.real

    def period(self):
        return 2.0 * math.pi / self.omega

    def eta(self, t):
        """Elevation of the mode over A."""
        return math.exp(-self.gamma * t) * math.sin(self.omega * t)


def fitted(series, wave):
    """(omega, gamma) of the velocity of the mode"""
    rows = [k for k, t in enumerate(series["t"]) if t >= wave.period()]
    rows = rows[::1 + len(rows) // SAMPLE]
    return fit([series["t"][k] for k in rows], [series["c"][k] for k in rows], wave.omega,
               wave.gamma)[:2]


def strength(series, low, high):
    """Amplitude of the velocity in a time span that is a period."""
    return math.sqrt(2.0 * mean([c * c for t, c in zip(series["t"], series["c"])
                                 if low <= t <= high]))


def result_lines(series, wave):
    end = series["t"][-1]

    def line(name, *more):
        return print_command(["case=wave", f"quantity={name}", f"time={end:.5g}", *more])

    def oscillation():
        if end < 3.0 * wave.period():
            raise ValueError("the run is shorter than three periods")
        omega, gamma = fitted(series, wave)
        yield line("frequency", f"value={omega:.6g}", f"reference={wave.omega:.6g}")
        yield line("decay", f"value={gamma:.4g}", f"reference={wave.gamma:.4g}")
        share = strength(series, end - wave.period(), end) / strength(series, 0.0, wave.period())
        yield line("amplitude", f"value={share:.5g}",
                   f"reference={math.exp(-wave.gamma * (end - wave.period())):.5g}")
    yield from attempt(["frequency", "decay", "amplitude"], oscillation, line)


def draw(path, runs, waves):
    plt = pyplot()
    figure, panels = plt.subplots(len(runs), 1, figsize=(9, 2.6 * len(runs)), sharex=True,
                                  squeeze=False, constrained_layout=True)
    for axes, (name, series), wave in zip(panels[:, 0], runs.items(), waves):
        axes.plot(series["t"], [wave.eta(t) for t in series["t"]], "k", linewidth=2.5, alpha=0.4,
                  label="theory")
        axes.plot(series["t"], series["eta"], "C0", label=f"ALE-ISPH, nu = {wave.nu:g}")
        axes.set(ylabel="elevation/A", xlim=(0, series["t"][-1]), ylim=(-1.3, 1.7))
        axes.grid(alpha=0.3)
        axes.legend(loc="upper right", fontsize=9, ncol=2)
    panels[-1, 0].set_xlabel("t sqrt(g/H)")
    figure.savefig(path, dpi=80)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("series", nargs="+", help="series.wave of runs")
    parser.add_argument("-L", type=float, default=1.0, help="length of the tank")
    parser.add_argument("-H", type=float, default=1.0, help="depth")
    parser.add_argument("-A", type=float, default=0.02, help="amplitude")
    parser.add_argument("-g", type=float, default=1.0)
    parser.add_argument("--nu", type=float, nargs="+", default=[0.0], help="one for each series")
    parser.add_argument("--print", dest="commands", metavar="FILE")
    parser.add_argument("--plot", metavar="FILE.png")
    args = parser.parse_args()
    waves = [Wave(args.L, args.H, args.A, args.g, nu) for nu in args.nu]
    runs = {path: read_series(path) for path in args.series}
    if args.commands:
        with open(args.commands, "w", encoding="ascii") as out:
            out.writelines(result_lines(runs[args.series[0]], waves[0]))
    if args.plot:
        draw(args.plot, runs, waves)


if __name__ == "__main__":
    main()
