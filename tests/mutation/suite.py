"""Runs the tests of a build one after the other until one fails, and says which."""

import dataclasses
import os
import re
import selectors
import signal
import subprocess
import time

# Tests of other things than what the faults spoil, or far too slow for one fault.
LEFT_OUT = r"^(structure|install|benchmark|render|mutation)\.|^runner\.(interruption|tradeoff|extremes)"

START = re.compile(r"^\s*Start\s+\d+: (\S+)")
RESULT = re.compile(r"Test\s+#\d+: (\S+) \.*\s*(Passed|\*\*\*\S+.*?)\s+[\d.]+ sec")


@dataclasses.dataclass
class Verdict:
    test: str = ""  # that failed; empty: all passed
    timed_out: bool = False
    count: int = 0  # tests that ran


def stop(process):
    """Ends a group of processes that hangs: mpirun passes SIGTERM on to its ranks."""
    for number in (signal.SIGTERM, signal.SIGKILL):
        try:
            os.killpg(process.pid, number)
            process.wait(timeout=10)
        except (ProcessLookupError, subprocess.TimeoutExpired):
            continue


def run_tests(copy, select, timeout):
    """Tests chosen by ctest's options `select`; one that takes longer than `timeout` [s] counts as failed by its time-out."""
    command = ["ctest", "--stop-on-failure", "--no-tests=error", "--parallel", "1", "--timeout", str(timeout), *select]
    process = subprocess.Popen(command, cwd=copy.build_folder, env=copy.environment, text=True, stdin=subprocess.DEVNULL,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True)
    verdict = Verdict()
    running, since = "", time.monotonic()
    with selectors.DefaultSelector() as selector:
        selector.register(process.stdout, selectors.EVENT_READ)
        while True:
            if not selector.select(timeout=1.0):
                if time.monotonic() - since < timeout + 10.0:  # ctest's own limit first
                    continue
                stop(process)
                return Verdict(running, True, verdict.count)
            line = process.stdout.readline()
            if not line:
                break
            if match := START.search(line):
                running, since = match[1], time.monotonic()
            elif match := RESULT.search(line):
                verdict.count += 1
                if match[2] != "Passed" and not verdict.test:
                    verdict.test, verdict.timed_out = match[1], "Timeout" in match[2]
    if process.wait() != 0 and not verdict.test:
        raise RuntimeError(f"ctest {' '.join(select)} failed without naming a test: is the build complete?")
    return verdict
