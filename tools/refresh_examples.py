#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Makes the reference logs, pictures and result tables of the examples anew, after a change that
alters them on purpose: refresh_examples.py [EXAMPLE...]

Runs each example as it is on 1 and on 2 ranks, in a temporary folder. Environment: ALEISPH_LMP,
ALEISPH_MPIEXEC, LAMMPS_PLUGIN_PATH, LAMMPS_POTENTIALS (`./aleisph env` prints them); LOG_DATE, the
date in the names of the logs as LAMMPS writes dates (default: today).
"""

import datetime
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

from result_table import read_results, table

EXAMPLES = Path(__file__).resolve().parents[1] / "examples"
TOOLS = Path(__file__).resolve().parent
PICTURE = re.compile(r"^python3 \.\./\.\./tools/((?:render|view)\.py) (.*)$", re.MULTILINE)
TABLE = re.compile(r"(<!-- results -->\n).*?(<!-- end -->)", re.DOTALL)


def run(example, ranks, folder):
    """Path of the log of one run."""
    launcher = [os.environ.get("ALEISPH_MPIEXEC", "mpirun"), "-np", str(ranks)] if ranks > 1 else []
    lmp = os.environ.get("ALEISPH_LMP", "lmp")
    source = EXAMPLES / example
    command = launcher + [lmp, "-in", str(source / f"in.{example}"), "-var", "here", str(source)]
    subprocess.run(command, cwd=folder, check=True, stdout=subprocess.DEVNULL)
    return folder / "log.lammps"


def store_log(log, target, example):
    """Without the places of files on this machine."""
    text = re.sub(r"^(Loaded \d+ plugins from) .*$", r"\1 LAMMPS_PLUGIN_PATH",
                  log.read_text(errors="replace"), flags=re.MULTILINE)
    target.write_text(text.replace(str(EXAMPLES / example), "."))


def draw(example, readme, folder):
    """The picture, by the command that the README gives to the reader."""
    program, arguments = PICTURE.search(readme).groups()
    words = arguments.replace("../../", f"{EXAMPLES.parent}/").split()
    subprocess.run([sys.executable, str(TOOLS / program), *words], cwd=folder, check=True)
    picture = words[1]
    (EXAMPLES / example / picture).write_bytes((folder / picture).read_bytes())


def columns(rows):
    """The table of a README, without the name of the example."""
    return "```\n" + "\n".join(table([{k: v for k, v in row.items() if k != "case"}
                                      for row in rows])) + "\n```\n"


def refresh(example):
    date = os.environ.get("LOG_DATE") or datetime.date.today().strftime("%-d%b%y")
    home = EXAMPLES / example
    for old in home.glob("log.*.g++.*"):
        old.unlink()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for ranks in (2, 1):    # the picture and the table are those of one rank
            log = run(example, ranks, folder)
            store_log(log, home / f"log.{date}.{example}.g++.{ranks}", example)
        readme = (home / "README.md").read_text()
        draw(example, readme, folder)
        rows = columns(read_results(log))
    (home / "README.md").write_text(TABLE.sub(lambda m: m[1] + rows + m[2], readme))
    print(f"{example} done")


def main():
    names = sys.argv[1:] or sorted({path.parent.name for path in EXAMPLES.glob("*/in.*")})
    for name in names:
        if not (EXAMPLES / name / f"in.{name}").exists():
            sys.exit(f"there is no example {name}\n\n{__doc__}")
        refresh(name)


if __name__ == "__main__":
    main()
