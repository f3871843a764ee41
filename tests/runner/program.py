# SPDX-License-Identifier: Apache-2.0
"""Runs nscdd for the tests of this folder; needs nothing but Python's standard library."""

import csv
import os
import pathlib
import subprocess
import tempfile
import unittest

SOURCE = pathlib.Path(__file__).resolve().parents[2]
SCENES = SOURCE / "sample_scenes"
NSCDD = os.environ.get("NSCDD", str(SOURCE / "build/release/bin/nscdd"))
MPIEXEC = os.environ.get("MPIEXEC", "mpiexec")


def nscdd(*arguments, ranks=0, cwd=None, timeout=600):
    """Runs the program, under mpirun if ranks > 0. Returns the finished process with its text output."""
    launcher = [MPIEXEC, "--oversubscribe", "-n", str(ranks)] if ranks else []
    return subprocess.run(launcher + [NSCDD, *map(str, arguments)], cwd=cwd, timeout=timeout, text=True,
                          capture_output=True, stdin=subprocess.DEVNULL, check=False)


def read_csv(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


class ProgramTest(unittest.TestCase):
    """A test with a folder of its own, `self.folder`."""

    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = pathlib.Path(holder.name)

    def write(self, name, text):
        path = self.folder / name
        path.write_text(text)
        return path

    def run_scene(self, scene, *arguments, out="out", ranks=0):
        """Runs a scene quietly; returns its folder of results."""
        done = nscdd("run", scene, "--quiet", "--out", self.folder / out, *arguments, ranks=ranks)
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.folder / out


TWO_DISKS = """
[scene]
name = "test"
[time]
dt = 0.01
steps = 3
[[walls]]
type = "half_plane"
point = [0.0, 0.0]
[[disks]]
centre = [0.0, 1.0]
radius = 1.0
[[disks]]
centre = [0.0, 3.0]
radius = 1.0
[solver]
name = "nscd"
"""
