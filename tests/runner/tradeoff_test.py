# SPDX-License-Identifier: Apache-2.0
"""nscdd tradeoff on a scene of a few dozen disks, and solver "auto"."""

import json
import math
import os
import re
import signal
import subprocess
import time
import unittest

from program import NSCDD, SCENES, ProgramTest, nscdd, read_csv

HEAP = """
[scene]
name = "heap"
[time]
dt = 0.01
steps = 6
[[materials]]
name = "grain"
friction = 0.3
[[walls]]
type = "segments"
points = [[0.0, 20.0], [0.0, 0.0], [12.0, 0.0], [12.0, 20.0]]
[[depositions]]
count = 40
x = [0.0, 12.0]
bottom = 0.0
radius = [0.7, 1.3]
seed = 2
[solver]
name = "nscdd"
subdomains = [2, 1]
tolerance = 1e-5
alert_distance = 0.15
"""

# Box2D's boxes and a resting disk: the same on walls of segments, which have a skin there, and of disks, which have none.
BOX = """
[time]
dt = 0.01
steps = 400
[[lattices]]
count = 40
x = [0.0, 8.0]
bottom = 0.0
radius = [0.4, 0.6]
seed = 3
[[materials]]
name = "g"
friction = 0.0
[[walls]]
"""
OF_SEGMENTS = 'type = "segments"\npoints = [[0.0, 20.0], [0.0, 0.0], [8.0, 0.0], [8.0, 20.0]]\n'
OF_DISKS = 'type = "disks"\nradius = 0.5\npoints = [[-0.5, 20.0], [-0.5, -0.5], [8.5, -0.5], [8.5, 20.0]]\n'
BOX2D = "".join(f'[[settings]]\nname = "b{v}"\nsolver = "box2d"\nvelocity_iterations = {v}\nposition_iterations = {p}\n'
                for v, p in ((8, 3), (200, 50)))

NUMBERS_OF_TIME = {"seconds", "seconds_least", "seconds_most"}


class Tradeoff(ProgramTest):
    def measure(self, *arguments, scene=HEAP, out="out"):
        done = nscdd("tradeoff", self.write("heap.toml", scene), "--quick", "--out", self.folder / out, *arguments,
                     timeout=1800)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout, read_csv(self.folder / out / "tradeoff.csv")

    def test_rows_of_both_adapters(self):
        for adapter in ("box2d", "reference"):
            with self.subTest(adapter=adapter):
                text, rows = self.measure("--adapter", adapter, "--budget", "1", out=adapter)
                by = {(r["view"], r["setting"]): r for r in rows}
                self.assertEqual(len(by), len(rows))
                solvers = {r["solver"] for r in rows}
                self.assertLessEqual({"nscd", "nscdd", "fea", "iea", "box2d"}, solvers)
                for row in rows:
                    self.assertIn(row["status"], {"converged", "fixed", "incomplete", "iteration_limit"}, row)
                    self.assertEqual(int(row["steps"]), 3 if row["view"] == "problems" else 5)
                    self.assertGreater(float(row["seconds"]), 0.0)
                    self.assertEqual(row["velocity_error"] == "", row["view"] == "runs")
                self.check_facts(by)
                self.check_boxes(by)
                self.assertIn("Beside Box2D's own solver", text)
                self.assertIn("# the most accurate within 1e+03 ms a step", text)

    def check_facts(self, by):
        """What must hold on any machine."""
        own = by["runs", "the scene's own"]
        self.assertEqual(own["solver"], "nscdd")
        self.assertIn("subdomains=2x1", own["options"])
        self.assertGreater(float(own["exchanges"]), 0)
        for view in ("problems", "runs"):
            rows = [by[view, f"nscd nat 1e-{k}"] for k in (2, 4, 6)]
            nats = [float(r["nat_worst"]) for r in rows]
            for k, row in zip((2, 4, 6), rows):
                if row["status"] == "converged":
                    self.assertLessEqual(float(row["nat_worst"]), 10.0 ** -k)
            self.assertGreater(nats[0], nats[1])
            self.assertGreater(nats[1], nats[2])
            self.assertLess(float(rows[0]["sweeps"]), float(rows[2]["sweeps"]))
            self.assertLess(float(rows[2]["solver_growth_max"]), float(rows[0]["solver_growth_max"]))
            self.assertEqual(float(by[view, "nscd 20 its"]["sweeps"]), 20)
            self.assertEqual(by[view, "nscd 20 its"]["status"], "fixed")
            for row in rows:
                self.assertLess(float(row["momentum_defect"]), 1e-10)
        errors = [float(by["problems", f"nscd nat 1e-{k}"]["velocity_error_worst"]) for k in (2, 4, 6)]
        self.assertGreater(errors[0], errors[2])
        self.assertEqual(float(by["runs", "nscd 5 its x 4 substeps"]["sweeps"]), 20)

    def check_boxes(self, by):
        self.assertNotIn(("problems", "Box2D 8/3"), by)
        box = by["runs", "Box2D 8/3"]
        self.assertEqual(box["status"], "fixed")
        self.assertLess(float(box["momentum_defect"]), 1e-4)  # keys, frames and signs of its impulses are matched
        self.assertGreater(float(box["nat"]), float(by["runs", "nscd nat 1e-4"]["nat"]))

    def test_repeatable_but_for_the_seconds(self):
        def without_time(rows):
            return [{k: v for k, v in row.items() if k not in NUMBERS_OF_TIME} for row in rows]
        one, two = self.measure(out="one")[1], self.measure(out="two")[1]
        self.assertEqual(without_time(one), without_time(two))

    def test_sections_can_be_pasted(self):
        text, _ = self.measure("--solvers", "nscd,nscdd,fea", "--budget", "1")
        sections = re.findall(r"^\[solver\]\n(?:[^\n#]+\n)+", text, re.MULTILINE)
        self.assertGreaterEqual(len(sections), 2)
        for section in sections:
            done = nscdd("check", self.write("pasted.toml", HEAP[:HEAP.index("[solver]")] + section))
            self.assertEqual(done.returncode, 0, section + done.stderr)

    def test_files(self):
        self.measure("--solvers", "nscd", "--store")
        names = {p.name for p in (self.folder / "out").iterdir()}
        self.assertLessEqual({"tradeoff.csv", "tradeoff.txt", "tradeoff.gp", "heap.front.csv"}, names)
        front = read_csv(self.folder / "heap.front.csv")
        self.assertEqual(front, read_csv(self.folder / "out/heap.front.csv"))
        seconds = [float(r["seconds"]) for r in front]
        depths = [float(r["interpenetration_max"]) for r in front]
        self.assertEqual(seconds, sorted(seconds))
        self.assertEqual(depths, sorted(depths, reverse=True))
        done = nscdd("run", self.write("heap.toml", HEAP), "--solver", "auto", "--subdomains", "1x1", "--out",
                     self.folder / "run")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("heap.front.csv", done.stdout)

    def test_plot_or_a_sentence(self):
        self.measure("--solvers", "nscd")
        scene = self.write("heap.toml", HEAP)
        alone = subprocess.run([NSCDD, "tradeoff", scene, "--quick", "--solvers", "nscd", "--out", self.folder / "none"],
                               env={**os.environ, "PATH": "/nowhere"}, text=True, capture_output=True, check=False)
        self.assertEqual(alone.returncode, 0, alone.stderr)
        self.assertIn("no plot: gnuplot is not installed", alone.stdout)

    def runs_of(self, name, scene, settings, *arguments):
        out = self.folder / name
        done = nscdd("tradeoff", self.write(f"{name}.toml", scene), "--settings", self.write("settings.toml", settings),
                     "--problems", 1,
                     "--repetitions", 0, "--out", out, *arguments, timeout=1800)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout, {r["setting"]: r for r in read_csv(out / "tradeoff.csv") if r["view"] == "runs"}

    def test_box2d_is_measured_on_its_own_surface(self):
        nat = {}
        for name, walls in (("segments", OF_SEGMENTS), ("disks", OF_DISKS)):
            text, rows = self.runs_of(name, BOX + walls, BOX2D, "--steps", 1600)  # in the median at rest
            self.assertIn("with its own surface", text)
            self.assertIn("not more quality on piles", text)
            nat[name] = {b: float(rows[b]["nat"]) for b in ("b8", "b200")}
        self.assertLess(abs(math.log10(nat["segments"]["b200"] / nat["disks"]["b200"])), 1, nat)
        self.assertLess(max(nat["segments"]["b8"], nat["disks"]["b8"]), 1e-3, nat)  # their sweeps leave as much

    def test_measured_steps_are_spread_over_the_scene(self):
        text, rows = self.runs_of("long", HEAP.replace("steps = 6", "steps = 60"), BOX2D, "--steps", 12)
        self.assertIn("# rests on 12 of the scene's 60 steps (in 5 stretches: 1-2, 13-14, 25-27, 37-38, 49-51)", text)
        self.assertEqual({r["steps"] for r in rows.values()}, {"12"})
        self.assertIn("(1-6)", self.runs_of("short", HEAP, BOX2D)[0])

    def test_stretches_go_on_as_one_run_does(self):
        """A setting as accurate as the scouting run meets the same states: its rows are those of the whole run there."""
        scene = HEAP.replace("steps = 6", "steps = 40")
        sharp = ''.join(f'[[settings]]\nname = "{g}"\nsolver = "nscdd"\nsubdomains = [{g}, 1]\ntolerance = 1e-5\n'
                        for g in (1, 2))
        whole = self.runs_of("whole", scene, sharp, "--observable", "kinetic_energy")[1]
        some = self.runs_of("some", scene, sharp, "--steps", 20, "--observable", "kinetic_energy")[1]
        for setting in ("1", "2"):
            self.assertEqual(some[setting]["status"], "converged")
            self.assertLess(float(some[setting]["interpenetration_max"]),
                            2 * float(whole[setting]["interpenetration_max"]) + 1e-4)
            self.assertLess(float(some[setting]["sweeps"]), 2 * float(whole[setting]["sweeps"]))  # impulses are those of a run
            self.assertLess(float(some[setting]["observable_error"]), 1e-3)

    def test_what_is_advised_does_as_asked(self):
        """Also over the whole scene: neither advice nor front has a setting that fell short, and a fixed number is no
        failure."""
        scene = HEAP.replace("steps = 6", "steps = 40")
        mine = ('[[settings]]\nname = "short"\nsolver = "nscd"\ntolerance = 1e-12\nmax_iterations = 7\n'
                '[[settings]]\nname = "five"\nsolver = "nscd"\ntolerance = 0\nmax_iterations = 5\ntest_every = 5\n')
        text, rows = self.runs_of("long", scene, mine, "--steps", 10, "--store")
        self.assertEqual(rows["short"]["status"], "iteration_limit")
        self.assertEqual(rows["five"]["status"], "fixed")
        self.assertNotIn(": short, ", text)
        self.assertNotIn("short", (self.folder / "long.front.csv").read_text())
        sections = re.findall(r"^\[solver\]\n(?:[^\n#]+\n)+", text, re.MULTILINE)
        self.assertTrue(any("tolerance = 0\n" in s for s in sections), text)
        for k, section in enumerate(sections):
            done = nscdd("run", self.write("pasted.toml", scene[:scene.index("[solver]")] + section), "--out",
                         self.folder / f"run{k}")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertNotIn("NOT CONVERGED", done.stdout)
            if "tolerance = 0\n" not in section:
                continue
            self.assertIn("FIXED: in 40 steps", done.stdout)
            self.assertIn("none: 5 iterations", done.stdout)
            self.assertEqual({r["status"] for r in read_csv(self.folder / f"run{k}/steps.csv")}, {"fixed"})

    def test_settings_of_the_user(self):
        mine = self.write("mine.toml", '[[settings]]\nname = "mine"\nsolver = "nscd"\ntolerance = 1e-3\n'
                          '[[settings]]\nname = "unknown"\nsolver = "nscd"\nsubdomains = [2, 2]\n')
        text, rows = self.measure("--settings", mine)
        self.assertEqual([(r["view"], r["setting"]) for r in rows],
                         [(v, s) for s in ("the scene's own", "mine") for v in ("problems", "runs")])
        self.assertIn("left out 1 setting: solver 'nscd' has no option 'subdomains'", text)

    def test_diverging_settings_are_shown_as_such(self):
        mine = self.write("mine.toml", '[[settings]]\nname = "wild"\nsolver = "fea"\nsubdomains = [2, 2]\nlambda = 1e8\n'
                          'sweeps_per_stage = 1\nmax_iterations = 30\n'
                          '[[settings]]\nname = "short"\nsolver = "nscd"\ntolerance = 1e-12\nmax_iterations = 3\n')
        text, rows = self.measure("--settings", mine)
        by = {(r["view"], r["setting"]): r for r in rows}
        self.assertIn(by["runs", "wild"]["status"], {"diverged", "iteration_limit", "failed", "stalled"})
        self.assertEqual(by["runs", "short"]["status"], "iteration_limit")
        self.assertEqual(by["runs", "short"]["not_converged"], "5")
        self.assertNotEqual(by["runs", "short"]["reason"], "")
        self.assertIn("iteration_limit 5/5", text)

    def test_periodic_scenes_have_no_box2d(self):
        done = nscdd("tradeoff", SCENES / "sloped_flow_750.toml", "--quick", "--steps", 1, "--repetitions", 0, "--solvers",
                     "nscd,box2d", "--observable", "flow_rate", "--out", self.folder / "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("left out Box2D's own solver: it has no periodic direction", done.stdout)
        self.assertNotIn("box2d", {r["solver"] for r in read_csv(self.folder / "out/tradeoff.csv")})

    def test_clusters_and_moving_walls(self):
        for scene in ("clusters", "drum"):
            done = nscdd("tradeoff", SCENES / f"{scene}.toml", "--quick", "--solvers", "nscd,box2d", "--out",
                         self.folder / scene)
            self.assertEqual(done.returncode, 0, done.stderr)  # among other things: the problem read is the one that was solved

    def test_cold(self):
        text, rows = self.measure("--cold", "--solvers", "nscd")
        warm = self.measure("--solvers", "nscd", out="warm")[1]
        self.assertIn("from zero impulses", text)
        at = [r["setting"] for r in rows].index("nscd nat 1e-4")
        self.assertGreater(float(rows[at]["sweeps"]), float(warm[at]["sweeps"]))

    def test_interrupted(self):
        out = self.folder / "out"
        running = subprocess.Popen([NSCDD, "tradeoff", self.write("heap.toml", HEAP), "--steps", "6", "--repetitions", "100000",
                                    "--time-limit", "100000", "--solvers", "nscd", "--out", out],
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        try:
            deadline = time.monotonic() + 300
            while time.monotonic() < deadline and not (out / "tradeoff.csv").exists():
                time.sleep(0.05)
            time.sleep(1.0)
            running.send_signal(signal.SIGINT)
            text, errors = running.communicate(timeout=300)
        finally:
            running.kill()
        self.assertEqual(running.returncode, 0, errors)
        self.assertIn("interrupted", text)
        self.assertGreaterEqual(len(read_csv(out / "tradeoff.csv")), 1)

    def test_refusals(self):
        scene = self.write("heap.toml", HEAP)
        for arguments, sentence in ((["--observable", "centre_of_mass"], "centre_of_mass_"),
                                    (["--accuracy", "natt"], "did you mean 'nat'"),
                                    (["--settings", self.folder / "none.toml"], "no such"),
                                    (["--settings", self.write("empty.toml", "# nothing\n")], r"has no \[\[settings\]\]"),
                                    (["--settings", self.write("bad.toml", '[[settings]]\nname = "a"\n')], "solver"),
                                    (["--adapter", "bullet"], "unknown")):
            done = nscdd("tradeoff", scene, "--out", self.folder / "out", *arguments)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertRegex(done.stderr, sentence)
        strict = self.write("strict.toml", HEAP + 'normal_law = "strict"\n')
        done = nscdd("tradeoff", strict, "--out", self.folder / "out")
        self.assertEqual(done.returncode, 2)
        self.assertIn("normal_law", done.stderr)


AUTO = HEAP[:HEAP.index("[solver]")].replace("steps = 6", "steps = 20") + """
[solver]
name = "auto"
alert_distance = 0.15
"""


class Auto(ProgramTest):
    def summary(self, out):
        return json.loads((self.folder / out / "run.json").read_text())["summary"]

    def test_a_wish_out_of_reach_escalates(self):
        scene = self.write("heap.toml", AUTO + "accuracy = { interpenetration = 1e-8, of = \"mean_radius\" }\n")
        done = nscdd("run", scene, "--out", self.folder / "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        count = self.summary("out")["escalations"]
        self.assertGreaterEqual(count, 2)
        self.assertRegex(done.stdout, f"AUTO: {count} escalations, last rung 'n")
        self.assertIn("went deeper than wished", done.stdout)
        nats = [float(s["nat"]) for s in read_csv(self.folder / "out/steps.csv")]
        self.assertLess(nats[-1], 0.1 * nats[0])
        self.assertEqual([int(s["step"]) for s in read_csv(self.folder / "out/steps.csv")], list(range(1, 21)))

    def test_an_easy_wish_does_not(self):
        scene = self.write("heap.toml", AUTO + "accuracy = { interpenetration = 0.5, of = \"metre\" }\n")
        done = nscdd("run", scene, "--out", self.folder / "out")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.summary("out"), {"escalations": 0, "descents": 0})
        self.assertIn("no step of 20 went deeper than wished", done.stdout)

    def test_ranks_decide_the_same(self):
        scene = self.write("heap.toml", AUTO + "accuracy = { interpenetration = 1e-8 }\nsubdomains = [2, 2]\n")
        finals = []
        for ranks in (1, 2, 3):
            out = self.run_scene(scene, ranks=ranks, out=f"out{ranks}")
            finals.append((out / "final.csv").read_bytes())
            self.assertGreaterEqual(self.summary(f"out{ranks}")["escalations"], 3)
        self.assertEqual(finals[0], finals[1])
        self.assertEqual(finals[0], finals[2])

    def test_budget_alone(self):
        out = self.run_scene(self.write("heap.toml", AUTO + "budget_seconds_per_step = 1e-9\n"))
        self.assertEqual(self.summary("out")["escalations"], 0)
        self.assertEqual(len(read_csv(out / "steps.csv")), 20)

    def test_check_and_refusals(self):
        done = nscdd("check", self.write("heap.toml", AUTO))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("auto, first rung: nscd", done.stdout)
        for line, sentence in (("accuracy = { interpenetration = -1 }",
                                r"heap.toml:\d+: key 'solver.accuracy.interpenetration'"),
                               ("accuracy = { interpenetration = 1, of = \"mile\" }", "mean_radius"),
                               ("accuracy = { depth = 1 }", "interpenetration"),
                               ("budget_seconds_per_step = 0", "budget_seconds_per_step"),
                               ("tolerence = 1e-3", "did you mean 'tolerance'")):
            done = nscdd("check", self.write("heap.toml", AUTO + line + "\n"))
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertRegex(done.stderr, sentence)


if __name__ == "__main__":
    unittest.main()
