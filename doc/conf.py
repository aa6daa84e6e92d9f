# SPDX-License-Identifier: GPL-2.0-only
"""Sphinx configuration: sphinx-build -W -b html doc build/doc/html (./aleisph doc does it).

Needs nothing beyond Sphinx. Formulas are drawn by MathJax when a page is read, not when it is
built. The page names and the role :lammps: follow the manual of LAMMPS.
"""

from pygments.lexer import RegexLexer, words
from pygments.token import Comment, Keyword, Name, Number, String, Text

project = "USER-ALEISPH"
author = "the USER-ALEISPH authors"
copyright = "the USER-ALEISPH authors, GPL-2.0-only"

extensions = ["sphinx.ext.extlinks", "sphinx.ext.mathjax"]
extlinks = {"lammps": ("https://docs.lammps.org/%s.html", "%s")}
source_suffix = ".rst"
exclude_patterns = ["bench", "build"]
highlight_language = "none"

html_theme = "nature"
html_theme_options = {"sidebarwidth": 260}
html_title = "USER-ALEISPH"
html_copy_source = False
html_show_sphinx = False


class LammpsLexer(RegexLexer):
    """Enough of LAMMPS' script language to colour it."""

    name = "LAMMPS"
    aliases = ["LAMMPS"]
    commands = ("atom_style", "boundary", "comm_modify", "compute", "create_atoms", "create_box",
                "dimension", "dump", "dump_modify", "fix", "group", "lattice", "mass",
                "neigh_modify", "neighbor", "plugin", "print", "read_data", "read_restart",
                "region", "run", "thermo", "thermo_style", "timestep", "units", "unfix",
                "variable", "velocity", "write_restart")
    tokens = {
        "root": [
            (r"#.*$", Comment.Single),
            (r'"[^"]*"', String),
            (r"\$(\{[^}]*\}|\([^\n]*?\)|\w)", Name.Variable),
            (r"\b[vcf]_\w+(\[\w+\])*", Name.Variable),
            (words(commands, prefix=r"^\s*", suffix=r"\b"), Keyword),
            (r"(?<![\w/.])[-+]?\d+\.?\d*([eE][-+]?\d+)?(?![\w/.])", Number),
            (r"\s+", Text),
            (r"\S+?(?=\s|$|[$\"#])", Text),
            (r".", Text),
        ]
    }


def setup(app):
    app.add_lexer("LAMMPS", LammpsLexer)
