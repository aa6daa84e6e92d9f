#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Compares a LAMMPS dump with a stored one: dump_check.py DUMP REFERENCE TOLERANCES

Every frame of the reference must be in the dump, with the same atoms. TOLERANCES is a text file
with one line per column of the dump, `name tolerance reason`: the largest absolute difference that
two correct runs can show, and why; tolerance `exact` asks for equal values. # begins a comment.
For every column the atom that differs most is shown; the exit status is 1 if it differs too much.
"""

import sys

import numpy as np

from dumps import read_frames


def read_tolerances(path):
    """{column: tolerance}; every line must give a reason."""
    table = {}
    with open(path, encoding="ascii") as lines:
        for number, line in enumerate(lines, 1):
            words = line.split("#")[0].split(None, 2)
            if not words:
                continue
            if len(words) < 3:
                raise ValueError(f"{path}:{number}: not 'column tolerance reason'")
            table[words[0]] = 0.0 if words[1] == "exact" else float(words[1])
            if not 0.0 <= table[words[0]] < np.inf:
                raise ValueError(f"{path}:{number}: tolerance {words[1]}")
    return table


def same_atoms(frame, reference):
    """Nothing, or what is wrong."""
    here, there = set(frame["id"]), set(reference["id"])
    if len(here) != len(frame):
        return "an atom ID occurs twice"
    if here != there:
        return (f"atoms differ: {len(here)} instead of {len(there)}, "
                f"{len(there - here)} missing, {len(here - there)} new")
    return ""


def compare_column(name, frame, reference, tolerance):
    """(line of the report, whether it is good). A difference that is not a number is not good."""
    if name not in frame.columns:
        return f"  {name:<12} is not in the dump", False
    difference = np.abs(frame[name] - reference[name])
    worst = int(np.argmax(np.where(np.isnan(difference), np.inf, difference)))
    good = bool(difference[worst] <= tolerance)
    return (f"  {name:<12} {difference[worst]:10.3g} of {tolerance:.3g} allowed: atom "
            f"{int(reference['id'][worst])} has {frame[name][worst]:.10g}, reference "
            f"{reference[name][worst]:.10g}{'' if good else '   <-- too far'}"), good


def compare_frame(frame, reference, tolerances):
    """(lines, whether all is good) of one frame."""
    lines, good = [f"step {reference.step}, {len(reference)} atoms"], True
    problem = same_atoms(frame, reference)
    if problem:
        return lines + [f"  {problem}"], False
    for name in reference.columns:
        if name not in tolerances:
            lines.append(f"  {name:<12} has no tolerance")
            good = False
            continue
        line, fine = compare_column(name, frame, reference, tolerances[name])
        lines.append(line)
        good = good and fine
    return lines, good


def compare(dump, reference, tolerances):
    """(report as text, whether all is good); the arguments are paths."""
    frames = {frame.step: frame for frame in read_frames(dump, strict=True)}
    table = read_tolerances(tolerances)
    report, good = [], True
    for stored in read_frames(reference, strict=True):
        if stored.step not in frames:
            report.append(f"step {stored.step} is not in the dump, which has {sorted(frames)}")
            good = False
            continue
        lines, fine = compare_frame(frames[stored.step], stored, table)
        report += lines
        good = good and fine
    return "\n".join(report), good


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    try:
        report, good = compare(*sys.argv[1:])
    except (OSError, ValueError) as problem:
        sys.exit(str(problem))
    print(report)
    sys.exit(0 if good else 1)


if __name__ == "__main__":
    main()
