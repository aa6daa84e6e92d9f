#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-2.0-only
"""Files that a run which was killed leaves behind: what is whole in them is read, with no wrong
number, and what is cut is named. Values that are not finite are left out, and counted."""

import contextlib
import gzip
import io
import tempfile
import unittest
from pathlib import Path

import caps
import dump_check
import dumps
from result_table import read_results
from series import read_series

FRAME = """ITEM: UNITS
si
ITEM: TIME
{time}
ITEM: TIMESTEP
{step}
ITEM: NUMBER OF ATOMS
2
ITEM: BOX BOUNDS pp ff ff
0 1
0 1
0 1
ITEM: ATOMS id type x y z surface
2 1 0.75 1.25e-3 0 1
1 1 {x} 0.125 0 12.5
"""
FRAMES = [FRAME.format(time=0.5 * k, step=10 * k, x=0.25 + k) for k in range(3)]
TEXT = "".join(FRAMES)


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = Path(folder.name)

    def quiet(self, work, *arguments):
        """(result, what stands on stderr)"""
        with contextlib.redirect_stderr(io.StringIO()) as text:
            return work(*arguments), text.getvalue()

    def file(self, text, name="dump"):
        path = self.folder / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode("ascii"))
        return path


class Cut(Files):
    def read(self, text, name="dump"):
        """([(step, time, rows)], stderr); no snapshot: []"""
        def rows(path):
            try:
                return [(s.step, s.time, s.rows) for s in dumps.snapshots(path)]
            except ValueError as problem:
                self.assertIn("holds no whole snapshot", str(problem))
                return []
        return self.quiet(rows, self.file(text, name))

    def setUp(self):
        super().setUp()
        self.all = self.read(TEXT)[0]
        self.ends = [sum(map(len, FRAMES[:k + 1])) for k in range(3)]

    def whole(self, length):
        return self.all[:sum(end <= length for end in self.ends)]

    def test_three_snapshots(self):
        self.assertEqual([(step, time) for step, time, _ in self.all], [(0, 0), (10, 0.5), (20, 1)])
        self.assertEqual(self.all[2][2], [[2, 1, 0.75, 1.25e-3, 0, 1], [1, 1, 2.25, 0.125, 0, 12.5]])

    def test_at_any_place(self):
        """Also within the last number: 12.5 without the 5 is no 12."""
        for length in range(len(TEXT)):
            found, said = self.read(TEXT[:length])
            self.assertEqual(found, self.whole(length), f"cut after {length} characters")
            if length not in (0, *self.ends) and found:    # ITEM: UNITS, si, ITEM: TIME has 25
                self.assertEqual("is not whole" in said, length >= self.ends[len(found) - 1] + 25)

    def test_its_number_and_step_are_named(self):
        self.assertIn("snapshot 3, of step 20, is not whole: the file ends within it; it is left out",
                      self.read(TEXT[:-1])[1])
        self.assertIn("snapshot 2, of step 10, is not whole: another snapshot begins",
                      self.read(TEXT[:self.ends[1] - 9] + TEXT)[1])

    def test_in_the_middle_of_an_appended_dump(self):
        for length in range(self.ends[0], self.ends[1]):
            found, _ = self.read(TEXT[:length] + TEXT)
            self.assertEqual(found, self.whole(length) + self.all, f"cut after {length} characters")

    def test_compressed(self):
        packed = gzip.compress(TEXT.encode("ascii"), 0)    # stored, so that a part can be read
        for length in range(20, len(packed)):
            found, _ = self.read(packed[:length], "dump.gz")
            self.assertEqual(found, self.all[:len(found)])
        self.assertEqual(len(self.read(packed[:-30], "dump.gz")[0]), 2)
        self.assertEqual(len(self.read(packed, "dump.gz")[0]), 3)

    def test_binary_rubbish_at_the_end(self):
        for rubbish in (b"\0" * 100, b"\xff\xfe\n", b"ITEM: ATOMS\n"):
            self.assertEqual(self.read(TEXT.encode() + rubbish)[0], self.all)

    def test_a_comparison_asks_for_whole_dumps(self):
        table = self.file("".join(f"{name} 1 any\n" for name in "id type x y z surface".split()),
                          "table")
        whole, cut = self.file(TEXT, "whole"), self.file(TEXT + FRAMES[0][:-9], "cut")
        self.assertTrue(dump_check.compare(whole, whole, table)[1])
        for pair in ((whole, cut), (cut, whole)):
            with self.assertRaisesRegex(ValueError, "snapshot 4, of step 0, is not whole"):
                dump_check.compare(*pair, table)

    def test_tools_take_the_last_whole_one(self):
        (time, lengths, rows), said = self.quiet(caps.last_frame, self.file(TEXT[:-3]))
        self.assertEqual((time, lengths, rows[1]["x"]), (0.5, [1.0, None, None], 1.25))
        self.assertIn("snapshot 3, of step 20", said)


class OtherFiles(Files):
    def test_series(self):
        text = "# Time-averaged data\n# TimeStep v_t c_a\n0 0.5 12.25\n1 1.5 22.75\n"
        start = text.index("1 1.5")
        for length in range(start + 1, len(text) + 1):
            series, said = self.quiet(read_series, self.file(text[:length]))
            whole = length == len(text)
            self.assertEqual(series, {"TimeStep": [0, 1], "t": [0.5, 1.5], "a": [12.25, 22.75]}
                             if whole else {"TimeStep": [0], "t": [0.5], "a": [12.25]})
            self.assertEqual("line 4 is not whole" in said, not whole)

    def test_log(self):
        text = "ALEISPH-RESULT case=a l2=0.125\nALEISPH-RESULT case=b l2=0.125\n"
        rows, said = self.quiet(read_results, self.file(text[:-3]))
        self.assertEqual(rows, [{"case": "a", "l2": "0.125"}])
        self.assertIn("the last result line is cut", said)


class NotFinite(Files):
    def test_particles_are_left_out_and_counted(self):
        for word in ("nan", "-nan", "inf"):
            text = FRAMES[0].replace("0.25 0.125", f"0.25 {word}")
            frame = dumps.read_frames(self.file(text))[0]
            good, said = self.quiet(dumps.finite, frame, ["x", "y"], "here")
            self.assertEqual(list(good), [False, True])    # sorted by id
            self.assertIn("here: 1 of 2 particles", said)
            self.assertIn("id 1 (y)", said)
            rows, said = self.quiet(dumps.finite_rows, dumps.last_snapshot(
                self.folder / "dump").dicts(), ["x", "y"], "here")
            self.assertEqual([row["id"] for row in rows], [2])
            self.assertIn("id 1 (y)", said)

    def test_missing_columns_and_times_are_named(self):
        frame = dumps.last_snapshot(self.file(TEXT.replace("ITEM: TIME\n", "ITEM: WHEN\n")))
        with self.assertRaisesRegex(ValueError, "no times: dump_modify"):
            dumps.need_time(frame, "dump")
        with self.assertRaisesRegex(ValueError, "no column vx; it has id type"):
            dumps.need_columns(frame.names, ("x", "vx"), "dump")
        with self.assertRaisesRegex(ValueError, "no column vx; it has id type"):
            dumps.as_frame(frame)["vx"]


if __name__ == "__main__":
    unittest.main()
