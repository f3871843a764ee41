# SPDX-License-Identifier: Apache-2.0
"""What the commands print and write when all is well."""

import json
import math
import re
import unittest

from program import SCENES, SOURCE, TWO_DISKS, ProgramTest, nscdd, read_csv

HEADER = ("step,time,contacts,active,iterations,status,nat,nat_max,qm16,interface_jump,mean_interpenetration,"
          "max_interpenetration,kinetic_energy,momentum_x,momentum_y,seconds_detect,seconds_solve,seconds_communicate")


class Run(ProgramTest):
    def test_results(self):
        scene = self.write("test.toml", TWO_DISKS)
        out = self.run_scene(scene)
        self.assertEqual(sorted(p.name for p in out.iterdir()),
                         ["final.csv", "results.h5", "results.xdmf", "run.json", "state.h5", "steps.csv"])
        self.assertTrue((out / "steps.csv").read_text().startswith(HEADER))
        steps = read_csv(out / "steps.csv")
        self.assertEqual([s["step"] for s in steps], ["1", "2", "3"])
        final = read_csv(out / "final.csv")
        self.assertEqual(list(final[0]), ["id", "x", "y", "angle", "vx", "vy", "spin", "radius", "kind"])
        self.assertEqual([int(b["id"]) for b in final], [0, 1, 2])
        self.assertAlmostEqual(float(final[2]["y"]), 3.0, places=6)

    def test_default_folder_and_running_again(self):
        scene = self.write("test.toml", TWO_DISKS)
        for _ in range(2):
            done = nscdd("run", scene, "--quiet", cwd=self.folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(done.stdout, "")
        self.assertTrue((self.folder / "results/test/final.csv").exists())

    def test_summary_without_a_terminal_has_no_control_characters(self):
        done = nscdd("run", self.write("test.toml", TWO_DISKS), cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"steps +3 of 3")
        self.assertNotRegex(done.stdout, r"[\x00-\x09\x0b-\x1f]")

    def test_stop_on_nonconvergence(self):
        text = TWO_DISKS.replace('name = "nscd"', 'name = "nscd"\nmax_iterations = 1\ntolerance = 1e-14\n')
        carry_on = nscdd("run", self.write("a.toml", text), "--out", self.folder / "a")
        self.assertEqual(carry_on.returncode, 0)
        self.assertEqual(len(re.findall("NOT CONVERGED", carry_on.stdout)), 1)
        stop = nscdd("run", self.write("b.toml", text + 'on_nonconvergence = "stop"\n'), "--out", self.folder / "b")
        self.assertEqual(stop.returncode, 3)
        self.assertIn("did not converge", stop.stderr)
        self.assertEqual(len(read_csv(self.folder / "b/steps.csv")), 1)

    def test_adapters_agree(self):
        for scene in ("pyramid", "clusters", "drum"):
            with self.subTest(scene=scene):
                path = SCENES / f"{scene}.toml"
                one = read_csv(self.run_scene(path, "--adapter", "box2d", "--steps", 20, out=scene + "1") / "final.csv")
                two = read_csv(self.run_scene(path, "--adapter", "reference", "--steps", 20, out=scene + "2") / "final.csv")
                self.assertEqual(len(one), len(two))
                for a, b in zip(one, two):
                    for key in ("x", "y", "vx", "vy"):
                        self.assertTrue(math.isclose(float(a[key]), float(b[key]), rel_tol=1e-6, abs_tol=1e-6), (a, b))

    def test_every_solver_runs_the_paper_scene(self):
        scene = SCENES / "rotating_box_730.toml"
        for solver in ("nscd", "nscdd", "fea", "rea", "iea", "newton"):
            with self.subTest(solver=solver):
                steps = read_csv(self.run_scene(scene, "--solver", solver, "--steps", 4, out=solver) / "steps.csv")
                allowed = {"converged", "incomplete"} if solver in ("rea", "iea") else {"converged"}
                self.assertLessEqual({s["status"] for s in steps}, allowed)
                self.assertGreater(int(steps[-1]["active"]), 1000)
                self.assertEqual(int(steps[-1]["factorisations"]) > 0, solver in ("fea", "rea", "iea", "newton"))

    def test_pictures(self):
        out = self.run_scene(SCENES / "pyramid.toml", "--steps", 3, "--save-every", 2)
        for show in ("grains", "forces", "multiplicity", "overlap"):
            picture = self.folder / f"{show}.png"
            done = nscdd("render", out, "--step", 2, "--show", show, "-o", picture)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(picture.read_bytes()[:4], b"\x89PNG")
        done = nscdd("render", out, "--step", 7)
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"step 7.*1, 2")


class Solve(unittest.TestCase):
    def test_golden_problems(self):
        for path in sorted((SOURCE / "tests/data/golden").glob("*.json")):
            with self.subTest(problem=path.name):
                done = nscdd("solve", path, "--tolerance", "1e-14", "--max-iterations", 1000000)
                self.assertEqual(done.returncode, 0, done.stderr)
                found, stored = json.loads(done.stdout), json.loads(path.read_text())
                self.assertEqual(found["status"], "converged")
                self.assertLessEqual(found["nat"], 1e-14)
                self.assertEqual(len(found["r"]), 2 * len(stored["contacts"]))
                self.assertEqual(len(found["V_end"]), len(stored["V_end"]))
                for a, b in zip(found["V_end"], stored["V_end"]):
                    self.assertAlmostEqual(a, b, delta=1e-12)

    def test_decomposition(self):
        path = SOURCE / "tests/data/golden/c8_pyramid6.json"
        done = nscdd("solve", path, "--solver", "nscdd", "--subdomains", "2x1", "--tolerance", "1e-13", "--max-iterations",
                     100000)
        found, stored = json.loads(done.stdout), json.loads(path.read_text())
        self.assertEqual(found["status"], "converged")
        for a, b in zip(found["V_end"], stored["V_end"]):
            self.assertAlmostEqual(a, b, delta=1e-12)
        # Three iterations from rest are the stored trace: the same partition, the same order.
        done = nscdd("solve", path, "--solver", "nscdd", "--subdomains", "2x1", "--tolerance", 0, "--max-iterations", 3,
                     "--acceleration", "none")
        found = json.loads(done.stdout)
        self.assertEqual(found["status"], "fixed")
        for a, b in zip(found["r"], stored["nscdd_r_after_sweep_3"]):
            self.assertAlmostEqual(a, b, delta=1e-14)


class Export(ProgramTest):
    def test_a_step_alone_has_the_same_answer(self):
        """Clusters, with arms, loads and friction: the step within the run and its problem solved from rest."""
        scene, tight = SCENES / "clusters.toml", ("--tolerance", "1e-12", "--max-iterations", 1000000)
        out = self.run_scene(scene, "--steps", 300, *tight)
        done = nscdd("export", scene, "--step", 300, "--json", self.folder / "problem.json", *tight)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stdout, r"step 300 of scene clusters.*converged")
        found = json.loads(nscdd("solve", self.folder / "problem.json", *tight).stdout)
        self.assertEqual(found["status"], "converged")
        self.assertGreater(sum(r > 0 for r in found["r"][::2]), 8)
        velocities = [float(row[k]) for row in read_csv(out / "final.csv") for k in ("vx", "vy", "spin")]
        self.assertEqual(len(found["V_end"]), len(velocities))
        for a, b in zip(found["V_end"], velocities):
            self.assertAlmostEqual(a, b, delta=1e-9)

    def test_sites_place_contacts_in_the_same_subdomains(self):
        scene, few = SCENES / "rotating_box_730.toml", ("--subdomains", "2x4", "--tolerance", 0, "--max-iterations", 30)
        problem = self.folder / "problem.json"
        self.assertEqual(nscdd("export", scene, "--json", problem, *few).returncode, 0)
        found = json.loads(nscdd("solve", problem, "--solver", "nscdd", *few).stdout)
        steps = read_csv(self.run_scene(scene, "--steps", 1, *few) / "steps.csv")
        self.assertAlmostEqual(found["nat"] / float(steps[0]["nat"]), 1.0, delta=0.05)


class Lists(unittest.TestCase):
    def test_solvers(self):
        done = nscdd("solvers")
        self.assertEqual(done.returncode, 0, done.stderr)
        for word in ("nscd:", "nscdd:", "fea:", "rea:", "iea:", "newton:", "acceleration", "tolerance", "subdomains", "lambda",
                     "[m]", "NXxNY"):
            self.assertIn(word, done.stdout)

    def test_check_every_scene(self):
        for scene in sorted(SCENES.glob("*.toml")):
            with self.subTest(scene=scene.name):
                done = nscdd("check", scene)
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertIn("The scene is fine.", done.stdout)

    def test_help(self):
        done = nscdd("--help")
        self.assertEqual(done.returncode, 0)
        for command in ("run", "check", "solvers", "solve", "export", "render", "validate-plugin"):
            self.assertIn(command, done.stdout)


if __name__ == "__main__":
    unittest.main()
