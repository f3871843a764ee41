# SPDX-License-Identifier: Apache-2.0
"""`nscdd extremes`: the short map has no silent miss, and would not stay silent about one."""

import os
import unittest

from program import ProgramTest, nscdd, read_csv

FAULTY_PLUGIN = os.environ.get("FAULTY_PLUGIN", "")


class Extremes(ProgramTest):
    def test_no_solver_misses_silently(self):
        done = nscdd("extremes", "--quick", "--out", self.folder)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        rows = read_csv(self.folder / "extremes.csv")
        self.assertGreater(len(rows), 400)
        self.assertEqual({r["verdict"] for r in rows} - {"holds", "limit", "refused"}, set())
        self.assertEqual((self.folder / "extremes.png").read_bytes()[:4], b"\x89PNG")
        for row in rows:
            with self.subTest(case=row["case"], solver=row["solver"]):
                self.assertTrue(row["sentence"])  # a limit is a sentence
                self.assertNotIn("nan", ",".join(row.values()))

    def test_what_must_hold(self):
        nscdd("extremes", "--quick", "--solvers", "nscd/anderson,nscdd/anderson,fea/anderson,newton", "--out", self.folder)
        rows = read_csv(self.folder / "extremes.csv")
        self.assertEqual(len({r["solver"] for r in rows}), 4)
        for row in rows:
            with self.subTest(case=row["case"], solver=row["solver"]):
                if "lambda 1e+12" in row["case"]:
                    self.assertEqual(row["verdict"], "refused")
                    self.assertIn("option 'lambda' is", row["sentence"])
                elif "drift 20 radii" in row["case"] or "alert distance 40" in row["case"]:
                    self.assertEqual((row["verdict"], row["status"]), ("limit", "converged"))
                    self.assertIn("contacts may have been missed", row["sentence"])
                elif "1e+08, nat 1e-4" not in row["case"]:
                    self.assertEqual(row["verdict"], "holds", row)
        same = {r["iterations"] for r in rows if r["family"] == "units" and r["solver"] == "nscd/anderson"}
        self.assertEqual(len(same), 1)  # the unit of length is no matter

    def test_nat_says_when_light_bodies_are_lost_under_heavy_ones(self):
        nscdd("extremes", "--quick", "--solvers", "nscdd/none", "--out", self.folder)
        row = next(r for r in read_csv(self.folder / "extremes.csv") if "1e+08, nat 1e-4" in r["case"])
        self.assertEqual((row["status"], row["verdict"]), ("converged", "limit"))
        self.assertIn("criterion nat_max sees it", row["sentence"])

    def test_refusals(self):
        done = nscdd("extremes", "--quick", "--solvers", "gauss", "--out", self.folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn("there is no 'gauss'; solvers are nscd/none", done.stderr)
        done = nscdd("extremes", "--quick", "--solvers", "rea", "--out", self.write("file", "") / "inside")
        self.assertEqual(done.returncode, 2)
        self.assertIn("cannot make the folder", done.stderr)

    @unittest.skipUnless(FAULTY_PLUGIN, "no faulty plugin")
    def test_a_plugin_that_lies_is_caught(self):
        for fault, word in (("blind", "SILENT MISS"), ("slow_step", "BROKEN"), ("none", "")):
            with self.subTest(fault=fault):
                os.environ["NSCDD_FAULT"] = fault
                self.addCleanup(os.environ.pop, "NSCDD_FAULT", None)
                done = nscdd("extremes", "--quick", "--plugin", FAULTY_PLUGIN, "--solvers", "nscd/none", "--out", self.folder)
                self.assertEqual(done.returncode, 1 if word else 0, done.stdout + done.stderr)
                self.assertIn(word, done.stdout)


if __name__ == "__main__":
    unittest.main()
