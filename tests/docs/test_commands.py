#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""The commands that the READMEs of the examples name are understood.

Each `lmp -in in.NAME -var ...`, and each `-var ...` of text and tables, runs with LAMMPS' switch
-skiprun: the scene is set up, and every command up to the measurements after the run is read, but no
time step is done. Each -var must name a variable of the script, as LAMMPS takes others without a
word.
"""

import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
PLUGIN = Path(os.environ.get("LAMMPS_PLUGIN_PATH", "")) / "aleisphplugin.so"
COMMAND = re.compile(r"^ {4}(?:mpirun -np \d+ )?lmp (-in [^#\n]*)", re.M)
OPTIONS = re.compile(r"`(-var [^`]*)`")
PLACEHOLDER = re.compile(r"\b[A-Z]{3,}")    # of a file or folder
# what a measurement says for want of a run: there are no steps and no results
NO_RUN = ("cannot be invoked before initialization by a run", ".results: No such file",
          "is accessed out-of-range")


def unknown_variables(script, arguments):
    known = set(re.findall(r"^variable\s+(\S+)\s+index", script.read_text(), re.M))
    named = [b for a, b in zip(arguments, arguments[1:]) if a == "-var"]
    return [name for name in named if name not in known]


def errors(folder, arguments):
    """What stops the script, in a copy of the repository's layout that the run may fill."""
    with tempfile.TemporaryDirectory() as root:
        for name in ("tools", "potentials", "tests"):
            (Path(root) / name).symlink_to(TOP / name)
        work = Path(root) / "examples" / folder.name
        shutil.copytree(folder, work)
        out = subprocess.run([os.environ["ALEISPH_LMP"], *arguments, "-skiprun", "-log", "none"],
                             cwd=work, text=True, check=False, stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT).stdout
    lines = re.findall(r"^ERROR.*", out, re.M)
    return [line for line in lines if not any(text in line for text in NO_RUN)]


def commands():
    """[(folder of the example, arguments of lmp)]"""
    found = []
    for readme in sorted(TOP.glob("examples/*/README.md")):
        folder, text = readme.parent, readme.read_text()
        lines = COMMAND.findall(text)
        lines += [f"-in in.{folder.name} {options}" for options in OPTIONS.findall(text)
                  if not PLACEHOLDER.search(options)]
        found += [(folder, shlex.split(line)) for line in dict.fromkeys(map(str.strip, lines))]
    return found


def check(command):
    folder, arguments = command
    found = [f"the script has no variable {name}"
             for name in unknown_variables(folder / arguments[1], arguments)]
    return [f"{folder.name}: lmp {shlex.join(arguments)}: {line}"
            for line in found + errors(folder, arguments)]


def main():
    if not PLUGIN.exists():
        print("not run: this build has no plugin")
        return
    todo = commands()
    if not todo:
        sys.exit("no commands found")
    with ThreadPoolExecutor(2) as pool:
        wrong = [line for lines in pool.map(check, todo) for line in lines]
    print("\n".join(wrong) or f"{len(todo)} commands: ok")
    sys.exit(1 if wrong else 0)


if __name__ == "__main__":
    main()
