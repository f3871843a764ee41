# SPDX-License-Identifier: Apache-2.0
"""Shipped scenes on 1 to 4 ranks: final.csv and all columns of steps.csv but the seconds agree bit for bit."""

import unittest

from interrupted import without_seconds
from program import SCENES, ProgramTest, nscdd, read_csv


class Ranks(ProgramTest):
    def compare(self, scene, *arguments):
        path = SCENES / f"{scene}.toml"
        expected = self.run_scene(path, *arguments, out="serial")
        for ranks in (1, 2, 3, 4):
            out = self.run_scene(path, *arguments, out=f"ranks{ranks}", ranks=ranks)
            self.assertEqual((out / "final.csv").read_bytes(), (expected / "final.csv").read_bytes(), f"{ranks} ranks")
            self.assertEqual(without_seconds(out / "steps.csv"), without_seconds(expected / "steps.csv"), f"{ranks} ranks")

    def test_rotating_box_730(self):
        self.compare("rotating_box_730", "--solver", "nscdd", "--subdomains", "2x4", "--steps", 8)

    def test_rotating_box_730_on_reference(self):
        self.compare("rotating_box_730_frictionless", "--adapter", "reference", "--subdomains", "4x4", "--steps", 3)

    def test_sloped_flow_750(self):
        self.compare("sloped_flow_750", "--solver", "nscdd", "--subdomains", "4x1", "--steps", 12)

    def test_box_10k(self):
        self.compare("box_10k", "--steps", 2)

    def test_conjugate_gradient(self):
        self.compare("rotating_box_730", "--solver", "fea", "--subdomains", "4x4", "--interface", "cg", "--steps", 2)

    def test_assembled_interface(self):
        self.compare("rotating_box_730", "--solver", "iea", "--subdomains", "2x4", "--interface", "direct", "--steps", 3)

    def test_distributed_mumps_agrees_to_rounding(self):
        path = SCENES / "rotating_box_730_frictionless.toml"
        common = ("--solver", "iea", "--subdomains", "2x2", "--steps", 1, "--tolerance", "1e-13", "--max-iterations", 200000)
        eigen = read_csv(self.run_scene(path, *common, out="eigen") / "final.csv")
        mumps = read_csv(self.run_scene(path, *common, "--option", "linear_solver=mumps", out="mumps", ranks=3) / "final.csv")
        for a, b in zip(eigen, mumps):
            for key in ("vx", "vy"):
                self.assertAlmostEqual(float(a[key]), float(b[key]), delta=1e-9)

    def test_mpi_is_left_alone_without_a_launcher(self):
        done = nscdd("run", SCENES / "two_disks.toml", "--quiet", "--out", self.folder / "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        # Open MPI makes its session folder, and prints, only when it is initialised.
        self.assertEqual(done.stderr, "")


if __name__ == "__main__":
    unittest.main()
