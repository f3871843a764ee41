# SPDX-License-Identifier: Apache-2.0
"""A copy of the checkout in a folder of its own, with its own build: the user's tree is never touched."""

import json
import os
import pathlib
import re
import subprocess

from fault import FaultError

# mpirun as root, and with more ranks than cores.
MPI = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_mpi_yield_when_idle": "1",
       "OMPI_MCA_rmaps_base_oversubscribe": "1"}


class BuildError(Exception):
    """The last lines that the compiler said."""


MARK = ".mutation_copy"  # in a folder that may be overwritten


class WorkCopy:
    def __init__(self, source, folder, preset, jobs):
        self.source = source
        self.folder = folder
        self.preset = preset
        self.jobs = jobs
        self.build_folder = folder / "build" / preset
        self.outputs = set()  # of the build, relative to its folder
        self.environment = {**os.environ, **MPI, "CCACHE_BASEDIR": str(folder), "PYTHONDONTWRITEBYTECODE": "1"}

    def update(self):
        """Makes the copy equal to the checkout, as it is now; files that are equal keep their time."""
        if any(self.folder.iterdir()) and not (self.folder / MARK).exists():
            raise FaultError(f"{self.folder} is not empty and no copy of an earlier time: give a new folder.")
        (self.folder / MARK).touch()
        listed = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=self.source,
                                capture_output=True, check=True).stdout
        names = {name for name in os.fsdecode(listed).split("\0") if name and (self.source / name).is_file()}
        for path in [p for p in self.folder.rglob("*") if p.is_file() and self.folder / "build" not in p.parents]:
            if path.relative_to(self.folder).as_posix() not in names | {MARK}:
                path.unlink()
        for name in sorted(names):
            self.write(name, (self.source / name).read_bytes())
            (self.folder / name).chmod((self.source / name).stat().st_mode)

    def write(self, name, content):
        path = self.folder / name
        if path.is_file() and path.read_bytes() == content:
            return
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)

    def spoil(self, fault):
        text = (self.source / fault.file).read_text(encoding="utf-8")
        self.write(fault.file, fault.spoiled(text).encode())

    def restore(self, fault):
        self.write(fault.file, (self.source / fault.file).read_bytes())

    def run(self, command):
        done = subprocess.run(command, cwd=self.folder, env=self.environment, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, check=False)
        if done.returncode != 0:
            raise BuildError("\n".join(done.stdout.splitlines()[-20:]))
        return done.stdout

    def configure(self):
        self.run(["cmake", "--preset", self.preset])
        listed = self.run(["ninja", "-C", str(self.build_folder), "-t", "targets", "all"])
        self.outputs = {line.partition(": ")[0] for line in listed.splitlines()}

    def build(self, outputs=()):
        """Builds these outputs of the build, by path; all without any."""
        self.run(["ninja", "-C", str(self.build_folder), "-j", str(self.jobs), *outputs])

    def tests(self):
        """Name and needed outputs of each test, in the order of ctest's numbers."""
        listed = subprocess.run(["ctest", "--show-only=json-v1"], cwd=self.build_folder, env=self.environment, text=True,
                                capture_output=True, check=True).stdout
        # Of parameters without a name GoogleTest prints the bytes, which are not always the same.
        bytes_of_parameter = re.compile(r"(  # |/\d+-byte object ).*")
        return [(bytes_of_parameter.sub("", test["name"]), self.outputs_of(test)) for test in json.loads(listed)["tests"]]

    def outputs_of(self, test):
        """The outputs of the build that a test's command or environment names."""
        words = list(test.get("command", []))
        for entry in test.get("properties", []):
            if entry["name"] == "ENVIRONMENT":
                words += [variable.partition("=")[2] for variable in entry["value"]]
        paths = [pathlib.Path(word) for word in words]
        ours = {path.relative_to(self.build_folder).as_posix() for path in paths if self.build_folder in path.parents}
        return ours & self.outputs

    def outputs_for(self, fault, tests):
        """What the tests that are expected to catch a fault need."""
        found = set().union(*(outputs for name, outputs in tests if fault.expects(name)))
        if not found:
            raise FaultError(f"no test has a name like {fault.tests}, as fault {fault.name} expects: adapt faults.toml.")
        return sorted(found)
