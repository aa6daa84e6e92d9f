# SPDX-License-Identifier: GPL-2.0-only
"""Runs the examples in coarse and short form, as the regression tests need them.

The program, the MPI starter and the plugin come from the environment (cmake/AleisphTests.cmake).
"""

import os
import re
import shutil
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

from result_table import read_results

TOP = Path(os.environ.get("ALEISPH_SOURCE_DIR", Path(__file__).resolve().parents[2]))
HERE = Path(__file__).resolve().parent
TIMEOUT = 120


@dataclass
class Case:
    """A short run of an example: variables for the command line, and bounds on its result lines.

    bounds: {(quantity, key): largest value} that the last line of each quantity must obey.
    """
    example: str
    variables: dict
    bounds: dict = field(default_factory=dict)

    def dump(self):
        return f"dump.{self.example}"


def command(ranks):
    lmp = os.environ.get("ALEISPH_LMP") or "lmp"
    if ranks == 1:
        return [lmp]
    return [os.environ.get("ALEISPH_MPIEXEC") or "mpirun", "-np", str(ranks), lmp]


def run_lammps(script, folder, variables, ranks=1, good=True):
    """Runs a script in its folder; returns the path of the log."""
    words = command(ranks) + ["-in", str(script), "-log", "log.lammps", "-nocite"]
    for name, value in variables.items():
        words += ["-var", name] + str(value).split()
    done = subprocess.run(words, cwd=folder, text=True, check=False, timeout=TIMEOUT,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if good and done.returncode != 0:
        tail = "\n".join(done.stdout.splitlines()[-15:])
        raise RuntimeError(f"{' '.join(words)}\nended with status {done.returncode}:\n{tail}")
    return Path(folder) / "log.lammps"


def edit(path, changes):
    """Replaces, in a script, the one line that each regular expression matches."""
    text = path.read_text()
    for pattern, line in changes.items():
        text, count = re.subn(f"^{pattern}$", line, text, flags=re.MULTILINE)
        if count != 1:
            raise RuntimeError(f"{path} has {count} lines '{pattern}', expected one")
    path.write_text(text)


# LAMMPS numbers created atoms rank by rank; numbers by place are the same for any number of ranks
NUMBER_BY_PLACE = {"(fix +sph .*)": "reset_atoms id sort yes\n\\1"}


def empty_folder(name):
    shutil.rmtree(name, ignore_errors=True)
    Path(name).mkdir()
    return Path(name)


def run_case(name, case, variant="1", ranks=1, changes=None):
    """Runs a case in a folder of its own; returns (dump, rows of results)."""
    folder = Path(f"{name}-{variant}")
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(TOP / "examples" / case.example, folder,
                    ignore=shutil.ignore_patterns("log.*", "*.png", "README*"))
    script = f"in.{case.example}"
    edit(folder / script, {**NUMBER_BY_PLACE, **(changes or {})})
    log = run_lammps(script, folder, case.variables, ranks)
    return folder / case.dump(), read_results(log)
