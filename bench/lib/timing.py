# SPDX-License-Identifier: GPL-2.0-only
"""Reads the timing that the styles print after a run ("ALEISPH time: ...")."""

import re

PART = re.compile(r"^  (\w+) +(\S+) s +\S+ %$")
LOOP = re.compile(r"^Loop time of (\S+) on \d+ procs for (\d+) steps with (\d+) atoms", re.M)


def last_block(text):
    """Of the last run of a log: seconds by part (mean over the ranks), loop time, steps, atoms."""
    block = text[text.rindex("ALEISPH time:"):]
    seconds = {}
    for line in block.splitlines()[1:]:
        match = PART.match(line)
        if not match:
            break
        seconds[match[1]] = float(match[2])
    loop = LOOP.search(block)
    if not seconds or not loop:
        raise RuntimeError("the log has no 'ALEISPH time' with its parts and no 'Loop time'")
    return seconds, float(loop[1]), int(loop[2]), int(loop[3])


def by_part(text):
    """({part: microseconds per particle and step}, atoms, steps).

    total: the time between first and last step. other: what of it is in no part, which is LAMMPS'
    own work: neighbor lists, forces, output.
    """
    seconds, loop, steps, atoms = last_block(text)
    scale = 1e6 / (steps * atoms)
    parts = {part: scale * s for part, s in seconds.items()}
    parts["other"] = scale * max(0.0, loop - sum(seconds.values()))
    parts["total"] = scale * loop
    return parts, atoms, steps
