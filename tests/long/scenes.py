# SPDX-License-Identifier: Apache-2.0
"""The scenes of the long runs, and one run of a scene with its memory watched."""

import csv
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

SCENES = pathlib.Path(__file__).resolve().parents[2] / "sample_scenes"
G, TURN, TURN_STEPS = 9.81, math.pi / 8, 50
SLOPE = 0.28  # [rad]


class Scene:
    """A scene file with gravity of its own. Walls do not move, restitution is 0, grains begin at rest."""

    def __init__(self, file, walls, gravity, inside, rests, table="", settings=()):
        self.file = file        # of sample_scenes, and of its packing
        self.walls = walls      # bodies before the first grain
        self.gravity = gravity  # of step k = 1, 2, ... [m/s^2]
        self.inside = inside    # holds for the centre of a grain that was not lost
        self.rests = rests      # grains come to rest; otherwise they move for ever
        self.table = table      # [gravity] instead of the file's
        self.settings = settings  # of nscdd run

    def write(self, steps, folder):
        """The scene file, in a folder with its packing."""
        (folder / "packings").mkdir()
        shutil.copy(SCENES / "packings" / f"{self.file}.csv", folder / "packings")
        text = (SCENES / f"{self.file}.toml").read_text()
        if self.table:
            text = re.sub(r"(?m)^\[gravity\]\n(?:[^\[\n].*\n|\n)*", lambda match: f"[gravity]\n{self.table(steps)}\n\n", text)
        (folder / f"{self.file}.toml").write_text(text)
        return folder / f"{self.file}.toml"

    def mass(self):
        """Of all grains [kg]; their density is 1."""
        with open(SCENES / "packings" / f"{self.file}.csv", newline="") as file:
            return sum(math.pi * float(row["radius"]) ** 2 for row in csv.DictReader(file))


def at_angle(a):
    return G * math.sin(a), -G * math.cos(a)


def in_box(x, y):
    return -1 < x < 45 and -1 < y < 80


def rotating_box(_):
    def gravity(k):
        return at_angle(TURN - 2 * TURN * min(k - 1, TURN_STEPS - 1) / (TURN_STEPS - 1))

    return Scene("rotating_box_730", 3, gravity, in_box, True)


def rocking_box(_):
    """The same box, but gravity goes to and fro for ever: g_x is a triangle wave of 100 steps. Contacts that never open gather
    the solver's residual, so interpenetration is undone by feedback."""

    def gravity(k):
        phase = (k - 1) % (2 * TURN_STEPS) / TURN_STEPS
        return G * math.sin(TURN) * (1 - 2 * min(phase, 2 - phase)), -G * math.cos(TURN)

    def table(steps):
        vectors = (gravity(1 + k) for k in range(0, steps + TURN_STEPS, TURN_STEPS))
        rows = (f"[{0.01 * TURN_STEPS * i:.1f}, {x!r}, {y!r}]" for i, (x, y) in enumerate(vectors))
        return f'kind = "table"\ntable = [{", ".join(rows)}]'

    return Scene("rotating_box_730", 3, gravity, in_box, False, table, ("--option", "normal_law=feedback"))


def sloped_flow(slope):
    gravity = at_angle(-slope)
    return Scene("sloped_flow_750", 60, lambda k: gravity, lambda x, y: -1 < y < 200, False,
                 lambda steps: f"vector = {list(gravity)}")


ALL = {"rotating_box_730": rotating_box, "sloped_flow_750": sloped_flow, "rocking_box_730": rocking_box}


def resident(pid):
    """Resident set of a process [kB]; 0 when it is gone."""
    try:
        with open(f"/proc/{pid}/status") as file:
            return next((int(line.split()[1]) for line in file if line.startswith("VmRSS:")), 0)
    except OSError:
        return 0


def last_step(path):
    """Step of the last complete row of a file that grows; 0 if there is none."""
    try:
        with open(path, "rb") as file:
            file.seek(max(0, os.path.getsize(path) - 4096))
            return int(file.read().split(b"\n")[-2].split(b",")[0])
    except (OSError, ValueError, IndexError):
        return 0


class Run:
    """A finished run: rows of steps.csv, and samples (step, resident kB) four times a second."""

    def __init__(self, scene, program, steps, settings, folder):
        self.scene, self.steps, self.samples = scene, steps, []
        out, start = folder / "out", time.monotonic()
        command = [program, "run", scene.write(steps, folder), "--steps", steps, "--save-every", steps, "--quiet",
                   "--out", out]
        process = subprocess.Popen([*map(str, command), *(settings or scene.settings)], stdin=subprocess.DEVNULL)
        while process.poll() is None:
            memory, step = resident(process.pid), last_step(out / "steps.csv.part")
            if memory and step:
                self.samples.append((step, memory))
            time.sleep(0.25)
        self.seconds = time.monotonic() - start
        if process.returncode != 0:
            sys.exit(f"{scene.file} ended with exit code {process.returncode}.")
        with open(out / "steps.csv", newline="") as file:
            self.rows = list(csv.DictReader(file))
        with open(out / "final.csv", newline="") as file:
            self.grains = [row for row in csv.DictReader(file) if int(row["id"]) >= scene.walls]

    def lost(self):
        return sum(not self.scene.inside(float(g["x"]), float(g["y"])) for g in self.grains)

    def mean_radius(self):
        return float(self.rows[-1]["mean_radius"])
