# SPDX-License-Identifier: Apache-2.0
"""The checks of the list: each way to get it wrong is found and named."""

import pathlib
import tempfile
import unittest

from fault import Fault, FaultError, check, fault_from, read_faults
from result import MARK, Result, write_table
from work_copy import WorkCopy

ENTRY = {"name": "sign", "file": "a.cpp", "old": "x + y", "new": "x - y", "what": "wrong sign", "tests": "unit_core"}


class MutationTest(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.root = pathlib.Path(holder.name)

    def found(self, text):
        (self.root / "a.cpp").write_text(text)
        return list(check([Fault(**ENTRY)], self.root))

    def refused(self, sentence, **changes):
        with self.assertRaisesRegex(FaultError, sentence):
            fault_from({**ENTRY, **changes})

    def test_a_fault_that_applies(self):
        self.assertEqual(self.found("return x + y;"), [])
        self.assertEqual(Fault(**ENTRY).spoiled("return x + y;"), "return x - y;")

    def test_old_text_is_gone(self):
        self.assertRegex(self.found("return y + x;")[0], "a.cpp no longer has the old text of fault sign")

    def test_old_text_is_there_twice(self):
        self.assertRegex(self.found("x + y; x + y;")[0], "a.cpp has the old text of fault sign 2 times")

    def test_file_is_gone(self):
        self.assertRegex(list(check([Fault(**ENTRY)], self.root))[0], "a.cpp of fault sign does not exist")

    def test_entries_without_sense(self):
        self.refused("changes nothing", new="x + y")
        self.refused("no regular expression", tests="unit_(core")
        self.refused("has the keys", why="unknown key")

    def test_names_are_unique(self):
        table = "".join(f"{key} = '{value}'\n" for key, value in ENTRY.items())
        (self.root / "faults.toml").write_text(f"[[fault]]\n{table}[[fault]]\n{table}")
        with self.assertRaisesRegex(FaultError, "2 faults named sign"):
            read_faults(self.root / "faults.toml")

    def test_a_folder_of_others_is_left_alone(self):
        (self.root / "thesis.tex").write_text("")
        with self.assertRaisesRegex(FaultError, "not empty"):
            WorkCopy(self.root, self.root, "release", 1).update()
        self.assertEqual([path.name for path in self.root.iterdir()], ["thesis.tex"])

    def test_table_keeps_what_is_above_its_mark(self):
        path = self.root / "README.md"
        path.write_text(f"above\n{MARK}\nold\n")
        entry = {**ENTRY, "what": "wrong |sign|"}
        results = [Result(Fault(**entry), test, False, 1.0) for test in ("unit_core.A", "")]
        write_table(path, results, "c0ffee", 60.0)
        text = path.read_text()
        self.assertRegex(text, "^above\n")
        self.assertNotIn("old\n", text)
        self.assertIn("2 faults, 1 caught (0 by a time-out), 1 not", text)
        self.assertIn("| `sign`: wrong \\|sign\\| | a.cpp | `unit_core.A` |", text)
        self.assertIn("| `sign`: wrong \\|sign\\| | a.cpp | **nobody** |", text)


if __name__ == "__main__":
    unittest.main()
