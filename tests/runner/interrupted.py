# SPDX-License-Identifier: Apache-2.0
"""Runs that are interrupted: starting, watching and killing them, and comparing what they leave."""

import glob
import os
import pathlib
import signal
import subprocess
import time

from program import MPIEXEC, NSCDD, read_csv

INTERRUPTED = 4  # exit code


def without_seconds(path):
    return [{k: v for k, v in row.items() if not k.startswith("seconds_")} for row in read_csv(path)]


def rows_done(folder):
    """The last complete row of steps.csv.part; 0 if there is none."""
    try:
        lines = (folder / "steps.csv.part").read_text().split("\n")[1:-1]
    except OSError:
        return 0
    return int(lines[-1].split(",")[0]) if lines else 0


def checkpoints(folder):
    return sorted(int(p.name[len("checkpoint_"):-len(".ckpt")]) for p in folder.glob("checkpoint_*.ckpt"))


def differences(found, expected):
    """Names of the results in two folders that are not the same."""
    different = []
    if (found / "final.csv").read_bytes() != (expected / "final.csv").read_bytes():
        different.append("final.csv")
    if without_seconds(found / "steps.csv") != without_seconds(expected / "steps.csv"):
        different.append("steps.csv")
    if (found / "results.xdmf").read_bytes() != (expected / "results.xdmf").read_bytes():
        different.append("results.xdmf")
    return different


def parent_of(pid):
    try:
        with open(f"/proc/{pid}/stat") as file:
            return int(file.read().rsplit(")", 1)[1].split()[1])
    except (OSError, ValueError):
        return 0


class Process:
    """nscdd as a process of its own, under mpirun if ranks > 0."""

    def __init__(self, *arguments, ranks=0, launcher=()):
        command = [MPIEXEC, "--oversubscribe", *launcher, "-n", str(ranks)] if ranks else []
        self.popen = subprocess.Popen(command + [NSCDD, *map(str, arguments)], text=True, stdin=subprocess.DEVNULL,
                                      stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.has_launcher = ranks > 0

    def ranks(self):
        """Process ids of the ranks that are alive."""
        if not self.has_launcher:
            return [self.popen.pid]
        pids = [int(os.path.basename(p)) for p in glob.glob("/proc/[0-9]*")]
        return [pid for pid in pids if parent_of(pid) == self.popen.pid]

    def is_running(self):
        return self.popen.poll() is None

    def wait_for(self, condition, timeout=120):
        """Polls until condition() or the end of the process; says which."""
        end = time.monotonic() + timeout
        while not condition():
            if not self.is_running():
                return False
            if time.monotonic() > end:
                self.kill()
                raise AssertionError("waited in vain")
            time.sleep(0.0005)
        return True

    def kill(self):
        """SIGKILL of all at once; returns when they are gone."""
        pids = self.ranks()
        for pid in [self.popen.pid, *pids]:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        self.finish()
        while any(pathlib.Path(f"/proc/{pid}").exists() and parent_of(pid) > 1 for pid in pids):
            time.sleep(0.001)

    def finish(self, timeout=300):
        """Waits for the end; returns code and the two outputs. A hang is killed, and an error."""
        try:
            out, error = self.popen.communicate(timeout=timeout)
        except subprocess.TimeoutExpired:
            self.popen.kill()
            raise
        return self.popen.returncode, out, error
