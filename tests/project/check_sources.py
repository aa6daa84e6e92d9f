#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Rules on the sources that no compiler checks: check_sources.py RULE

dependencies  numerics (aleisph_*) include only numerics, the standard library and Eigen, those of
              several ranks (aleisph_mpi_*) MPI and hypre, too; a style (fix_*, compute_*) includes
              numerics, LAMMPS and the owner, but no other style
style_headers LAMMPS includes the headers of all styles in one file: each includes its base class
              (fix.h, compute.h; aleisph_scene.h if it has one of that) and the standard library
headers       file heads: the licence line; include guards LMP_<FILE NAME>_H
ascii         source, scripts, examples and documentation are plain ASCII
names         no header of ours has the name of one of LAMMPS' headers
rows          no loop over particles is written by hand: aleisph_rows.h has for_rows and its kind
Prints file:line of every violation; the exit status is 1 if there is one.
"""

import os
import re
import sys
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
PACKAGE = TOP / "src" / "USER-ALEISPH"
# the owner and what it lends to styles
OWNER = {"fix_aleisph.h", "aleisph_halo_owner.h", "aleisph_halo_checks.h", "aleisph_halo_warnings.h",
         "aleisph_halo_fields.h",
         "aleisph_halo_operator.h", "aleisph_halo_solver.h",
         "aleisph_halo_variable.h"}
LICENCE = "SPDX-License-Identifier: GPL-2.0-only"
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')
# i is the index of particles; matrices and vectors have loops of their own kind, over n entries
ROW_LOOP = re.compile(r"for \((const )?(int|auto) i : |"
                      r"for \(int (\w+) = 0; \3 < [^;]*(nlocal|owned\(\)|\bs_?\.rows\(\))")
STYLE = re.compile(r"^(fix|compute)_.*\.h$")
SCENE_BASE = re.compile(r"(public|private) aleisph::\w+")    # among the base classes
CODE = (".h", ".cpp", ".py", ".sh", ".cmake")
TEXT = CODE + (".rst", ".md", ".txt", ".json", ".aleisph", ".lmp")


def package_files():
    files = sorted(PACKAGE.glob("*.h")) + sorted(PACKAGE.glob("*.cpp"))
    if not files:
        sys.exit(f"no sources in {PACKAGE}")
    return files


def project_files(suffixes):
    """Files of the project, without what is built, run or hidden."""
    skip = {"build", "run", "__pycache__", "results"}
    for folder, folders, names in os.walk(TOP):
        folders[:] = [f for f in folders
                      if f not in skip and not f.startswith((".", "build-"))]
        for name in sorted(names):
            if name.endswith(suffixes) or name.startswith("in."):
                yield Path(folder) / name


def includes(path):
    for number, line in enumerate(path.read_text().splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match[1] == "<", match[2]


def wrong_in_numerics(path, system, name):
    ranks = path.name.startswith("aleisph_mpi_")
    if not system:
        return (not name.startswith("aleisph_") or name in OWNER
                or name.startswith("aleisph_mpi_") and not ranks)
    if ranks and (name == "mpi.h" or name.startswith("HYPRE")):
        return False
    if name.startswith("Eigen/") or name == "math.h":    # math.h: Bessel functions of POSIX
        return False
    return "/" in name or name.endswith(".h")


def wrong_in_style(path, name):
    stem = name.removesuffix(".h")    # of its own header; a style may have more than one source file
    own = path.stem == stem or path.stem.startswith(stem + "_")
    return bool(STYLE.match(name)) and "aleisph" in name and not own and name not in OWNER


def dependencies():
    for path in package_files():
        numerics = path.name.startswith("aleisph_") and path.name not in OWNER
        for number, system, name in includes(path):
            bad = wrong_in_numerics(path, system, name) if numerics else wrong_in_style(path, name)
            if bad:
                yield path, number, f"must not include {name}"


def style_headers():
    for path in package_files():
        if not STYLE.match(path.name):
            continue
        allowed = {path.name.split("_")[0] + ".h"}
        if SCENE_BASE.search(path.read_text()):
            allowed.add("aleisph_scene.h")
        for number, system, name in includes(path):
            if name not in allowed and (not system or "/" in name or name.endswith(".h")):
                yield path, number, (f"includes {name}: declare its classes here, include it in the "
                                     "source file")


def headers():
    for path in project_files(CODE):
        head = path.read_text().splitlines()[:6]
        if not any(LICENCE in line for line in head):
            yield path, 1, f"has no line '{LICENCE}' in its head"
    for path in package_files():
        guard = "LMP_" + path.stem.upper() + "_H"
        if path.suffix == ".h" and f"#ifndef {guard}\n" not in path.read_text():
            yield path, 1, f"has no include guard {guard}"


def ascii_only():
    for path in project_files(TEXT):
        for number, line in enumerate(path.read_bytes().splitlines(), 1):
            if any(byte > 126 for byte in line):
                yield path, number, "is not plain ASCII"


def names():
    lammps = os.environ.get("LAMMPS_SOURCE_DIR")
    if not lammps:
        print("LAMMPS_SOURCE_DIR is not set: only the prefix is checked")
    theirs = {p.name for p in Path(lammps, "src").rglob("*.h")
              if "USER-ALEISPH" not in p.parts} if lammps else set()
    for path in package_files():
        if path.name in theirs:
            yield path, 1, "has the name of a LAMMPS header"
        if "aleisph" not in path.name:
            yield path, 1, "does not carry the package in its name"


def rows():
    for path in package_files():
        if path.name == "aleisph_rows.h":
            continue
        for number, line in enumerate(path.read_text().splitlines(), 1):
            if ROW_LOOP.search(line):
                yield path, number, "runs over particles by hand: use for_rows, sum_rows, ..."


RULES = {"dependencies": dependencies, "style_headers": style_headers, "headers": headers,
         "ascii": ascii_only, "names": names, "rows": rows}


def main():
    if len(sys.argv) != 2 or sys.argv[1] not in RULES:
        sys.exit(__doc__)
    violations = list(RULES[sys.argv[1]]())
    for path, number, message in violations:
        print(f"{path.relative_to(TOP)}:{number}: {message}")
    sys.exit(1 if violations else 0)


if __name__ == "__main__":
    main()
