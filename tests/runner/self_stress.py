#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whether the acceleration inflates impulses along self-stresses: single steps of a jammed pile, each from one saved state,
with and without it. Prints, for every solver and tolerance, the largest ratios of |r|_D (D = diag W) and of the sum of r_n on
the walls, accelerated over plain; exit code 1 where one is above the bound.

    tests/runner/self_stress.py --steps 200                    # the program: build/release/bin/nscdd, or NSCDD=...
    tests/runner/self_stress.py --steps 200 --tolerance 1e-8   # steps that 1e6 plain sweeps solve
"""

import argparse
import math
import pathlib
import shutil
import sys
import tempfile

import h5py
from program import nscdd, read_csv

WALLS = """
[scene]
name = "pile"
[time]
dt = 0.005
steps = 1
[[materials]]
name = "grain"
friction = 0.5
"""
BODIES = """
[[walls]]
type = "half_plane"
point = [0, 0]
[[walls]]
type = "half_plane"
point = [0, 0]
normal = [1, 0]
[[walls]]
type = "half_plane"
point = [5, 0]
normal = [-1, 0]
[[depositions]]
count = 20
x = [0, 5]
bottom = 0
radius = [0.4, 1.0]
seed = 6
"""
SOLVERS = {"nscd": ("--solver", "nscd"), "nscdd": ("--solver", "nscdd", "--subdomains", "2x2"),
           "fea": ("--solver", "fea", "--subdomains", "2x2")}
BOUND = 1.25


class Study:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)

    def run(self, out, scene, *arguments):
        shutil.rmtree(self.folder / out, ignore_errors=True)
        path = self.folder / "pile.toml"
        path.write_text(scene)
        done = nscdd("run", path, "--quiet", "--out", self.folder / out, *arguments)
        if done.returncode != 0:
            sys.exit(f"self_stress.py: {done.stderr}")
        return self.folder / out

    def step(self, out, state, *arguments):
        """One step from a saved state."""
        return self.run(out, f'{WALLS}[start]\nstate = "{state}"\n', "--steps", 1, *arguments)


def norms(out):
    """(|r|_D, sum of r_n on the walls) of the last saved step; disks of density 1."""
    with h5py.File(out / "results.h5") as file:
        step = file["steps"][sorted(file["steps"])[-1]]
        radius = {i: r for i, r in zip(step["grains/id"][:], step["grains/radius"][:]) if r > 0}  # 0: walls
        c = {name: step["contacts"][name][:] for name in
             ("body_a", "body_b", "lever_a", "lever_b", "impulse_n", "impulse_t")}
    energy = walls = 0.0
    for a, b, la, lb, rn, rt in zip(*c.values()):
        wnn = wtt = 0.0
        for body, lever in ((a, la), (b, lb)):
            if body not in radius:
                walls += rn
                continue
            mass = math.pi * radius[body] ** 2
            wnn += 1 / mass
            wtt += 1 / mass + lever ** 2 / (0.5 * mass * radius[body] ** 2)
        energy += wnn * rn ** 2 + wtt * rt ** 2
    return math.sqrt(energy), walls


def measure(steps, tolerances, settle=300):
    """The largest ratios by (solver, tolerance): (of |r|_D, of the walls, steps compared)."""
    worst = {}
    with tempfile.TemporaryDirectory() as folder:
        study = Study(folder)
        plain = ("--acceleration", "none", "--tolerance", "1e-6", "--max-iterations", 20000)
        out = study.run("settle", WALLS + BODIES, "--steps", settle, *plain)
        state = study.folder / "state.h5"
        for _ in range(steps):
            shutil.copy(out / "state.h5", state)
            for name, arguments in SOLVERS.items():
                for tolerance in tolerances:
                    both = []
                    for acceleration in ("none", "anderson"):
                        most = 1000000 if acceleration == "none" else 20000
                        one = study.step("one", state, *arguments, "--acceleration", acceleration, "--tolerance", tolerance,
                                         "--max-iterations", most, "--option", "stall_iterations=1000000")
                        both.append((*norms(one), read_csv(one / "steps.csv")[-1]["status"]))
                    if both[0][2] != "converged":
                        continue
                    ratio = worst.get((name, tolerance), (0.0, 0.0, 0))
                    worst[name, tolerance] = (max(ratio[0], both[1][0] / both[0][0]), max(ratio[1], both[1][1] / both[0][1]),
                                              ratio[2] + 1)
            out = study.step("next", state, *plain)
    return worst


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--steps", type=int, default=200)
    parser.add_argument("--tolerance", action="append", help="default: 1e-4 and 1e-6")
    arguments = parser.parse_args()
    worst = measure(arguments.steps, arguments.tolerance or ["1e-4", "1e-6"])
    print("solver  tolerance  steps  |r|_D  walls     (largest ratio, accelerated over plain)")
    for (name, tolerance), (norm, walls, count) in worst.items():
        print(f"{name:7} {tolerance:>9} {count:6d} {norm:6.3f} {walls:6.3f}")
    return 1 if any(max(norm, walls) > BOUND for norm, walls, _ in worst.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
