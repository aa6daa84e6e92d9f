#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""The script of the Howto runs and gives the errors that Accuracy.rst quotes for it.

The flow leaves the pressure solver nothing to do, so that the errors are reproducible to
rounding: the tolerance is that of the three digits printed.
"""

import math
import os
import re
import subprocess
import sys
from pathlib import Path

DOC = Path(__file__).resolve().parents[2] / "doc"
PLUGIN = Path(os.environ.get("LAMMPS_PLUGIN_PATH", "")) / "aleisphplugin.so"
PRINTED = 5.0e-3

# what is set on the command line, and the error at the end; as in the tables of Accuracy.rst
RUNS = [({"n": 10, "vn": 0.1}, "1.79e-3"),
        ({"n": 20, "vn": 0.1}, "5.02e-4"),
        ({"n": 20, "vn": 0.2}, "5.37e-5"),
        ({"n": 20, "vn": 0.3}, "4.01e-4"),
        ({"n": 10, "vn": 0.1, "integrator": "ab2"}, "3.59e-3"),
        ({"n": 20, "vn": 0.1, "integrator": "ab2"}, "9.55e-4"),
        ({"n": 20, "vn": 1, "scheme": "cn"}, "9.36e-4"),
        ({"n": 40, "vn": 1, "scheme": "cn"}, "2.45e-4"),
        ({"n": 20, "vn": 1, "scheme": "be"}, "5.43e-3")]


def last_error(variables):
    """The last column of the last line of thermo output."""
    command = [os.environ["ALEISPH_LMP"], "-in", str(DOC / "in.channel"), "-var", "T", "0.1"]
    for name, value in variables.items():
        command += ["-var", name, str(value)]
    out = subprocess.run(command, text=True, check=False, stdout=subprocess.PIPE,
                         stderr=subprocess.STDOUT).stdout
    rows = re.search(r"^ +Step .*\n((?:[ \d.e+-]+\n)+)", out, re.M)
    if not rows:
        sys.exit(f"{' '.join(command)}\nprinted no result:\n{out[-2000:]}")
    return float(rows[1].split()[-1])


def main():
    if not PLUGIN.exists():
        print("not run: this build has no plugin")
        return
    table = (DOC / "Accuracy.rst").read_text()
    wrong = []
    for variables, quoted in RUNS:
        error = last_error(variables)
        print(variables, quoted, error)
        if not math.isclose(error, float(quoted), rel_tol=PRINTED):
            wrong.append(f"{variables}: error {error}, Accuracy.rst says {quoted}")
        if quoted not in table:
            wrong.append(f"{variables}: Accuracy.rst has no {quoted}")
    if wrong:
        sys.exit("\n".join(wrong))


if __name__ == "__main__":
    main()
