# SPDX-License-Identifier: GPL-2.0-only
"""Example scripts with more options and measurements than their variables offer.

A copy of the script of an example is changed: options are added to one of its fixes, words of a fix
are replaced, lines go in before the run. What is changed must be there; else it is an error.
"""

import re
from pathlib import Path

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
RUN = "label compare"  # in all examples, the line before the first time step


def script(case):
    return (EXAMPLES / case / f"in.{case}").read_text(encoding="ascii")


def with_exact_time(case, folder):
    """Path of a copy of the script, in the folder, that prints its run time to microseconds."""
    text, old = script(case), "seconds=$(v_t1-v_t0:%.2f)"
    if old not in text:
        raise ValueError(f"in.{case} prints no {old}")
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / f"in.{case}"
    path.write_text(text.replace(old, "seconds=$(v_t1-v_t0:%.6f)"), encoding="ascii")
    return path


def fix_pattern(name):
    """A fix with its continued lines; LAMMPS joins a line that ends in & with the next."""
    return re.compile(rf"^fix +{re.escape(name)} (?:.*&\n)*.*$", re.M)


def find_fix(text, name):
    found = fix_pattern(name).search(text)
    if not found:
        raise ValueError(f"the script has no fix {name}")
    return found


def with_options(text, name, options):
    """Adds words to a fix."""
    found = find_fix(text, name)
    return text[:found.end()] + " " + options + text[found.end():]


def with_words(text, name, old, new):
    """Replaces words of a fix."""
    found = find_fix(text, name)
    if old not in found[0]:
        raise ValueError(f"fix {name} has no words '{old}'")
    return text[:found.start()] + found[0].replace(old, new) + text[found.end():]


def bare_fix(text, name):
    """Leaves a fix its ID, group and style only."""
    found = find_fix(text, name)
    return text[:found.start()] + " ".join(found[0].split()[:4]) + text[found.end():]


def with_first_step(text, step):
    """Another time step to begin with; in it, v_most is that of the script."""
    found = re.search(r"^timestep +\$(\(.*\))$", text, re.M)
    if not found:
        raise ValueError("the script has no timestep with a formula")
    lines = f"variable most equal {found[1]}\ntimestep {step}"
    return text[:found.start()] + lines + text[found.end():]


def before_run(text, lines):
    words = re.compile(r"^" + r" +".join(RUN.split()) + r"$", re.M)
    found = words.search(text)
    if not found:
        raise ValueError(f"the script has no line '{RUN}'")
    return text[:found.start()] + "\n".join(lines) + "\n" + text[found.start():]
