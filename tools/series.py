# SPDX-License-Identifier: GPL-2.0-only
"""Time series of LAMMPS' fix ave/time and of reference tables (CSV). Standard library only, so that
scripts which an input file starts run with any Python."""

import csv
import math
import sys
from bisect import bisect_left


def numbers(line, count):
    """Those of a line that is whole, else None: a killed run may leave half of one."""
    words = line.split()
    if len(words) != count or not line.endswith("\n"):
        return None
    try:
        return list(map(float, words))
    except ValueError:
        return None


def read_series(path):
    """{name: list of numbers} of a file of fix ave/time (mode scalar), v_ and c_ removed. A line
    that is cut is left out, and named on stderr."""
    names, rows = [], []
    with open(path, encoding="ascii", errors="replace") as lines:
        for count, line in enumerate(lines, 1):
            if line.startswith("# TimeStep"):
                names = [word.removeprefix("v_").removeprefix("c_") for word in line.split()[1:]]
            elif not line.startswith("#"):
                row = numbers(line, len(names))
                if row is None:
                    print(f"{path}: line {count} is not whole and is left out", file=sys.stderr)
                else:
                    rows.append(row)
    if not rows:
        raise ValueError(f"{path} holds no values")
    return dict(zip(names, map(list, zip(*rows))))


def mean(values):
    """nan if there are none."""
    return sum(values) / len(values) if values else math.nan


def read_table(path):
    """Rows of a CSV file as dicts of text; lines that begin with # are comments."""
    with open(path, encoding="ascii") as lines:
        return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def interpolate(t, times, values):
    """Linear between two times, constant beyond the ends."""
    k = bisect_left(times, t)
    if k == 0 or k == len(times):
        return values[min(k, len(times) - 1)]
    share = (t - times[k - 1]) / (times[k] - times[k - 1])
    return values[k - 1] + share * (values[k] - values[k - 1])


def integral(low, high, times, values):
    """Of the piecewise linear function through the points, by the trapezoidal rule."""
    inside = [k for k, t in enumerate(times) if low < t < high]
    points = ([(low, interpolate(low, times, values))]
              + [(times[k], values[k]) for k in inside]
              + [(high, interpolate(high, times, values))])
    return sum(0.5 * (t1 - t0) * (f0 + f1) for (t0, f0), (t1, f1) in zip(points, points[1:]))


def window_mean(t, width, times, values):
    """Mean of the function over [t - width/2, t + width/2], as far as there are values."""
    low, high = max(t - 0.5 * width, times[0]), min(t + 0.5 * width, times[-1])
    if not high > low:
        return interpolate(t, times, values)
    return integral(low, high, times, values) / (high - low)


def first_above(threshold, times, values):
    """Time at which the values pass the threshold upwards for the first time, or None."""
    for k in range(1, len(times)):
        if values[k - 1] <= threshold < values[k]:
            share = (threshold - values[k - 1]) / (values[k] - values[k - 1])
            return times[k - 1] + share * (times[k] - times[k - 1])
    return None


def print_command(words):
    """A LAMMPS command that prints a result line, with what the input file has in ${tail}."""
    return f'print "ALEISPH-RESULT {" ".join(words)} ${{tail}}"\n'


def attempt(what, work, line):
    """The lines that work() gives; where it cannot measure - a scene that has flown apart, a run
    that was too short - lines with value=nan for these quantities, and the reason on stderr."""
    try:
        return list(work())
    except (ArithmeticError, ValueError) as problem:
        print(f"no value for {', '.join(what)}: {problem}", file=sys.stderr)
        return [line(name, "value=nan") for name in what]


def pyplot():
    """matplotlib's, for pictures without a window."""
    try:
        import matplotlib
        matplotlib.use("Agg")
        import matplotlib.pyplot as plt
    except ImportError as problem:
        sys.exit(f"pictures need {problem.name} for {sys.executable}; "
                 "Debian: apt-get install python3-matplotlib")
    return plt
