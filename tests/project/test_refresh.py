#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""tools/refresh.py on two small examples and a program in place of LAMMPS: what it writes, what it leaves
alone when a run fails, and that --check finds what does not belong together."""

import contextlib
import io
import os
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import refresh

# prints a result line that depends on -var n and on the number of ranks; fails with -var bad
LMP = """#!/bin/sh
n=4
for word in "$@"; do
  [ "$last" = n ] && n=$word
  [ "$word" = bad ] && echo "ERROR: bad (src/x.cpp:1)" && exit 1
  last=$word
done
[ -e broken ] && exit 1
cat > log.lammps <<END
Loaded 1 plugins from $PWD
ALEISPH-RESULT case=a quantity=u time=0.5 l2=${n}.0e-03 value=0.99 reference=1 N=$n ranks=${RANKS:-1}
ALEISPH-RESULT case=a quantity=u time=1 l2=${n}.5e-03 value=1.01 reference=1 N=$n ranks=${RANKS:-1}
Total wall time: 0:00:01
END
echo dump $n > dump.a
"""
MPI = '#!/bin/sh\nRANKS=$2; export RANKS; shift 2; exec "$@"\n'
DRAW = "import sys\nopen(sys.argv[2], 'w').write(open(sys.argv[1]).read())\n"
README = """# An example

![picture](a.png)
![another](b.png)

```
python3 ../../tools/draw.py dump.a a.png
```

```
lmp -in in.a -var n 7
python3 ../../tools/draw.py dump.a b.png
```

<!-- results -->
<!-- end -->

<!-- runs
| {label} | {N} | {u.l2@0.5:.1e} | {2.u.value/reference:+.1%} |
-var n 2 + -var n 3 :: two
-var n 9 + -
-->
| run | N | l2 | error |
|---|---|---|---|
| old | | | |
<!-- end -->

The end.
"""
TABLE = """| run | N | l2 | error |
|---|---|---|---|
| two | 2 | 2.0e-3 | +1.0 % |
| `-var n 9 + -` | 9 | 9.0e-3 | |
<!-- end -->

The end.
"""


class Refresh(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.top = Path(folder.name)
        for name in "ab":
            self.file(f"examples/{name}/in.{name}", "variable n index 4\nrun 1\n")
            self.file(f"examples/{name}/README.md", README.replace("in.a", f"in.{name}"))
            self.file(f"examples/{name}/log.1Jan20.{name}.g++.1", "old\n")
        self.file("tools/draw.py", DRAW)
        self.file("doc/bench/README.md", "    ./aleisph bench one --out doc/bench  # long\n"
                                         "    ./aleisph bench two --full --out doc/bench\n")
        for name in ("one", "two"):
            self.file(f"bench/{name}.py", "import sys\nopen('ran', 'a').write(' '.join(sys.argv[1:])"
                                          " + '\\n')\nsys.exit('--full' in sys.argv)\n")
        variables = {"ALEISPH_LMP": str(self.file("lmp", LMP, 0o755)), "LOG_DATE": "2Jan20",
                     "ALEISPH_MPIEXEC": str(self.file("mpirun", MPI, 0o755))}
        patch = mock.patch.dict(os.environ, variables)
        patch.start()
        self.addCleanup(patch.stop)

    def file(self, name, text, mode=0o644):
        path = self.top / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        path.chmod(mode)
        return path

    def text(self, name, example="a"):
        return (self.top / "examples" / example / name).read_text()

    def files(self, example):
        folder = self.top / "examples" / example
        return {path.name: path.read_text() for path in folder.iterdir()}

    def quiet(self, work, *arguments, **more):
        """(status, what was printed)"""
        out = io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(out):
            return work(*arguments, **more), out.getvalue()

    def refresh(self, what="examples", names=("a",), **more):
        return self.quiet(refresh.refresh, what, list(names), top=self.top, **more)

    def check(self):
        return self.quiet(refresh.check, ["a"], self.top)

    def test_one_example(self):
        other = self.files("b")
        self.assertEqual(self.refresh()[0], 0)
        self.assertEqual(set(self.files("a")), {
            "in.a", "README.md", "a.png", "b.png", "log.runs", "log.2Jan20.a.g++.1",
            "log.2Jan20.a.g++.2"})
        self.assertIn("Loaded 1 plugins from LAMMPS_PLUGIN_PATH", self.text("log.2Jan20.a.g++.2"))
        self.assertIn("ranks=2", self.text("log.2Jan20.a.g++.2"))
        self.assertEqual((self.text("a.png"), self.text("b.png")), ("dump 4\n", "dump 7\n"))
        readme = self.text("README.md")
        self.assertTrue(readme.endswith(TABLE), readme)
        self.assertIn("      u     1    0.0045", readme)
        self.assertEqual(self.check()[0], 0)
        self.assertEqual(self.files("b"), other)

    def test_again_changes_nothing(self):
        self.refresh()
        before = self.files("a")
        self.refresh()
        self.assertEqual(self.files("a"), before)

    def test_tables_only(self):
        self.refresh()
        log, picture = self.text("log.2Jan20.a.g++.1"), self.file("examples/a/a.png", "mine")
        self.file("examples/a/README.md", self.text("README.md").replace("-var n 9", "-var n 8"))
        self.assertEqual(self.check()[0], 1)    # log.runs has no such run
        self.assertEqual(self.refresh(tables_only=True)[0], 0)
        self.assertIn("| `-var n 8 + -` | 8 | 8.0e-3 | |", self.text("README.md"))
        self.assertEqual((self.text("log.2Jan20.a.g++.1"), picture.read_text()), (log, "mine"))
        self.assertEqual(self.check()[0], 0)

    def test_a_run_that_fails_leaves_the_example_as_it_is(self):
        self.file("examples/a/broken", "")
        before = self.files("a")
        status, said = self.refresh(names=())
        self.assertEqual(status, 1)
        self.assertIn("left as they were: a", said)
        self.assertEqual(self.files("a"), before)
        self.assertIn("log.runs", self.files("b"))    # the others are made all the same

    def test_a_picture_that_fails(self):
        self.file("tools/draw.py", "raise SystemExit('no dump')\n")
        before = self.files("a")
        status, said = self.refresh()
        self.assertEqual(status, 1)
        self.assertIn("no dump", said)
        self.assertEqual(self.files("a"), before)

    def test_a_row_whose_run_fails(self):
        self.file("examples/a/README.md", README.replace("-var n 9", "-var n bad"))
        status, said = self.refresh()
        self.assertEqual(status, 0)
        self.assertIn("ERROR: bad", said)
        self.assertIn("| `-var n bad + -` | fails | fails | |", self.text("README.md"))
        self.assertEqual(self.check()[0], 0)

    def test_a_table_that_is_not_made_yet(self):
        """It is by hand until the next refresh, which makes it one of the others."""
        self.refresh()
        pending = README.split("<!-- runs")[1].replace("two", "once more").replace("-var n 3", "-var n 5")
        readme = self.text("README.md") + "\n<!-- runs, not made yet" + pending
        self.file("examples/a/README.md", readme)
        status, said = self.check()
        self.assertEqual(status, 0)
        self.assertIn("not made yet, of a", said)
        self.assertEqual(self.refresh(tables_only=True)[0], 0)
        self.assertIn("| once more | 2 | 2.0e-3 | +1.0 % |", self.text("README.md"))
        self.assertNotIn("not made yet", self.text("README.md"))
        self.assertEqual(self.check(), (0, "logs, tables and pictures belong together\n"))

    def test_check(self):
        """Whatever is changed by hand is found."""
        self.refresh()
        good = self.files("a")
        log = "log.2Jan20.a.g++.1"
        for name, old, new, said in (
                ("README.md", "0.0045", "0.0044", "its log"),
                ("README.md", "| 2.0e-3 |", "| 2.1e-3 |", "its log"),
                ("README.md", "| two | 2 | 2.0e-3 | +1.0 % |\n", "", "its log"),
                ("README.md", "-var n 9 + -\n", "-var n 8 + -\n", "log.runs has other runs"),
                ("README.md", "draw.py dump.a b.png", "draw.py dump.a c.png", "b.png is drawn by no"),
                ("README.md", "![another](b.png)", "", "b.png is not shown"),
                ("README.md", "(b.png)", "(d.png)", "d.png does not exist"),
                ("README.md", "<!-- results -->", "", "not one table"),
                ("README.md", "|---|---|---|---|", "", "is not followed by a table"),
                ("README.md", "-var n 7", "-var m 7", "-var m, which in.a does not know"),
                (log, "4.5e-03", "4.4e-03", "its log"),
                (log, "Total wall time", "ERROR", "has no end"),
                ("log.runs", "2.0e-03", "2.2e-03", "its log"),
                ("log.runs", "-var n 9", "-var n 8", "log.runs has other runs")):
            with self.subTest(f"{old} -> {new}"):
                self.assertIn(old, good[name])
                self.file(f"examples/a/{name}", good[name].replace(old, new))
                status, text = self.check()
                self.assertEqual(status, 1)
                self.assertIn(said, text)
                self.file(f"examples/a/{name}", good[name])
        self.file("examples/a/log.3Jan20.a.g++.1", good[log])
        self.assertIn("2 logs of 1 ranks", self.check()[1])

    def test_benchmarks(self):
        status, said = self.refresh("bench", ())
        self.assertEqual((self.top / "ran").read_text(), "--out doc/bench\n--full --out doc/bench\n")
        self.assertEqual(status, 1)
        self.assertIn("left as they were: bench two", said)
        self.assertEqual(self.refresh("bench", ("one",))[0], 0)

    def test_unknown_names(self):
        for what, name in (("examples", "c"), ("bench", "three")):
            with self.assertRaisesRegex(SystemExit, name):
                self.refresh(what, (name,))


class Numbers(unittest.TestCase):
    def test_formats(self):
        for text, form, right in (("1.41234e-03", ".2e", "1.41e-3"), ("123456", ".1e", "1.2e5"),
                                  ("0.0051", ".1%", "0.5 %"), ("4.86e-3", ".2f*1e3", "4.86"), ("-0.01", "+.1%", "-1.0 %"),
                                  ("59.26", ".1f", "59.3"), ("1e-05", None, "1e-05"),
                                  ("", ".1e", ""), ("nan", ".1e", "nan"), ("hangs", None, "hangs")):
            self.assertEqual(refresh.shown(text, form), right)


if __name__ == "__main__":
    sys.stdout.flush()
    unittest.main()
