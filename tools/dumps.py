# SPDX-License-Identifier: GPL-2.0-only
"""Reads the text dumps of LAMMPS (dump custom), plain or compressed by gzip. All tools read them here.

A run that is killed leaves a snapshot that is cut, at the end of the file or, with dump_modify append,
in the middle of it. Snapshots that are whole are read; of others stderr says which they are. Whole is
a snapshot with as many lines as its header says, each with a number for every column and ended by a
newline: without that, the last number may lack digits. A number may be nan or inf; finite_rows() and
finite() leave such particles out and say so.

snapshots() and rows need the standard library only; read_frames() needs numpy.
"""

import gzip
import math
import sys
import zlib
from dataclasses import dataclass

CUT = (EOFError, zlib.error, gzip.BadGzipFile)    # of a compressed file


@dataclass
class Snapshot:
    """One snapshot; time is None without dump_modify time, names and rows (lists of numbers) are
    columns and particles, bounds [(low, high)] of the box and periodic [whether]."""
    step: int
    time: float
    bounds: list
    periodic: list
    names: list
    rows: list

    def dicts(self):
        """{column: number} of every particle."""
        return [dict(zip(self.names, row)) for row in self.rows]

    def columns(self):
        """{column: list of numbers}"""
        return {name: [row[k] for row in self.rows] for k, name in enumerate(self.names)}


class Cut(ValueError):
    """A snapshot is not whole; `line` is the line at which the next one may begin."""

    def __init__(self, problem, line=""):
        super().__init__(problem)
        self.line = line


class Lines:
    """Lines of a dump; one that was read can be given back."""

    def __init__(self, source):
        self.source, self.kept = source, ""

    def next(self):
        """The next line, "" at the end of the file."""
        if self.kept:
            line, self.kept = self.kept, ""
            return line
        try:
            return self.source.readline()
        except CUT as problem:
            raise Cut(f"the compressed file ends early ({problem})") from problem

    def body(self):
        """The next line, which must be whole and no header."""
        line = self.next()
        at = line.find("ITEM:")
        if at >= 0:
            raise Cut("another snapshot begins before its last line", line[at:])
        if not line.endswith("\n"):
            raise Cut("the file ends within it")
        return line


def open_text(path):
    opener = gzip.open if str(path).endswith(".gz") else open
    return opener(path, "rt", encoding="ascii", errors="replace")


def number(line, kind=int):
    try:
        return kind(line)
    except ValueError:
        raise Cut(f"'{line.strip()}' is no number") from None


def read_row(line, names):
    words = line.split()
    if len(words) != len(names):
        raise Cut(f"a line has {len(words)} of {len(names)} columns")
    try:
        return list(map(float, words))
    except ValueError:
        raise Cut(f"'{line.strip()}' are not all numbers") from None


def read_bounds(line, lines, found):
    kinds = line.split()[3:]
    if not all(len(kind) == 2 for kind in kinds[-3:]):    # a skewed or general box has other words
        kinds = []
    found["periodic"] = [kind == "pp" for kind in kinds[-3:]] or [False] * 3
    rows = [lines.body().split() for _ in range(3)]
    found["bounds"] = [tuple(number(word, float) for word in row[:2]) for row in rows]


def once(name, found, line):
    if name in found:
        raise Cut("another snapshot begins within its header", line)


def read_snapshot(lines, found):
    """The next snapshot, or None at the end of the file. found: what is known of it so far."""
    while line := lines.next():
        if line.startswith("ITEM: TIMESTEP"):
            once("step", found, line)
            found["step"] = number(lines.body())
        elif line.startswith("ITEM: TIME"):
            once("time", found, line)
            found["time"] = number(lines.body(), float)
        elif line.startswith("ITEM: NUMBER OF ATOMS"):
            found["count"] = number(lines.body())
        elif line.startswith("ITEM: BOX BOUNDS"):
            read_bounds(line, lines, found)
        elif line.startswith("ITEM: ATOMS"):
            if "count" not in found or not line.endswith("\n"):
                raise Cut("its header is not whole")
            names = line.split()[2:]
            rows = [read_row(lines.body(), names) for _ in range(found["count"])]
            return Snapshot(found.get("step"), found.get("time"), found.get("bounds"),
                            found.get("periodic"), names, rows)
    if found:
        raise Cut("the file ends within its header")
    return None


def skip_to_header(lines):
    """To the next line that may begin a snapshot."""
    while (line := lines.next()) and not line.startswith("ITEM: "):
        pass
    lines.kept = line


def warn(text):
    print(text, file=sys.stderr)


def snapshots(path, strict=False):
    """The whole snapshots of a dump, one after the other. What is cut is named on stderr; strict:
    it is an error."""
    count = whole = 0
    with open_text(path) as source:
        lines = Lines(source)
        while True:
            count, found = count + 1, {}
            try:
                snapshot = read_snapshot(lines, found)
                if snapshot is None:
                    break
                whole += 1
            except Cut as problem:
                step = f"of step {found['step']}" if "step" in found else "of unknown step"
                text = f"{path}: snapshot {count}, {step}, is not whole: {problem}"
                if strict:
                    raise ValueError(text) from problem
                warn(f"{text}; it is left out")
                lines.kept = problem.line
                if not isinstance(problem.__cause__, CUT):
                    if not lines.kept:
                        skip_to_header(lines)
                    continue
                break
            yield snapshot
    if not whole:
        raise ValueError(f"{path} holds no whole snapshot")


def last_snapshot(path):
    """The last whole snapshot of a dump."""
    for snapshot in snapshots(path):
        pass
    return snapshot


def need_time(snapshot, path):
    """Its time, which dump_modify ... time yes writes."""
    if snapshot.time is None:
        raise ValueError(f"{path} holds no times: dump_modify ... time yes writes them")
    return snapshot.time


def need_columns(names, wanted, path):
    missing = [name for name in wanted if name not in names]
    if missing:
        raise ValueError(f"{path} has no column {', '.join(missing)}; it has {' '.join(names)}")


def not_finite(count, total, identity, names, where):
    warn(f"{where}: {count} of {total} particles have values that are not finite and are left out; "
         f"the first is {identity} ({', '.join(names)})")


def finite_rows(rows, names, where):
    """Of rows {column: number}, those whose named columns are finite; stderr says what is left out."""
    def bad_names(row):
        return [name for name in names if not math.isfinite(row[name])]
    bad = [row for row in rows if bad_names(row)]
    if bad:
        not_finite(len(bad), len(rows), f"id {bad[0].get('id', math.nan):.0f}", bad_names(bad[0]),
                   where)
    return [row for row in rows if not bad_names(row)]


# --- numpy ----------------------------------------------------------------------------------------

@dataclass
class Frame:
    """One snapshot: columns (arrays) by name, sorted by atom ID if there is one."""
    step: int
    time: float
    columns: dict

    def __getitem__(self, name):
        if name not in self.columns:
            raise ValueError(f"the dump has no column {name}; it has {' '.join(self.columns)}")
        return self.columns[name]

    def __len__(self):
        return len(next(iter(self.columns.values()), ()))


def as_frame(snapshot):
    import numpy as np
    values = np.array(snapshot.rows, dtype=float).reshape(len(snapshot.rows), len(snapshot.names))
    if "id" in snapshot.names:
        order = np.argsort(values[:, snapshot.names.index("id")], kind="stable")
        values = values[order]
    return Frame(snapshot.step, snapshot.time, dict(zip(snapshot.names, values.T)))


def read_frames(path, strict=False):
    """All whole snapshots of a dump; strict: one that is cut is an error."""
    return [as_frame(snapshot) for snapshot in snapshots(path, strict)]


def finite(frame, names, where):
    """Mask of the particles whose named columns are finite; stderr says what is left out."""
    import numpy as np
    good = np.all([np.isfinite(frame[name]) for name in names], axis=0)
    if not good.all():
        bad = int(np.flatnonzero(~good)[0])
        identity = f"id {frame['id'][bad]:.0f}" if "id" in frame.columns else f"row {bad + 1}"
        not_finite(np.sum(~good), len(good), identity,
                   [name for name in names if not np.isfinite(frame[name][bad])], where)
    return good
