# SPDX-License-Identifier: GPL-2.0-only
"""Reads the text dumps of LAMMPS (dump custom), plain or compressed by gzip."""

import gzip
from dataclasses import dataclass

import numpy as np


@dataclass
class Frame:
    """One snapshot: columns by name, sorted by atom ID; time is None without dump_modify time."""
    step: int
    time: float
    columns: dict

    def __getitem__(self, name):
        return self.columns[name]

    def __len__(self):
        return len(self.columns["id"])


def open_text(path):
    return gzip.open(path, "rt", encoding="ascii") if str(path).endswith(".gz") else open(
        path, encoding="ascii")


def read_frame(lines):
    """The next snapshot, or None at the end of the file."""
    step = time = count = None
    for line in lines:
        if line.startswith("ITEM: TIMESTEP"):
            step = int(next(lines))
        elif line.startswith("ITEM: TIME"):
            time = float(next(lines))
        elif line.startswith("ITEM: NUMBER OF ATOMS"):
            count = int(next(lines))
        elif line.startswith("ITEM: ATOMS"):
            names = line.split()[2:]
            values = np.array([next(lines).split() for _ in range(count)], dtype=float)
            values = values.reshape(count, len(names))
            if "id" not in names:
                raise ValueError("the dump has no column 'id'")
            values = values[np.argsort(values[:, names.index("id")], kind="stable")]
            return Frame(step, time, dict(zip(names, values.T)))
    if step is not None:
        raise ValueError(f"the dump ends within the snapshot of step {step}")
    return None


def read_frames(path):
    """All snapshots of a dump."""
    frames = []
    with open_text(path) as lines:
        try:
            while (frame := read_frame(lines)) is not None:
                frames.append(frame)
        except (StopIteration, RuntimeError, ValueError) as problem:
            raise ValueError(f"{path} is not a complete text dump: {problem}") from problem
    if not frames:
        raise ValueError(f"{path} holds no snapshot")
    return frames
