#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Each bound of a long run, with a run that keeps to all of them and one that breaks it."""

import unittest

import digest
import scenes
import verdict

STEPS = 2000


class Made:
    """Rows as nscdd would write them, of grains at rest in the box or moving for ever; `spoil` changes row k."""

    def __init__(self, rests, spoil=lambda k, row: None, memory=lambda k: 28000, grain=("1.0", "1.0")):
        self.scene = scenes.rotating_box(0.0) if rests else scenes.rocking_box(0.0)
        self.steps = STEPS
        self.samples = [(k, memory(k)) for k in range(1, STEPS + 1, 10)]
        self.rows = []
        for k in range(1, STEPS + 1):
            row = {"step": k, "time": 0.01 * k, "kinetic_energy": 0.0 if rests else 1.0, "momentum_x": 0.0, "momentum_y": 0.0,
                   "mean_interpenetration": 1e-4, "max_interpenetration": 1e-3, "mean_radius": 1.0, "contacts": 1500,
                   "sweeps": 3, "status": "converged", "max_drift": 0.01}
            spoil(k, row)
            self.rows.append(row)
        self.grains = [dict(zip("xy", grain))]

    def mean_radius(self):
        return 1.0

    def lost(self):
        return scenes.Run.lost(self)


def broken(run):
    return [sentence for holds, sentence in verdict.bounds(run, digest.make(run)) if not holds]


def change(name, value, steps=lambda k: True):
    """Spoils a column, by a function of the step, in some steps."""
    return lambda k, row: row.update({name: value(k)}) if steps(k) else None


class Verdict(unittest.TestCase):
    def expect(self, run, word):
        sentences = broken(run)
        self.assertEqual(len(sentences), 1, sentences)
        self.assertIn(word, sentences[0])

    def test_a_good_run_holds(self):
        self.assertEqual(broken(Made(True)), [])
        self.assertEqual(broken(Made(False)), [])

    def test_each_bound_can_break(self):
        self.expect(Made(True, change("status", lambda k: "diverged", lambda k: k == 700)), "diverged")
        self.expect(Made(True, change("status", lambda k: "stalled", lambda k: k % 50 == 0)), "missed")
        self.expect(Made(True, grain=("50.0", "1.0")), "lost")
        self.expect(Made(True, change("mean_interpenetration", lambda k: 1e-7 * k)), "mean interpenetration")
        self.expect(Made(True, change("max_interpenetration", lambda k: 0.2, lambda k: k == 3)), "largest interpenetration")
        self.expect(Made(True, change("max_drift", lambda k: 1.5, lambda k: k == 3)), "moved further")
        self.expect(Made(True, memory=lambda k: 28000 + k), "memory")
        self.expect(Made(True, change("kinetic_energy", lambda k: 1.0)), "at rest")
        self.expect(Made(False, change("kinetic_energy", lambda k: 0.01 * k)), "kinetic energy does not grow")
        self.expect(Made(True, change("kinetic_energy", lambda k: 1e3, lambda k: k == 3)), "never rises")
        self.expect(Made(True, change("momentum_y", lambda k: -10.0, lambda k: k > 100)), "no creep")


if __name__ == "__main__":
    unittest.main()
