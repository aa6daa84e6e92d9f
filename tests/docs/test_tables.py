#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Tables and pictures in the READMEs of the examples are those of the stored logs (tools/refresh.py
--check), and each benchmark that doc/bench/README.md names exists and has left a table there."""

import sys

import refresh
from refresh import TOP


def bench_faults():
    commands = refresh.bench_commands([])
    if not commands:
        yield "doc/bench/README.md names no command ./aleisph bench"
    for name, arguments in commands:
        if not (TOP / "bench" / f"{name}.py").exists():
            yield f"doc/bench/README.md names bench {name}, which does not exist"
        if not (TOP / "doc/bench" / f"{name}.md").exists():
            yield f"doc/bench has no {name}.md"
        if arguments[-2:] != ["--out", "doc/bench"]:
            yield f"bench {name}: the command in doc/bench/README.md does not write to doc/bench"
    for script in TOP.glob("bench/*.py"):
        if script.stem not in dict(commands):
            yield f"doc/bench/README.md has no command for bench {script.stem}"


def main():
    faults = list(bench_faults())
    print("\n".join(faults))
    sys.exit(max(refresh.check([]), len(faults) > 0))


if __name__ == "__main__":
    main()
