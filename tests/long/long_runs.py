#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs scenes for very many steps: interpenetration, energy, speed and memory must stay bounded, and no step may diverge.

    tests/long/long_runs.py [--steps 100000] [--scenes NAME ...] [--slope 0.33] [--out results/long] [-- --tolerance 1e-4 ...]
    tests/long/long_runs.py --energy [--steps 100000]

What stands behind `--` goes to `nscdd run`; without it each scene is solved as its file says. Writes NAME.csv (500 rows),
long_runs.png and a sentence for each bound; the exit code is 1 if one is broken. --energy runs the suite's balance of each
step's energy, on a resting pile and in a drum, for so many steps.
"""

import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import digest
import verdict
from pictures import draw
from scenes import ALL, SLOPE, Run

FIGURES = ("steps", "largest_defect", "largest_rise", "highest_energy", "energy_at_half", "energy_at_end", "work_of_walls",
           "sources")
SOURCE = pathlib.Path(__file__).resolve().parents[2]


def energy(program, steps):
    """The tests Balance.*InALongRun with more steps: prints their figures; their exit code."""
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder, "report.json")
        done = subprocess.run([program, "--gtest_filter=Balance.*InALongRun", f"--gtest_output=json:{report}"], check=False,
                              env=dict(os.environ, NSCDD_BALANCE_STEPS=str(steps)), stdout=subprocess.PIPE, text=True)
        tests = json.loads(report.read_text())["testsuites"][0]["testsuite"]
    names = [name for name in tests[0] if name in FIGURES]
    print("| [m g r of a grain] | " + " | ".join(name.replace("_", " ") for name in names) + " |")
    print("| --- " * (len(names) + 1) + "|")
    for test in tests:
        print(f"| {test['name']} | " + " | ".join(test[name] for name in names) + " |")
    if done.returncode != 0:
        print(done.stdout)
    return done.returncode


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--steps", type=int, default=100000)
    parser.add_argument("--scenes", nargs="+", choices=ALL, default=list(ALL))
    parser.add_argument("--slope", type=float, default=SLOPE, help=f"of sloped_flow_750 [rad]; {SLOPE}, in the file pi/6")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("results/long"),
                        help="folder of digests and picture")
    parser.add_argument("--build", type=pathlib.Path, default=SOURCE / "build/release/bin", help="folder of the programs")
    parser.add_argument("--energy", action="store_true", help="the balance of energy instead")
    parser.add_argument("settings", nargs="*", help="of nscdd run, behind --")
    options = parser.parse_args()
    if options.energy:
        return energy(options.build / "unit_core", options.steps)
    if options.steps < 2000:
        parser.error("bounds compare quarters of a run: take 2000 steps or more.")
    options.out.mkdir(parents=True, exist_ok=True)
    broken = 0
    for name in options.scenes:
        with tempfile.TemporaryDirectory() as folder:
            run = Run(ALL[name](options.slope), options.build / "nscdd", options.steps, options.settings, pathlib.Path(folder))
            table = digest.make(run)
            digest.write(options.out / f"{name}.csv", table)
            print(f"{name}: {options.steps} steps in {run.seconds:.0f} s")
            for holds, sentence in verdict.bounds(run, table):
                broken += not holds
                print(f"  {'holds ' if holds else 'BROKEN'} {sentence}", flush=True)
    draw(options.out, [name for name in ALL if (options.out / f"{name}.csv").exists()])
    return 1 if broken else 0


if __name__ == "__main__":
    sys.exit(main())
