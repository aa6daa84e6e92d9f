#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Changes to scripts: in the right place, and never silently without effect."""

import tempfile
import unittest
from pathlib import Path
from unittest import mock

import scene

TEXT = """fix           sph all aleisph spacing $d
fix           guard fluid aleisph/guard walls 0.3 &
              pressure 0
run           0 post no
label         compare
run           10
"""


class Changes(unittest.TestCase):
    def test_options_go_to_the_end_of_a_continued_line(self):
        text = scene.with_options(TEXT, "guard", "cap 9")
        self.assertEqual(text, TEXT.replace("pressure 0", "pressure 0 cap 9"))

    def test_words_are_replaced_in_that_fix_only(self):
        text = scene.with_words(TEXT, "guard", "walls 0.3", "walls 0.1")
        self.assertEqual(text, TEXT.replace("0.3", "0.1"))

    def test_a_bare_fix_has_no_options_in_continued_lines_either(self):
        text = scene.bare_fix(TEXT, "guard")
        self.assertIn("\nfix guard fluid aleisph/guard\nrun", text)

    def test_lines_go_in_before_the_steps(self):
        lines = scene.before_run(TEXT, ["thermo 1"]).splitlines()
        self.assertEqual(lines[lines.index("thermo 1") + 1].split(), ["label", "compare"])

    def test_first_step(self):
        text = scene.with_first_step("x\ntimestep   $(v_a*2)\ny", "$(0.5*v_most)")
        self.assertEqual(text, "x\nvariable most equal (v_a*2)\ntimestep $(0.5*v_most)\ny")

    def test_what_is_not_there_is_an_error(self):
        for change in (lambda: scene.with_options(TEXT, "shift", "x"),
                       lambda: scene.with_words(TEXT, "sph", "walls 0.3", "x"),
                       lambda: scene.bare_fix(TEXT, "dt"),
                       lambda: scene.with_first_step(TEXT, "1"),
                       lambda: scene.before_run("run 1\n", ["thermo 1"])):
            with self.assertRaises(ValueError):
                change()

    def test_run_time_is_printed_in_full(self):
        with tempfile.TemporaryDirectory() as folder:
            text = scene.with_exact_time("taylor-green", Path(folder)).read_text(encoding="ascii")
            self.assertIn("seconds=$(v_t1-v_t0:%.6f) ranks", text)
            with mock.patch.object(scene, "script", return_value=TEXT):
                with self.assertRaises(ValueError):
                    scene.with_exact_time("tank", Path(folder))

    def test_the_examples_have_what_is_changed(self):
        for case in ("square-patch", "tank", "dam-break"):
            text = scene.script(case)
            scene.with_options(text, "sph", "kernel wendland-c2")
            scene.before_run(text, ["thermo 1"])


if __name__ == "__main__":
    unittest.main()
