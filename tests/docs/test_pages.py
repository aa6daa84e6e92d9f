#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""The documentation says what the sources do. Needs no Sphinx. Checked:

pages      every FixStyle and ComputeStyle has a page with LAMMPS' sections, listed in index.rst
keywords   every word that a style compares its arguments with stands on its page
vectors    the page numbers the components of a global vector from 1 to size_vector
errors     every message of the package stands on the page Errors_aleisph.rst
readme     README.md names every style and every example; its pictures and links exist
files      the Howto says where every source file belongs
contribute CONTRIBUTING.md names only files, classes and functions that exist
ascii      the pages are plain ASCII, in lines of at most 100 characters
Prints what is missing; the exit status is 1 if there is anything.
"""

import fnmatch
import re
import sys
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
PACKAGE = TOP / "src" / "USER-ALEISPH"
DOC = TOP / "doc"
README = TOP / "README.md"

FIX_SECTIONS = ("Syntax", "Examples", "Description",
                "Restart, fix_modify, output, run start/stop, minimize info",
                "Restrictions", "Related commands", "Default")
COMPUTE_SECTIONS = ("Syntax", "Examples", "Description", "Output info", "Restrictions",
                    "Related commands", "Default")
# names that a style takes from a table of the numerics
TABLES = {"fix_aleisph": ["aleisph_kernel.cpp", "aleisph_fluid.cpp"],
          "fix_aleisph_ppe": ["aleisph_solve_precond.cpp"],
          "fix_aleisph_predictor": ["aleisph_solve_precond.cpp"]}

LITERALS = re.compile(r'"(?:[^"\\\n]|\\.)*"(?:\s*"(?:[^"\\\n]|\\.)*")*')
WORD = re.compile(r"[a-z0-9][a-z0-9/-]*")
MESSAGE = re.compile(r"(?:Fix|Compute) aleisph[/a-z]*:? .+", re.DOTALL)


def styles():
    """{page name: (kind, style name)} from the macros of the headers."""
    found = {}
    for header in sorted(PACKAGE.glob("*.h")):
        for kind, name in re.findall(r"^(Fix|Compute)Style\(([^,]+),", header.read_text(), re.M):
            found[header.stem] = (kind.lower(), name)
    return found


def literals(path):
    """String literals of a source file; adjacent ones are joined, as the compiler does."""
    text = re.sub(r"//[^\n]*|/\*.*?\*/|^#include.*?$", "", path.read_text(), flags=re.S | re.M)
    for match in LITERALS.finditer(text):
        yield "".join(re.findall(r'"((?:[^"\\]|\\.)*)"', match[0])), text[:match.start()]


def page(name):
    path = DOC / f"{name}.rst"
    return path.read_text() if path.exists() else ""


def sections(text):
    lines = text.splitlines()
    return [a for a, b in zip(lines, lines[1:]) if a and re.fullmatch(r'"+', b)]


def check_pages():
    index = page("index")
    for name, (kind, style) in styles().items():
        text = page(name)
        if not text:
            yield f"{name}.rst does not exist: {kind} {style} is not documented"
            continue
        title = f"{kind} {style} command"
        if f"{title}\n{'=' * len(title)}\n" not in text:
            yield f"{name}.rst has no title '{title}'"
        wanted = list(FIX_SECTIONS if kind == "fix" else COMPUTE_SECTIONS)
        if sections(text) != wanted:
            yield f"{name}.rst has the sections {sections(text)}, not {wanted}"
        if f"\n   {name}\n" not in index:
            yield f"{name} is not listed in index.rst"


def words_of(name):
    for source in [f"{name}.cpp"] + TABLES.get(name, []):
        for literal, _ in literals(PACKAGE / source):
            if WORD.fullmatch(literal):
                yield literal


def check_keywords():
    for name in styles():
        text = page(name)
        for word in sorted(set(words_of(name))):
            if not re.search(rf"(?<![\w/-]){re.escape(word)}(?![\w/-])", text):
                yield f"{name}.rst does not mention '{word}'"


def check_vectors():
    for name in styles():
        size = re.search(r"size_vector = (\d+);", (PACKAGE / f"{name}.cpp").read_text())
        wanted = [str(n + 1) for n in range(int(size[1]))] if size else []
        rows = re.findall(r"^   \* - (\d+)$", page(name), re.M)
        if styles()[name][0] == "fix" and rows != wanted:
            yield f"{name}.rst explains the components {rows} of the vector, not {wanted}"
        if size and f"vector of length {size[1]}" not in " ".join(page(name).split()):
            yield f"{name}.rst does not say that the vector has length {size[1]}"


def messages():
    for source in sorted(PACKAGE.glob("*.cpp")):
        for literal, before in literals(source):
            raised = re.search(r"error->\w+\(\s*FLERR,\s*$", before)
            if (raised and " " in literal) or MESSAGE.fullmatch(literal):
                yield source.stem, literal


def plain(message):
    """Without format specifications and line breaks."""
    return " ".join(re.sub(r"\{[^}]*\}", "{}", message).split())


def check_errors():
    known = " ".join(page("Errors_aleisph").split())
    for name, message in messages():
        if plain(message) not in known:
            yield f"Errors_aleisph.rst has no '{plain(message)}' ({name}.cpp)"


def check_readme():
    text = README.read_text()
    for kind, style in styles().values():
        if f"{kind} {style}" not in text:
            yield f"README.md does not name {kind} {style}"
    for script in sorted(TOP.glob("examples/*/in.*")):
        if script.parent.name not in text:
            yield f"README.md does not name the example {script.parent.name}"
    for target in re.findall(r"\]\((?!https?:)([^)]+)\)", text):
        if not (TOP / target).exists():
            yield f"README.md refers to {target}, which does not exist"


def check_files():
    """The first column of the table "Where things are": names of files, with * for any ending."""
    table = page("Howto_aleisph").split("Where things are\n", 1)[-1]
    cells = re.findall(r"^   \* - (.*(?:\n {7}.*)*)", table, re.M)
    named = {word.strip("`") for cell in cells for word in re.split(r"[,\s]+", cell)}
    for name in sorted({path.stem for path in PACKAGE.iterdir()}):
        if not any(fnmatch.fnmatchcase(name, pattern) for pattern in named):
            yield f"Howto_aleisph.rst does not say where {name} belongs"


def check_contributing():
    text = (TOP / "CONTRIBUTING.md").read_text()
    new = re.findall(r"new files?\s+`([^`]+)`", text)
    sources = list(PACKAGE.iterdir()) + sorted((TOP / "tests" / "numerics").glob("*.h"))
    code = "\n".join(path.read_text() for path in sources)
    for word in sorted(set(re.findall(r"`([^`\s]+)`", text)) - set(new)):
        if re.fullmatch(r"(fix_|compute_)?aleisph_\w*(\*|\.(h|cpp|\*))", word):
            found = list(PACKAGE.glob(word.replace("NAME", "*")))
        elif re.match(r"(tests|examples|doc|src|bench|tools|plugin|cmake)/[^<]*$", word):
            found = list(TOP.glob(word.rstrip("/")))
        elif re.fullmatch(r"[\w:]+\(\w*\)|[A-Z]\w*(::\w+)?", word):
            found = re.search(rf"\b{re.split('::', word.split('(')[0])[-1]}\b", code)
        else:
            continue
        if not found:
            yield f"CONTRIBUTING.md names {word}, which does not exist"


def check_ascii():
    for path in sorted(DOC.glob("*.rst")) + [README]:
        for number, line in enumerate(path.read_bytes().splitlines(), 1):
            if any(byte > 126 for byte in line):
                yield f"{path.name}:{number} is not plain ASCII"
            if path != README and len(line) > 100:
                yield f"{path.name}:{number} has {len(line)} characters"


def main():
    if not styles() or not list(messages()):
        sys.exit(f"no styles or no messages found in {PACKAGE}")
    checks = (check_pages, check_keywords, check_vectors, check_errors, check_readme, check_files,
              check_contributing, check_ascii)
    missing = [line for check in checks for line in check()]
    print("\n".join(missing) or f"{len(styles())} styles, {len(list(messages()))} messages: ok")
    sys.exit(1 if missing else 0)


if __name__ == "__main__":
    main()
