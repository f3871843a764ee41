# SPDX-License-Identifier: Apache-2.0
"""Checkpoints: a killed run goes on as if nothing had been, on any number of ranks; what cannot go on is a sentence."""

import json
import os
import pathlib
import shutil
import unittest

from interrupted import Process, checkpoints, differences
from program import SCENES, TWO_DISKS, ProgramTest, nscdd

BOX = SCENES / "rotating_box_730.toml"
PLUGIN = os.environ.get("FAULTY_PLUGIN", "")


class Continuation(ProgramTest):
    def interrupt(self, scene, *arguments, ranks=0, at=4, out="out"):
        """Kills a run that writes a checkpoint every second step once that after step `at` is there."""
        folder = self.folder / out
        process = Process("run", scene, *arguments, "--quiet", "--out", folder, "--checkpoint-every", 2, ranks=ranks)
        self.assertTrue(process.wait_for(lambda: checkpoints(folder)[-1:] >= [at] if folder.exists() else False))
        process.kill()
        self.assertTrue((folder / "run.json.part").exists(), "the run ended before it was killed")
        return folder

    def go_on(self, folder, *arguments, ranks=0):
        done = nscdd("run", "--resume", folder, "--quiet", *arguments, ranks=ranks)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(sorted(p.name for p in folder.iterdir() if p.name != "communication.csv"),
                         ["final.csv", "results.h5", "results.xdmf", "run.json", "state.h5", "steps.csv"])

    def compare(self, scene, *arguments, pairs=((0, 0),), at=4):
        expected = self.run_scene(scene, *arguments, out="expected")
        for first, second in pairs:
            with self.subTest(scene=pathlib.Path(scene).name, ranks=f"{first} -> {second}"):
                folder = self.interrupt(scene, *arguments, ranks=first, at=at, out=f"out{first}{second}")
                self.go_on(folder, ranks=second)
                self.assertEqual(differences(folder, expected), [])

    def test_on_any_number_of_ranks(self):
        self.compare(BOX, "--solver", "fea", "--subdomains", "2x4", "--steps", 40, "--save-every", 3,
                     pairs=[(0, 3), (1, 1), (1, 2), (2, 2), (2, 3), (3, 0), (3, 2), (3, 3)])

    def test_reference_adapter(self):
        self.compare(BOX, "--adapter", "reference", "--solver", "nscdd", "--subdomains", "4x4", "--steps", 40,
                     "--option", "repartition_every=5", pairs=[(0, 0), (2, 3)])

    def test_one_domain(self):
        for adapter in ("box2d", "reference"):
            with self.subTest(adapter):
                self.compare(BOX, "--adapter", adapter, "--solver", "nscd", "--steps", 60)
                for name in ("expected", "out00"):
                    shutil.rmtree(self.folder / name)

    def test_periodic_flow(self):
        self.compare(SCENES / "sloped_flow_750.toml", "--solver", "nscdd", "--subdomains", "4x1", "--steps", 60,
                     pairs=[(0, 2), (3, 0)], at=20)

    def test_periodic_flow_on_reference(self):
        self.compare(SCENES / "sloped_flow_750.toml", "--adapter", "reference", "--solver", "fea", "--subdomains", "2x2",
                     "--interface", "cg", "--steps", 40, pairs=[(2, 1)], at=10)

    def test_moving_wall(self):
        for adapter in ("box2d", "reference"):
            with self.subTest(adapter):
                self.compare(SCENES / "drum.toml", "--adapter", adapter, "--solver", "nscdd", "--subdomains", "2x2",
                             "--steps", 60, pairs=[(1, 2)], at=10)
                for name in ("expected", "out12"):
                    shutil.rmtree(self.folder / name)

    def test_clusters(self):
        self.compare(SCENES / "clusters.toml", "--steps", 60, at=10)

    def test_incomplete_resolutions(self):
        for solver in ("rea", "iea"):
            with self.subTest(solver):
                self.compare(BOX, "--solver", solver, "--subdomains", "2x2", "--steps", 30, pairs=[(2, 0)])
                for name in ("expected", "out20"):
                    shutil.rmtree(self.folder / name)

    def test_matrix_that_does_not_change(self):
        """Work is counted as in the uninterrupted run: the first factorisation of a step does not come from the step before."""
        scene = self.write("column.toml", TWO_DISKS.replace("steps = 3", "steps = 4000").replace(
            '"nscd"', '"fea"\nsubdomains = [1, 2]'))
        self.compare(scene, at=20)

    def test_solver_auto(self):
        """It climbs in the first steps: a checkpoint may fall on an exchange of the solver, and the ladder
        goes on from its rung."""
        text = BOX.read_text().replace('"packings/', f'"{SCENES.name}/packings/')
        (self.folder / SCENES.name).symlink_to(SCENES)
        scene = self.write("auto.toml", text[:text.index("[solver]")] + """
[solver]
name = "auto"
subdomains = [2, 2]
accuracy = { interpenetration = 1e-7 }
""")
        expected = self.run_scene(scene, "--steps", 12, out="expected")
        summary = json.loads((expected / "run.json").read_text())["summary"]
        self.assertGreaterEqual(summary["escalations"], 3)
        out, kept = self.folder / "out", self.folder / "kept"
        kept.mkdir()
        process = Process("run", scene, "--steps", 12, "--quiet", "--out", out, "--checkpoint-every", 1, ranks=2)

        def keep_all():
            for file in out.glob("checkpoint_*.ckpt") if out.exists() else []:
                if not (kept / file.name).exists():
                    try:
                        os.link(file, kept / file.name)
                    except FileNotFoundError:
                        pass
            return len(list(kept.iterdir())) > 9

        process.wait_for(keep_all)
        process.kill()
        for newest in checkpoints(out):
            (out / f"checkpoint_{newest:06}.ckpt").unlink()
        for number, checkpoint in enumerate(sorted(kept.iterdir())):
            with self.subTest(checkpoint.name):
                folder = self.folder / f"from{number}"
                shutil.copytree(out, folder)
                shutil.copy(checkpoint, folder)
                self.go_on(folder, ranks=number % 4)
                self.assertEqual(differences(folder, expected), [])
                self.assertEqual(json.loads((folder / "run.json").read_text())["summary"], summary)

    def test_from_the_beginning(self):
        """Checkpoint 0, of a run that was killed before its first step."""
        expected = self.run_scene(BOX, "--steps", 3, out="expected")
        folder = self.folder / "out"
        process = Process("run", BOX, "--steps", 3, "--quiet", "--out", folder, "--checkpoint-every", 2, ranks=1)
        process.wait_for(lambda: folder.exists() and checkpoints(folder) == [0])
        process.kill()
        self.assertEqual(checkpoints(folder), [0])
        self.go_on(folder)
        self.assertEqual(differences(folder, expected), [])

    def test_checkpoints_change_nothing(self):
        expected = self.run_scene(BOX, "--steps", 6, "--save-every", 2, out="expected")
        found = self.run_scene(BOX, "--steps", 6, "--save-every", 2, "--checkpoint-every", 1, out="found")
        self.assertEqual(differences(found, expected), [])
        self.assertEqual(checkpoints(found), [])

    def test_key_of_the_scene(self):
        scene = self.write("test.toml", TWO_DISKS.replace("steps = 3", "steps = 200000") + "[output]\ncheckpoint_every = 2\n")
        folder = self.folder / "out"
        process = Process("run", scene, "--quiet", "--out", folder)
        process.wait_for(lambda: folder.exists() and checkpoints(folder)[-1:] >= [10])
        process.kill()
        self.assertEqual(checkpoints(folder)[-1] % 2, 0)

    def test_the_scene_is_that_of_the_beginning(self):
        """The scene file may be edited, or gone."""
        scene = self.write("test.toml", TWO_DISKS.replace("steps = 3", "steps = 3000"))
        expected = self.run_scene(scene, out="expected")
        folder = self.interrupt(scene)
        scene.write_text("something else")
        self.go_on(folder)
        self.assertEqual(differences(folder, expected), [])

    def test_more_steps(self):
        scene = self.write("test.toml", TWO_DISKS.replace("steps = 3", "steps = 3000"))
        expected = self.run_scene(scene, "--steps", 3500, out="expected")
        folder = self.interrupt(scene)
        refused = nscdd("run", "--resume", folder, "--steps", 2)
        self.assertEqual(refused.returncode, 2)
        self.assertIn("--steps 2", refused.stderr)
        self.go_on(folder, "--steps", 3500)
        self.assertEqual(differences(folder, expected), [])

    def test_damaged_checkpoint(self):
        expected = self.run_scene(BOX, "--steps", 40, out="expected")
        folder = self.interrupt(BOX, "--steps", 40)
        *_, older, newest = checkpoints(folder)  # there may be a third that was to be removed
        with open(folder / f"checkpoint_{newest:06}.ckpt", "r+b") as file:
            file.seek(1000)
            byte = file.read(1)
            file.seek(1000)
            file.write(bytes([byte[0] ^ 4]))
        done = nscdd("run", "--resume", folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"WARNING: checkpoint_{newest:06}.ckpt cannot be used", done.stderr)
        self.assertIn(f"going on after step {older} of 40", done.stdout)
        self.assertEqual(differences(folder, expected), [])


class Refusals(ProgramTest):
    def expect(self, fragments, *arguments, ranks=0):
        done = nscdd(*arguments, ranks=ranks, cwd=self.folder, timeout=60)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        sentences = [line for line in done.stderr.splitlines() if line.startswith("nscdd: ")]
        self.assertEqual(len(sentences), 1, done.stderr)
        for fragment in fragments:
            self.assertIn(fragment, sentences[0])

    def unfinished(self):
        """A folder with an unfinished run."""
        (self.folder / "packing.csv").write_text("x,y,radius\n0,1,1\n0,3,1\n")
        scene = self.write("test.toml", TWO_DISKS.replace("steps = 3", "steps = 200000").replace(
            "[[disks]]\ncentre = [0.0, 1.0]\nradius = 1.0\n[[disks]]\ncentre = [0.0, 3.0]\nradius = 1.0\n",
            '[[disks]]\nfile = "packing.csv"\n'))
        process = Process("run", scene, "--quiet", "--out", self.folder / "out", "--checkpoint-every", 2)
        process.wait_for(lambda: checkpoints(self.folder / "out") if (self.folder / "out").exists() else False)
        process.kill()
        return scene, self.folder / "out"

    def test_nothing_to_resume(self):
        self.expect(["there is no folder none"], "run", "--resume", "none")
        self.expect(["holds no run"], "run", "--resume", self.folder)
        scene = self.write("test.toml", TWO_DISKS)
        self.run_scene(scene, out="finished")
        self.expect(["has finished (3 steps)", "a larger total"], "run", "--resume", "finished")
        (self.folder / "cut").mkdir()
        (self.folder / "cut/run.json.part").write_text("")
        self.expect(["no checkpoint", "begin it anew"], "run", "--resume", "cut", ranks=2)
        self.expect(["give a scene file"], "run")

    def test_conflicting_options(self):
        scene, out = self.unfinished()
        for given in ([scene], ["--solver", "nscd"], ["--tolerance", "1e-6"], ["--adapter", "reference"], ["--save-every", 2],
                      ["--out", "x"], ["--cold"]):
            with self.subTest(given[0]):
                self.expect(["--resume goes on with the run as it was begun", "leave out"], "run", "--resume", out, *given)
        self.assertTrue(checkpoints(out))

    def test_a_new_run_does_not_overwrite_it(self):
        scene, out = self.unfinished()
        before = {p.name: p.read_bytes() for p in out.iterdir()}
        self.expect(["unfinished run", "--resume", "--out"], "run", scene, "--out", out)
        self.assertEqual({p.name: p.read_bytes() for p in out.iterdir()}, before)

    def test_two_at_a_time(self):
        scene, out = self.unfinished()
        process = Process("run", "--resume", out, "--quiet")
        newest = checkpoints(out)[-1]
        process.wait_for(lambda: checkpoints(out)[-1] > newest)
        self.expect(["another run is writing"], "run", "--resume", out)
        process.kill()

    def test_a_changed_packing(self):
        _, out = self.unfinished()
        with open(self.folder / "packing.csv", "a") as file:
            file.write("0,5,1\n")
        self.expect(["packing.csv has changed"], "run", "--resume", out)
        (self.folder / "packing.csv").unlink()
        self.expect(["packing.csv"], "run", "--resume", out)
        self.assertTrue(checkpoints(out))

    def test_no_good_checkpoint(self):
        _, out = self.unfinished()
        (out / "steps.csv.part").write_text("")
        self.expect(["no checkpoint", "can be used", "steps.csv.part"], "run", "--resume", out)

    def test_more_ranks_than_subdomains(self):
        _, out = self.unfinished()
        self.expect(["2 ranks share 1 subdomain"], "run", "--resume", out, ranks=2)
        self.assertTrue(checkpoints(out))

    @unittest.skipUnless(PLUGIN, "FAULTY_PLUGIN names no plugin")
    def test_old_plugin(self):
        scene = self.write("test.toml", TWO_DISKS)
        os.environ["NSCDD_FAULT"] = "old_minor"
        self.addCleanup(os.environ.pop, "NSCDD_FAULT")
        self.run_scene(scene, "--plugin", PLUGIN)  # it serves otherwise
        self.expect(["ABI 1.0", "checkpoints need 1.1", "update"], "run", scene, "--plugin", PLUGIN, "--checkpoint-every", 1,
                    "--out", self.folder / "other")


if __name__ == "__main__":
    unittest.main()
