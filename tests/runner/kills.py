#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Kills a run at random moments, one rank or all, also while it writes, and resumes it on a random number of ranks until it has
finished: it must lose at most the steps since the last checkpoint, and give the results of the uninterrupted run, bit for bit.

    tests/runner/kills.py --kills 100 --seed 1
"""

import argparse
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile

from interrupted import Process, checkpoints, differences, rows_done
from program import SCENES, nscdd

# Also as root, and with more ranks than cores.
os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_mpi_yield_when_idle="1")

SCENE = SCENES / "rotating_box_730.toml"
OPTIONS = ["--solver", "fea", "--subdomains", "2x4", "--steps", 40, "--save-every", 3, "--option", "repartition_every=5"]
EVERY = (1, 2, 5)  # steps between checkpoints, drawn for each run


class Failure(Exception):
    pass


class Kills:
    def __init__(self, folder, seed, log):
        self.folder = folder
        self.random = random.Random(seed)
        self.log = log
        self.every = 1
        self.counts = dict.fromkeys(["kills", "of one rank", "at any moment", "while a checkpoint was written", "at the end",
                                     "before checkpoint 0", "runs finished", "steps lost", "most steps lost at once"], 0)

    def expect(self, holds, what):
        if not holds:
            raise Failure(what)

    def prepare(self):
        done = nscdd("run", SCENE, *OPTIONS, "--quiet", "--out", self.folder / "expected")
        self.expect(done.returncode == 0, done.stderr)

    def wait_for_moment(self, process, out):
        """Waits for a moment drawn by lot; its name, or None if the run ended before."""
        moment = self.random.choice(["any moment", "any moment", "a checkpoint was written", "the end"])
        if moment == "any moment":
            try:
                process.popen.wait(timeout=self.random.uniform(0.0, 1.2))
                return None
            except subprocess.TimeoutExpired:
                return moment
        if moment == "the end":
            names = ("results.h5.part", "final.csv.part", "run.json.finished")
            reached = process.wait_for(lambda: any((out / name).exists() for name in names))
        else:
            rows = self.random.randrange(1, 36)
            reached = process.wait_for(lambda: rows_done(out) >= rows and any(out.glob("checkpoint_*.ckpt.part")))
        return moment if reached else None

    def kill(self, process):
        """All at once, or one rank; nobody may wait for a dead rank for ever."""
        self.counts["kills"] += 1
        victims = process.ranks()
        if not process.has_launcher or not victims or self.random.random() < 0.5:
            process.kill()
            return
        self.counts["of one rank"] += 1
        try:
            os.kill(self.random.choice(victims), signal.SIGKILL)
        except ProcessLookupError:
            pass
        process.finish(timeout=60)

    def one_run(self, kills):
        """A run from its beginning to its end, with kills as long as there are some left."""
        out = self.folder / "out"
        shutil.rmtree(out, ignore_errors=True)
        self.every = self.random.choice(EVERY)
        begin = ["run", SCENE, *OPTIONS, "--out", out, "--checkpoint-every", self.every]
        arguments, newest = begin, None
        while True:
            ranks = self.random.randrange(4)
            process = Process(*arguments, ranks=ranks, launcher=("--mca", "odls_base_sigkill_timeout", "0"))
            moment = self.wait_for_moment(process, out) if self.counts["kills"] < kills else None
            if moment is None:
                self.check_end(*process.finish(), newest)
                break
            self.kill(process)
            self.counts[f"at {moment}" if moment != "a checkpoint was written" else "while a checkpoint was written"] += 1
            if (out / "run.json").exists() or (out / "run.json.finished").exists():  # it had finished
                error = nscdd("run", "--resume", out).stderr
                self.expect("has finished" in error, error)
                break
            newest = self.check_wreck(out)
            arguments = begin if newest is None else ["run", "--resume", out]
        different = differences(out, self.folder / "expected")
        self.expect(not different, f"not the same as the uninterrupted run: {different}")
        self.counts["runs finished"] += 1

    def check_wreck(self, out):
        """What a kill left: the step of the checkpoint that the run can go on from, None if it was killed before the first."""
        steps, rows = checkpoints(out) if out.exists() else [], rows_done(out)
        self.log(f"  killed after step {rows}, checkpoints {steps}")
        if not steps:
            error = nscdd("run", "--resume", out).stderr
            self.expect("no checkpoint" in error or "no folder" in error or "no run" in error, error)
            self.expect(rows == 0, "steps were done before checkpoint 0")
            self.counts["before checkpoint 0"] += 1
            return None
        lost = rows - steps[-1]
        self.expect(lost <= self.every, f"{lost} steps were lost, checkpoints were written every {self.every}")
        self.counts["steps lost"] += max(0, lost)
        self.counts["most steps lost at once"] = max(self.counts["most steps lost at once"], lost)
        return steps[-1]

    def check_end(self, code, text, error, newest):
        """A run that was not killed any more finishes, from the newest checkpoint."""
        self.expect(code == 0, f"exit code {code}: {error}")
        self.expect("WARNING" not in error, error)
        self.expect(newest is None or f"going on after step {newest} of" in text, f"not from step {newest}: {text}")

    def run(self, kills):
        self.prepare()
        while self.counts["kills"] < kills:
            self.one_run(kills)
            self.log(f"run finished; {self.counts['kills']} kills so far")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--kills", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--verbose", action="store_true")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        kills = Kills(pathlib.Path(folder), arguments.seed, print if arguments.verbose else lambda text: None)
        try:
            kills.run(arguments.kills)
        except Failure as failure:
            print(f"FAILED after {kills.counts['kills']} kills (seed {arguments.seed}): {failure}")
            return 1
        for what, count in kills.counts.items():
            print(f"{count:5}  {what}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
