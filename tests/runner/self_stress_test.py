# SPDX-License-Identifier: Apache-2.0
"""The acceleration leaves a jammed pile the forces that its load causes: impulses do not drift along self-stresses (H s = 0),
which change no velocity and which a warm start would keep."""

import unittest

import h5py
import self_stress
from program import ProgramTest, nscdd

SOLVER = """
[solver]
tolerance = 1e-6
max_iterations = 5000
"""
PILE = self_stress.WALLS.replace("steps = 1\n", "steps = 300\n") + self_stress.BODIES + SOLVER
SIDES = (1, 2)  # ids of the two upright walls


class SelfStress(ProgramTest):
    def side_impulse(self, name, acceleration, *arguments):
        """Sum of r_n on the side walls in the last step, in N s."""
        out = self.folder / f"{name}_{acceleration}"
        done = nscdd("run", self.write("pile.toml", PILE), "--out", out, "--quiet", "--acceleration", acceleration, *arguments)
        self.assertEqual(done.returncode, 0, done.stderr)
        with h5py.File(out / "results.h5") as file:
            contacts = file["steps/000300/contacts"]
            return sum(r for wall, r in zip(contacts["body_a"][:], contacts["impulse_n"][:]) if wall in SIDES)

    def test_side_forces_are_those_of_plain_sweeps(self):
        for name, arguments in {"nscd": ("--solver", "nscd"),
                                "nscdd": ("--solver", "nscdd", "--subdomains", "2x2"),
                                "fea": ("--solver", "fea", "--subdomains", "2x2")}.items():
            with self.subTest(name):
                plain, fast = (self.side_impulse(name, a, *arguments) for a in ("none", "anderson"))
                self.assertLess(fast, 1.25 * plain)
                self.assertGreater(fast, 0.75 * plain)

    def test_single_steps(self):
        """A short version of self_stress.py."""
        worst = self_stress.measure(3, ["1e-4", "1e-6"], settle=200)
        self.assertEqual(len(worst), 6)
        for key, (norm, walls, count) in worst.items():
            with self.subTest(key):
                self.assertEqual(count, 3)
                self.assertLess(norm, self_stress.BOUND)
                self.assertLess(walls, self_stress.BOUND)


if __name__ == "__main__":
    unittest.main()
