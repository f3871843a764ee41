# SPDX-License-Identifier: Apache-2.0
"""Runs that are told to end, killed at random moments, or out of space: what they say, and that they go on."""

import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

from interrupted import INTERRUPTED, Process, checkpoints, differences, rows_done
from kills import Failure, Kills
from program import SCENES, ProgramTest, nscdd

BOX = SCENES / "rotating_box_730.toml"


class Signals(ProgramTest):
    OPTIONS = ["--solver", "nscdd", "--subdomains", "2x2"]

    def expect_to_go_on(self, process, out, send, code=INTERRUPTED):
        """`send` tells the run to end; it must say how to go on, and that must give the results of the uninterrupted run."""
        process.wait_for(lambda: rows_done(out) >= 3)
        send()
        found, _, error = process.finish(timeout=120)
        self.assertEqual(found, code, error)
        self.assertIn(f"nscdd run --resume {out}", error)
        steps = rows_done(out)
        self.assertEqual(steps, checkpoints(out)[-1])  # none is lost
        done = nscdd("run", "--resume", out, "--quiet", "--steps", steps + 5)
        self.assertEqual(done.returncode, 0, done.stderr)
        expected = self.run_scene(BOX, *self.OPTIONS, "--steps", steps + 5, out=f"expected_{out.name}")
        self.assertEqual(differences(out, expected), [])

    def begin(self, name, ranks=0, launcher=()):
        out = self.folder / name
        arguments = ["run", BOX, *self.OPTIONS, "--steps", 1000000, "--quiet", "--out", out, "--checkpoint-every", 1000000]
        return Process(*arguments, ranks=ranks, launcher=launcher), out

    def test_of_the_program(self):
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGUSR1):
            with self.subTest(number.name):
                process, out = self.begin(number.name)
                self.expect_to_go_on(process, out, lambda: process.popen.send_signal(number))

    def test_of_one_rank(self):
        process, out = self.begin("rank", ranks=3)
        self.expect_to_go_on(process, out, lambda: os.kill(process.ranks()[-1], signal.SIGTERM))

    def test_of_the_launcher(self):
        """mpirun passes SIGUSR1 on, and leaves the ranks the time that they need."""
        process, out = self.begin("usr1", ranks=2)
        self.expect_to_go_on(process, out, lambda: process.popen.send_signal(signal.SIGUSR1))

    def test_of_the_launcher_with_a_grace_period(self):
        process, out = self.begin("term", ranks=2, launcher=("--mca", "odls_base_sigkill_timeout", "5"))
        self.expect_to_go_on(process, out, lambda: process.popen.send_signal(signal.SIGTERM), code=1)  # mpirun's own code

    def test_second_signal_ends_at_once(self):
        """The step of a large scene is not waited for."""
        out = self.folder / "large"
        process = Process("run", SCENES / "box_10k.toml", "--quiet", "--out", out, "--checkpoint-every", 1000,
                          "--tolerance", "1e-12", "--max-iterations", 1000000, "--option", "stall_iterations=1000000")
        process.wait_for(lambda: out.exists() and checkpoints(out) == [0])
        time.sleep(1)  # the first step has begun, and lasts for long
        process.popen.send_signal(signal.SIGTERM)
        with self.assertRaises(subprocess.TimeoutExpired):
            process.popen.wait(timeout=1)  # it is in its first step
        process.popen.send_signal(signal.SIGTERM)
        self.assertEqual(process.finish(timeout=60)[0], -signal.SIGTERM)
        self.assertEqual(checkpoints(out), [0])


class FullDisk(ProgramTest):
    """A small file system of its own."""

    def setUp(self):
        super().setUp()
        self.disk = self.folder / "disk"
        self.disk.mkdir()
        if os.geteuid() != 0:
            self.skipTest("only root may mount a small file system")
        mounted = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=1500k", "tmpfs", self.disk],
                                 capture_output=True, text=True)
        if mounted.returncode != 0:
            self.skipTest("a small file system cannot be mounted here: " + mounted.stderr.strip())
        self.addCleanup(subprocess.run, ["umount", "-l", self.disk], check=True)

    def test_the_run_goes_on_when_there_is_space(self):
        options = ["--solver", "nscdd", "--subdomains", "2x2", "--steps", 12, "--save-every", 2]
        expected = self.run_scene(BOX, *options, out="expected")
        for ranks in (0, 2):
            with self.subTest(ranks=ranks):
                out = self.disk / f"out{ranks}"
                done = nscdd("run", BOX, *options, "--quiet", "--out", out, "--checkpoint-every", 1, ranks=ranks, timeout=120)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn("nscdd run --resume", done.stderr)
                newest = checkpoints(out)[-1]
                self.assertIn(f"after step {newest}", done.stderr)
                subprocess.run(["mount", "-o", "remount,size=64m", self.disk], check=True)
                done = nscdd("run", "--resume", out, ranks=ranks)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn(f"going on after step {newest} of", done.stdout)
                self.assertEqual(differences(out, expected), [])
                shutil.rmtree(out)
                subprocess.run(["mount", "-o", "remount,size=1500k", self.disk], check=True)


class RandomKills(unittest.TestCase):
    def test_ten(self):
        """The long version: kills.py --kills 100."""
        with tempfile.TemporaryDirectory() as folder:
            kills = Kills(pathlib.Path(folder), 20240, lambda text: None)
            try:
                kills.run(10)
            except Failure as failure:
                self.fail(str(failure))
            self.assertGreaterEqual(kills.counts["kills"], 10)


if __name__ == "__main__":
    unittest.main()
