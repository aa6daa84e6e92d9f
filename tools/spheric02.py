#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Gauges of examples/dam-break-obstacle next to the MARIN experiment: spheric02.py SERIES [options]

--print FILE writes result lines as LAMMPS commands:
  H1-H4    value, reference: mean over the run; l2: root mean square of the difference, relative to
           the depth of the water at the start; both averaged over 20 ms
  arrival  of the water at H1-H3: the height passes 0.05 m
  P1-P4    mean over the first impact (0.4-1.0 s), P5-P8 from 1.0 s to the end: the impulse. Peaks
           are no measure: of an impact of incompressible water, they grow as 1/dt.
           l2: root mean square of the difference of 20 ms means, relative to rho g times that depth
--plot FILE.png draws all of them (needs matplotlib; Debian: python3-matplotlib).
"""

import argparse
import math
from pathlib import Path

from series import (attempt, first_above, integral, interpolate, mean, print_command, pyplot,
                    read_series, read_table, window_mean)

REFERENCE = Path(__file__).resolve().parents[1] / "tests" / "reference"
HEIGHTS = ["H1", "H2", "H3", "H4"]
PRESSURES = [f"P{k}" for k in range(1, 9)]
DEPTH = 0.55
HEAD = 1000.0 * 9.81 * DEPTH
WINDOW = 0.02
ARRIVED = 0.05
IMPACT = (0.4, 1.0)


def experiment():
    """(heights, pressures) as {name: list of numbers}; pressures averaged over WINDOW, too."""
    tables = []
    for kind in ("heights", "pressures"):
        rows = read_table(REFERENCE / f"spheric02_{kind}.csv")
        tables.append({name: [float(row[name]) for row in rows] for name in rows[0]})
    return tables


def compare(name, series, reference, scale, low, high):
    """(mean, mean of the experiment, rms difference/scale) between two times."""
    times = [t for t in reference["t"] if low <= t <= high and t <= series["t"][-1]]
    if not times:
        raise ValueError(f"{name} was not measured between {low:g} and {high:g} s")
    here = [window_mean(t, WINDOW, series["t"], series[name]) for t in times]
    there = [window_mean(t, WINDOW, reference["t"], reference[name]) if scale == HEAD
             else interpolate(t, reference["t"], reference[name]) for t in times]
    square = sum((a - b)**2 for a, b in zip(here, there)) / len(times)
    return mean(here), mean(there), square**0.5 / scale


def line(quantity, time, value, reference, *more):
    return print_command(["case=dam-break-obstacle", f"quantity={quantity}", f"time={time:.4g}",
                          f"value={value:.4g}", f"reference={reference:.4g}", *more])


def height_lines(series, reference):
    end = series["t"][-1]
    for name in HEIGHTS:
        def measure(name=name):
            value, measured, error = compare(name, series, reference, DEPTH, 0.0, end)
            return [line(name, end, value, measured, f"l2={error:.4f}")]
        yield from attempt([name], measure, lambda name, _: line(name, end, math.nan, math.nan))
    for name in HEIGHTS[:3]:
        here = first_above(ARRIVED, series["t"], series[name])
        there = first_above(ARRIVED, reference["t"], reference[name])
        if here is not None:
            yield line("arrival", end, here, there, f"gauge={name}")


def pressure_lines(series, reference):
    end = series["t"][-1]
    for number, name in enumerate(PRESSURES):
        low, high = IMPACT if number < 4 else (IMPACT[1], end)
        if high > low and end >= high:
            _, _, error = compare(name, series, reference, HEAD, low, high)
            value, measured = (integral(low, high, table["t"], table[name]) / (high - low)
                               for table in (series, reference))
            yield line(name, high, value, measured, f"l2={error:.4f}")


def draw(path, series, heights, pressures):
    """One panel per gauge: the experiment in black, the run in color."""
    plt = pyplot()
    figure, panels = plt.subplots(3, 4, figsize=(15, 8.5), sharex=True, constrained_layout=True)
    end = series["t"][-1]
    for axes, name in zip(panels.flat, HEIGHTS + PRESSURES):
        high = name in HEIGHTS
        table, unit = (heights, 1.0) if high else (pressures, 1000.0)
        times = [t for t in table["t"] if t <= end]
        axes.plot(times, [v / unit for v in table[name][:len(times)]], "k", label="experiment")
        axes.plot(times, [window_mean(t, WINDOW, series["t"], series[name]) / unit for t in times],
                  "C0", label="ALE-ISPH, mean over 20 ms")
        axes.set_title(f"{name} [{'m' if high else 'kPa'}]")
        axes.grid(alpha=0.3)
    for axes in panels[-1]:
        axes.set_xlabel("t [s]")
    panels[0][0].legend()
    figure.savefig(path, dpi=80)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("series", help="series.dam-break-obstacle of a run")
    parser.add_argument("--print", dest="commands", metavar="FILE")
    parser.add_argument("--plot", metavar="FILE.png")
    args = parser.parse_args()
    series = read_series(args.series)
    heights, pressures = experiment()
    if args.commands:
        with open(args.commands, "w", encoding="ascii") as out:
            out.writelines(height_lines(series, heights))
            out.writelines(pressure_lines(series, pressures))
    if args.plot:
        draw(args.plot, series, heights, pressures)


if __name__ == "__main__":
    main()
