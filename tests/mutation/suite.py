# SPDX-License-Identifier: Apache-2.0
"""Runs tests of a build one after the other until one fails, and says which."""

import dataclasses
import os
import re
import select
import signal
import subprocess
import time

# Tests of other things than what the faults spoil, or far too slow for one fault.
LEFT_OUT = re.compile(r"^(structure|install|benchmark|mutation)\.|^unit_(render|results)\.|"
                      r"^runner\.(interruption|tradeoff|extremes)")

START = re.compile(r"^\s*Start\s+(\d+): ")
RESULT = re.compile(r"Test\s+#(\d+): .*(Passed|\*\*\*(Failed|Timeout|Exception|Not Run|Skipped|Disabled))")


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


def lines(process, is_late):
    """What the process prints; ends it when it says nothing and is_late()."""
    rest = b""
    while True:
        if select.select([process.stdout], [], [], 1.0)[0]:
            chunk = os.read(process.stdout.fileno(), 65536)
            if not chunk:
                return
            *whole, rest = (rest + chunk).split(b"\n")
            yield from (line.decode(errors="replace") for line in whole)
        elif is_late():
            stop(process)
            return


def run_tests(copy, wants, timeout):
    """Runs the tests whose name `wants`; one that takes longer than `timeout` [s] counts as failed by its time-out."""
    names = {number: name for number, (name, _) in enumerate(copy.tests(), 1) if wants(name)}
    if not names:
        return Verdict()
    command = ["ctest", "--stop-on-failure", "--parallel", "1", "--timeout", str(timeout),
               "-I", f"0,0,0,{','.join(map(str, names))}"]
    process = subprocess.Popen(command, cwd=copy.build_folder, env=copy.environment, stdin=subprocess.DEVNULL,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True)
    verdict = Verdict()
    running, since = "", time.monotonic()
    try:
        for line in lines(process, lambda: time.monotonic() > since + timeout + 10.0):  # ctest's own limit comes first
            if match := START.search(line):
                running, since = names[int(match[1])], time.monotonic()
            elif match := RESULT.search(line):
                verdict.count += 1
                if match[3] not in (None, "Skipped", "Disabled") and not verdict.test:
                    verdict.test, verdict.timed_out = names[int(match[1])], match[3] == "Timeout"
    except BaseException:
        stop(process)
        raise
    if process.wait() < 0 and not verdict.test:
        verdict.test, verdict.timed_out = running, True
    if process.returncode > 0 and not verdict.test:
        raise RuntimeError(f"{' '.join(command)} failed without naming a test: is the build complete?")
    return verdict
