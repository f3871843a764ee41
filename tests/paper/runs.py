# SPDX-License-Identifier: Apache-2.0
"""Runs nscdd for the study and reads what it wrote. Python's standard library only."""

import csv
import os
import pathlib
import shutil
import statistics
import subprocess
import sys

SOURCE = pathlib.Path(__file__).resolve().parents[2]
ENVIRONMENT = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                   OMPI_MCA_mpi_yield_when_idle="1", OMPI_MCA_rmaps_base_oversubscribe="1")
SCENES = {0.0: "rotating_box_730_frictionless", 0.3: "rotating_box_730"}
FLOW = "sloped_flow_750"
QM16 = {"criterion": "qm16", "tolerance": "1.666e-4", "test_every": 1}


class Run:
    """One finished run: its rows of steps.csv, numbers where they are numbers."""

    def __init__(self, folder):
        self.folder = folder
        with open(folder / "steps.csv", newline="") as file:
            self.rows = [{k: self._number(v) for k, v in row.items()} for row in csv.DictReader(file)]

    @staticmethod
    def _number(text):
        try:
            return float(text)
        except ValueError:
            return text

    def column(self, name):
        return [row[name] for row in self.rows]

    def mean(self, name):
        return statistics.fmean(self.column(name))

    def largest(self, name):
        return max(self.column(name))

    def total(self, name):
        return sum(self.column(name))

    def last(self, name):
        return self.rows[-1][name]

    def statuses(self):
        return set(self.column("status"))


# What the paper does not have, off: its iterations are plain ones, its steps have one stage.
PLAIN = {"nscd": {"acceleration": "none"}, "nscdd": {"acceleration": "none"},
         "fea": {"acceleration": "none", "jump_guard": "false"}}
LAW = {"normal_law": "gap"}


class Program:
    """The program under study, and the folder that keeps every run."""

    def __init__(self, nscdd, out):
        self.nscdd = nscdd
        self.out = out
        self.count = 0

    def run(self, scene, solver, steps=None, ranks=0, cold=False, save_every=None, **options):
        """Runs a scene; options of the solver by name, beside PLAIN. Throws CalledProcessError if the program refuses."""
        self.count += 1
        name = "_".join([scene, solver, f"r{ranks}"] + [f"{k}{v}" for k, v in options.items() if k not in QM16])
        folder = self.out / "runs" / f"{self.count:04d}_{name}"
        command = [self.nscdd, "run", SOURCE / "sample_scenes" / f"{scene}.toml", "--quiet", "--solver", solver, "--out",
                   folder]
        if ranks:
            command = ["mpirun", "--oversubscribe", "-n", ranks] + command
        if steps:
            command += ["--steps", steps]
        if cold:
            command += ["--cold"]
        if save_every:
            command += ["--save-every", save_every]
        for key, value in (LAW | PLAIN.get(solver, {}) | options).items():
            command += ["--option", f"{key}={value}"]
        if sys.stderr.isatty():
            print(f"\r\033[K{self.count:4d}  {name}", end="", file=sys.stderr, flush=True)
        subprocess.run([str(c) for c in command], env=ENVIRONMENT, check=True, stdout=subprocess.DEVNULL)
        return Run(folder)

    def render(self, run, step, show, output):
        subprocess.run([self.nscdd, "render", run.folder, "--step", str(step), "--show", show, "-o", output], check=True,
                       stdout=subprocess.DEVNULL)


def find_program(given):
    """Path of nscdd: the argument, or the release build's."""
    path = pathlib.Path(given) if given else SOURCE / "build/release/bin/nscdd"
    if not path.exists():
        sys.exit(f"{path} is not there: build it first (./demo.sh), or name it with --nscdd")
    return str(path)


def need_gnuplot():
    if shutil.which("gnuplot") is None:
        sys.exit("gnuplot is missing: apt-get install gnuplot-nox")
