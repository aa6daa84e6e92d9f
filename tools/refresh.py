#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Makes anew what is printed: refresh.py [examples|bench] [NAME...] [--tables]

examples: of each example (all, or those named) the logs on 1 and on 2 ranks, and in its README.md
  results  between <!-- results --> and <!-- end -->: the result lines of the log of one rank
  rows     after a comment <!-- runs ... --> up to <!-- end -->: a row for each of its lines, which
           are runs with other options. Their result lines are kept in log.runs
  pictures by the commands in the blocks ```...``` that call a program of tools/. A block with runs of
           its own (lmp ...) has a folder of its own, the others that of the run on one rank
bench: the commands in doc/bench/README.md, which write tables and pictures to doc/bench.
Runs are made in temporary folders. An example is changed when all of its runs are done; one that
fails is left as it is and named at the end. --tables: only the runs of <!-- runs -->. --check: no
runs; says where logs, tables and pictures do not belong together. --list: says what would be run.

<!-- runs
| {label} | {N} | {u.l2@0.05:.2e} | {2.u.l2:.1e} |
-var d 1e-4
-var d 5e-5 + -var d 5e-5 -var scheme cn :: 5e-5, also cn
-->
The first line is a row with {quantity.key@time:format}: key is that of the result line; a/b is the value of
a over that of b, minus 1; without @time the last one is taken. {N} is that of any result line. A number before
the quantity says which of the runs of a line, joined by +, is meant; - is no run. What follows :: is the
label, else the options are. A format may have a factor, .2f*1e3, and % is written with a space.
A comment <!-- runs, not made yet is one whose table is still by hand, since its runs are long: it is made,
and checked, from the next refresh on.

Environment: ALEISPH_LMP, ALEISPH_MPIEXEC, LAMMPS_PLUGIN_PATH (`./aleisph refresh` sets them); LOG_DATE, the date in
the names of the logs as LAMMPS writes dates (default: today).
"""

import argparse
import datetime
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

from result_table import MARK, read_results, short, table

TOP = Path(__file__).resolve().parents[1]
RESULTS = re.compile(r"(<!-- results -->\n).*?(<!-- end -->)", re.DOTALL)
PENDING = ", not made yet"
RUNS = re.compile(rf"<!-- runs({PENDING})?\n(.*?)(-->\n\|[^\n]*\n\|[-| :]*\|\n)"
                  r"((?:\|[^\n]*\n)*)(<!-- end -->)", re.DOTALL)
BLOCK = re.compile(r"^```\n((?:(?!```).*\n)*?)```$", re.MULTILINE)
PICTURE = re.compile(r"!\[[^]]*\]\(([^)/]+\.png)\)", re.DOTALL)
FIELD = re.compile(r"\{(?:(\d+)\.)?([\w-]+)(?:\.(\w+(?:/\w+)?))?(?:@([\d.e+-]+))?(?::([^}]*))?\}")
RUN = "ALEISPH-RUN"    # in log.runs, before the options and the result lines of a run
FAILED = "failed: "
NONE = "-"    # in a line of runs: none, its cells are empty
BENCH = re.compile(r"^ {4}\./aleisph bench (\w+) *([^#\n]*)", re.MULTILINE)
# what the blocks of a README find: the programs of this run, their output kept for errors only
SHELL = """set -euo pipefail
lmp() { "$ALEISH_PROGRAM" "$@" > screen.lmp || { tail -n 15 screen.lmp; return 1; }; }
python3() { "$ALEISH_PYTHON" "$@"; }
""".replace("ALEISH_", "ALEISPH_REFRESH_")


@dataclass
class Example:
    """A folder with a script in.NAME and a README.md."""
    folder: Path

    @property
    def name(self):
        return self.folder.name

    @property
    def readme(self):
        return (self.folder / "README.md").read_text()

    def log(self, ranks):
        """The stored log; an error if there is not exactly one."""
        found = sorted(self.folder.glob(f"log.*.{self.name}.g++.{ranks}"))
        if len(found) != 1:
            raise ValueError(f"{len(found)} logs of {ranks} ranks, not one")
        return found[0]


def examples(names, top=TOP):
    found = {path.parent.name: Example(path.parent) for path in sorted(top.glob("examples/*/in.*"))
             if path.name == f"in.{path.parent.name}"}
    for name in names:
        if name not in found:
            sys.exit(f"there is no example {name}; there are {' '.join(found)}")
    return [found[name] for name in names or found]


# --- runs -------------------------------------------------------------------------------------------

class Workshop:
    """A temporary copy of the layout of the sources, in which examples run as they are."""

    def __init__(self, root, top=TOP):
        self.root = Path(root)
        self.count = 0
        for name in ("tools", "tests", "potentials"):
            if (top / name).exists():
                (self.root / name).symlink_to(top / name)

    def folder(self, example):
        """A new copy of an example."""
        self.count += 1
        place = self.root / f"run{self.count}" / example.name    # so ../../tools is there
        shutil.copytree(example.folder, place,
                        ignore=shutil.ignore_patterns("log.*", "*.png", "README*"))
        return place


def program():
    return os.environ.get("ALEISPH_LMP") or "lmp"


def run(folder, example, options=(), ranks=1):
    """Path of the log."""
    starter = [os.environ.get("ALEISPH_MPIEXEC") or "mpirun", "-np", str(ranks)] if ranks > 1 else []
    command = [*starter, program(), "-in", f"in.{example.name}", *options]
    done = subprocess.run(command, cwd=folder, text=True, check=False, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT)
    if done.returncode:
        errors = re.findall(r"^ERROR.*", done.stdout, re.MULTILINE) or done.stdout.splitlines()[-1:]
        raise RuntimeError(f"{' '.join(command[len(starter) + 1:])}: {' '.join(errors[:1])}")
    return folder / "log.lammps"


def stored_text(log):
    """A log without the places of files on this machine."""
    return re.sub(r"^(Loaded \d+ plugins from) .*$", r"\1 LAMMPS_PLUGIN_PATH",
                  log.read_text(errors="replace"), flags=re.MULTILINE)


def recipes(readme):
    """[(block, whether it has runs of its own)] of those that draw."""
    blocks = [block for block in BLOCK.findall(readme)
              if re.search(r"^python3 \.\./\.\./tools/", block, re.MULTILINE)]
    return [(block, bool(re.search(r"(?:^|[\s(;])lmp -in", block))) for block in blocks]


def cook(block, folder):
    """Runs a block; {name: bytes} of the pictures that it drew."""
    environment = {**os.environ, "ALEISPH_REFRESH_PROGRAM": program(),
                   "ALEISPH_REFRESH_PYTHON": sys.executable}
    before = set(folder.glob("*.png"))
    done = subprocess.run(["bash", "-c", SHELL + block], cwd=folder, env=environment, text=True,
                          check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode:
        raise RuntimeError(f"{block}ended with\n{done.stdout[-2000:]}")
    print(done.stdout, end="")
    return {path.name: path.read_bytes() for path in set(folder.glob("*.png")) - before}


# --- tables -----------------------------------------------------------------------------------------

def result_block(rows):
    """The table of results of a README, without the name of the example."""
    return "```\n" + "\n".join(table([{k: v for k, v in row.items() if k != "case"}
                                      for row in rows])) + "\n```\n"


@dataclass
class Line:
    """A line of a comment <!-- runs ... -->: the options of its runs, and the label of its row."""
    options: list
    label: str


def parse_runs(text):
    """(template of a row, [Line])"""
    template, *lines = text.strip().splitlines()
    if not template.startswith("|"):
        raise ValueError(f"<!-- runs: '{template}' is no row")
    found = []
    for line in lines:
        options, _, label = (word.strip() for word in line.partition("::"))
        runs = [run.strip() for run in re.split(r" \+ ", options)]
        found.append(Line(runs, label or f"`{options}`"))
    return template, found


def options_of(readme, pending=True):
    """All options that the comments of a README ask for, each once; pending: also of tables that are
    not made yet."""
    lines = [line for match in RUNS.finditer(readme) if pending or not match[1]
             for line in parse_runs(match[2])[1]]
    return list(dict.fromkeys(option for line in lines for option in line.options if option != NONE))


def read_runs(path):
    """{options: rows of results, or what has failed} of a log.runs."""
    runs = {}
    if path.exists():
        for part in path.read_text().split(RUN + " ")[1:]:
            head, _, body = part.partition("\n")
            if body.startswith(FAILED):
                runs[head] = body.strip()
            else:
                runs[head] = [dict(item.split("=", 1) for item in line.split()[1:])
                              for line in body.splitlines() if line.startswith(MARK)]
    return runs


def runs_text(runs):
    """The text of a log.runs, of {options: rows}."""
    lines = ["# Made by ./aleisph refresh: result lines of the runs named in README.md"]
    for options, rows in runs.items():
        lines.append(f"{RUN} {options}")
        lines += [rows] if isinstance(rows, str) else [
            " ".join([MARK, *(f"{key}={value}" for key, value in row.items())]) for row in rows]
    return "\n".join(lines) + "\n"


def pick(rows, quantity, key, time):
    """A value of result lines as text, "" if there is none."""
    if key is None:
        return next((row[quantity] for row in rows if quantity in row), "")
    rows = [row for row in rows if row["quantity"] == quantity]
    if time is not None:
        rows = [row for row in rows if abs(float(row["time"]) - float(time)) <= 1e-6 * float(time)]
    if not rows:
        return ""
    over, _, under = key.partition("/")
    if not under:
        return rows[-1].get(key, "")
    values = [float(rows[-1].get(name, "nan")) for name in (over, under)]
    return str(values[0] / values[1] - 1.0) if values[1] else ""


def shown(text, form):
    """A number in a format of Python, exponents without leading zeros."""
    if not text or not form:
        return short(text) if text else ""
    form, _, factor = form.partition("*")
    words = format(float(text) * float(factor or 1), form)
    words = re.sub(r"e([+-])0*(\d)", lambda m: "e" + m[1].strip("+") + m[2], words)
    return words.replace("%", " %")


def row_of(template, line, runs):
    def value(match):
        number, quantity, key, time, form = match.groups()
        if quantity == "label":
            return line.label
        options = line.options[int(number or 1) - 1]
        if options == NONE:
            return ""
        rows = runs[options]
        return "fails" if isinstance(rows, str) else shown(pick(rows, quantity, key, time), form)
    return FIELD.sub(value, template)


def with_tables(readme, rows, runs):
    """The README with its tables made anew."""
    def filled(match):
        template, lines = parse_runs(match[2])
        if match[1] and not all(option in runs for option in options_of(match[0])):
            return match[0]
        body = "".join(row_of(template, line, runs) + "\n" for line in lines)
        return (f"<!-- runs\n{match[2]}{match[3]}" + re.sub(r"\| +(?=\|)", "| ", body)
                + match[5])
    return RUNS.sub(filled, RESULTS.sub(lambda m: m[1] + result_block(rows) + m[2], readme))


# --- examples ---------------------------------------------------------------------------------------

def run_or_failure(place, example, options):
    try:
        return read_results(run(place, example, shlex.split(options)))
    except RuntimeError as problem:
        print(f"{example.name}: {problem}", file=sys.stderr)
        return FAILED + str(problem).splitlines()[0]


def remake_tables(example, workshop, log):
    """{name of file: content} of what tables are made of; log: of the run on one rank."""
    readme = example.readme
    runs = {options: run_or_failure(workshop.folder(example), example, options)
            for options in options_of(readme)}
    files = {"README.md": with_tables(readme, read_results(log), runs).encode()}
    if runs:
        files["log.runs"] = runs_text(runs).encode()
    return files


def remake(example, workshop):
    """{name of file: content} of all that belongs to an example."""
    date = os.environ.get("LOG_DATE") or datetime.date.today().strftime("%-d%b%y")
    files = {}
    for ranks in (2, 1):    # pictures and results are those of one rank
        place = workshop.folder(example)
        log = run(place, example, ranks=ranks)
        files[f"log.{date}.{example.name}.g++.{ranks}"] = stored_text(log).encode()
    for block, own in recipes(example.readme):
        files.update(cook(block, workshop.folder(example) if own else place))
    return {**files, **remake_tables(example, workshop, log)}


def refresh_example(example, tables_only=False, top=TOP):
    with tempfile.TemporaryDirectory() as root:
        workshop = Workshop(root, top)
        files = (remake_tables(example, workshop, example.log(1)) if tables_only
                 else remake(example, workshop))
    for old in [] if tables_only else example.folder.glob("log.*.g++.*"):
        old.unlink()
    for name, content in files.items():
        (example.folder / name).write_bytes(content)
    print(f"{example.name}: {len(files)} files", flush=True)


def unknown_variables(example):
    """Names after -var that the script does not know; LAMMPS takes them without a word."""
    script = (example.folder / f"in.{example.name}").read_text()
    known = set(re.findall(r"^variable\s+(\S+)\s+index", script, re.MULTILINE))
    readme = example.readme
    texts = options_of(readme) + [block for block, own in recipes(readme) if own]
    named = re.findall(r"-var\s+([\w-]+)", "\n".join(texts))
    return sorted(set(named) - known)


def check_example(example):
    """What does not belong together."""
    readme = example.readme
    rows = []
    try:
        logs = [example.log(ranks) for ranks in (1, 2)]
        if len({log.name[:-1] for log in logs}) != 1:
            yield "the logs of 1 and 2 ranks have different dates"
        for log in logs:
            if "Total wall time" not in log.read_text(errors="replace"):
                yield f"{log.name} has no end"
        rows = read_results(logs[0])
    except ValueError as problem:
        yield str(problem)
    if len(RESULTS.findall(readme)) != 1:
        yield "not one table between <!-- results --> and <!-- end -->"
    runs = read_runs(example.folder / "log.runs")
    options = set(options_of(readme, pending=False))
    if set(runs) != options:
        yield f"log.runs has other runs than README.md: {set(runs) ^ options}"
    elif rows:
        wanted = with_tables(readme, rows, runs).splitlines()
        for number, (line, right) in enumerate(zip(readme.splitlines(), wanted), 1):
            if line != right:
                yield f"README.md:{number} has\n    {line}\n  its log\n    {right}"
                break
        else:
            if len(wanted) != len(readme.splitlines()):
                yield "a table has not as many lines as its log"
    if readme.count("<!-- runs") != len(RUNS.findall(readme)):
        yield "a comment <!-- runs is not followed by a table and <!-- end -->"
    for name in unknown_variables(example):
        yield f"README.md uses -var {name}, which in.{example.name} does not know"
    named = set(PICTURE.findall(readme))
    drawn = {word for block, _ in recipes(readme) for word in shlex.split(block, comments=True)
             if word.endswith(".png")}
    there = {path.name for path in example.folder.glob("*.png")}
    for what, names in (("is not shown", there - named), ("does not exist", named - there),
                        ("is drawn by no command", named - drawn)):
        for name in sorted(names):
            yield f"{name} {what}"


# --- benchmarks -------------------------------------------------------------------------------------

def bench_commands(names, top=TOP):
    """[(name, arguments)] as doc/bench/README.md has them."""
    found = [(name, shlex.split(arguments)) for name, arguments in
             BENCH.findall((top / "doc/bench/README.md").read_text())]
    for name in names:
        if name not in dict(found):
            sys.exit(f"doc/bench/README.md has no ./aleisph bench {name}; it has "
                     f"{' '.join(dict(found))}")
    return [pair for pair in found if not names or pair[0] in names]


def refresh_bench(name, arguments, top=TOP):
    command = [sys.executable, str(top / "bench" / f"{name}.py"), *arguments]
    if subprocess.run(command, cwd=top, check=False).returncode:
        raise RuntimeError(f"bench {name} failed")


# --- the command ------------------------------------------------------------------------------------

def check(names, top=TOP):
    """Exit status."""
    wrong = [f"{example.name}: {line}" for example in examples(names, top)
             for line in check_example(example)]
    print("\n".join(wrong) or "logs, tables and pictures belong together")
    pending = [e.name for e in examples(names, top) if f"<!-- runs{PENDING}" in e.readme]
    if pending:
        print(f"not checked: tables whose runs are not made yet, of {', '.join(pending)}")
    return 1 if wrong else 0


def refresh(what, names, tables_only=False, top=TOP):
    """Exit status."""
    failed = []
    jobs = []
    if what != "bench":
        jobs += [(e.name, lambda e=e: refresh_example(e, tables_only, top))
                 for e in examples(names, top)]
    if what != "examples":
        jobs += [(f"bench {n}", lambda n=n, a=a: refresh_bench(n, a, top))
                 for n, a in bench_commands(names, top)]
    for name, job in jobs:
        try:
            job()
        except (OSError, RuntimeError, ValueError) as problem:
            print(f"{name}: {problem}", file=sys.stderr, flush=True)
            failed.append(name)
    if failed:
        print(f"left as they were: {', '.join(failed)}", file=sys.stderr)
    return 1 if failed else 0


def listing(what, names):
    if what != "bench":
        for example in examples(names):
            own = sum(own for _, own in recipes(example.readme))
            print(f"{example.name}: 2 ranks, 1 rank, {len(options_of(example.readme))} runs for "
                  f"tables, {own} blocks with runs for pictures")
    if what != "examples":
        for name, arguments in bench_commands(names):
            print(f"bench {name} {' '.join(arguments)}")
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", nargs="?", choices=("examples", "bench"), help="default: both")
    parser.add_argument("names", nargs="*", help="default: all")
    group = parser.add_mutually_exclusive_group()
    group.add_argument("--check", action="store_true", help="no runs: do the files fit together?")
    group.add_argument("--list", action="store_true", help="no runs: say what would be run")
    group.add_argument("--tables", action="store_true",
                       help="of examples, only the runs of <!-- runs -->")
    options = parser.parse_intermixed_args()
    if options.tables:
        options.what = "examples"
    if options.check:
        sys.exit(check(options.names if options.what != "bench" else []))
    if options.list:
        sys.exit(listing(options.what, options.names))
    sys.exit(refresh(options.what, options.names, options.tables))


if __name__ == "__main__":
    main()
