# SPDX-License-Identifier: Apache-2.0
"""State files: a scene goes on from where another run ended, a finished run goes further; what cannot is a sentence."""

import csv
import json
import os
import re
import shutil
import struct
import unittest

from interrupted import differences
from program import SCENES, ProgramTest, nscdd, read_csv

BOX = SCENES / "rotating_box_730.toml"
PLUGIN = os.environ.get("FAULTY_PLUGIN", "")

SETTINGS = """
[scene]
name = "NAME"
[time]
dt = 0.01
steps = STEPS
[solver]
name = "nscdd"
subdomains = [1, 2]
tolerance = 1e-8
max_iterations = 20000
"""
TURNING = """
[gravity]
kind = "rotating"
from_angle = 0.3
to_angle = -0.4
in_steps = 70
"""
MIXTURE = """
[[materials]]
name = "light"
friction = 0.3
[[materials]]
name = "heavy"
density = 7.0
friction = 0.6
restitution = 0.2
[[walls]]
type = "half_plane"
point = [0, 0]
[[walls]]
type = "half_plane"
point = [0, 0]
normal = [1, 0]
[[walls]]
type = "segments"
points = [[10, 0], [10, 20]]
velocity = [-0.2, 0]
[[lattices]]
count = 12
x = [0, 10]
bottom = 0.02
radius = [0.5, 0.9]
jitter = 0.1
seed = 3
material = "heavy"
[[disks]]
centre = [5, 9]
radius = 0.6
spin = 3
velocity = [1, -2]
[[disks]]
centre = [2, 11]
radius = 0.6
kind = "prescribed"
velocity = [0.3, -1]
spin = 0.5
[[clusters]]
disks = [[-0.6, 0, 0.5], [0.6, 0, 0.5]]
at = [[5, 11, 0.7], [7, 12, 0.1]]
mass = 3
"""


class StateTest(ProgramTest):
    def scene(self, name, steps, *parts):
        return self.write(name + ".toml", SETTINGS.replace("NAME", name).replace("STEPS", str(steps)) + "".join(parts))

    def started(self, name, steps, state, *parts):
        return self.scene(name, steps, f'[start]\nstate = "{state}"\n', *parts)

    def rows(self, folder, first=1):
        rows = [row for row in read_csv(folder / "steps.csv") if int(row["step"]) >= first]
        return [{k: v for k, v in row.items() if not k.startswith("seconds_")} for row in rows]

    def bodies(self, folder):
        return {int(row["id"]): row for row in read_csv(folder / "final.csv")}

    def notes(self, folder):
        return json.loads((folder / "run.json").read_text()).get("notes", [])

    def expect(self, fragments, *arguments, ranks=0):
        done = nscdd(*arguments, ranks=ranks, cwd=self.folder, timeout=60)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        sentences = [line for line in done.stderr.splitlines() if line.startswith("nscdd: ")]
        self.assertEqual(len(sentences), 1, done.stderr)
        for fragment in fragments:
            self.assertIn(fragment, sentences[0])


class Stages(StateTest):
    def test_two_stages_are_one_run(self):
        """Walls in motion, clusters, prescribed disks, materials, gravity that turns: on any number of ranks and platforms."""
        whole = self.run_scene(self.scene("whole", 100, TURNING, MIXTURE), out="whole")
        first_scene = self.scene("first", 40, TURNING, MIXTURE)
        second_scene = self.started("second", 60, "first/state.h5", TURNING)
        for first, second, adapter in ((0, 0, "box2d"), (1, 2, "box2d"), (2, 0, "box2d"), (2, 2, "reference")):
            with self.subTest(ranks=f"{first} -> {second}", adapter=adapter):
                for name in ("first", "second"):
                    shutil.rmtree(self.folder / name, ignore_errors=True)
                begun = self.run_scene(first_scene, out="first", ranks=first)
                self.assertGreater(int(self.rows(begun)[-1]["active"]), 5, "impulses to go on from")
                done = self.run_scene(second_scene, "--adapter", adapter, out="second", ranks=second)
                self.assertEqual((done / "final.csv").read_bytes(), (whole / "final.csv").read_bytes())
                self.assertEqual(self.rows(done), self.rows(whole, first=41))
                self.assertEqual(self.notes(done), [])

    def test_three_stages(self):
        whole = self.run_scene(self.scene("whole", 60, MIXTURE), out="whole")
        self.run_scene(self.scene("a", 20, MIXTURE), out="a")
        self.run_scene(self.started("b", 20, "a/state.h5"), out="b", ranks=2)
        c = self.run_scene(self.started("c", 20, "b/state.h5"), out="c")
        self.assertEqual((c / "final.csv").read_bytes(), (whole / "final.csv").read_bytes())

    def test_periodic(self):
        flow = SCENES / "sloped_flow_750.toml"
        options = ("--solver", "nscdd", "--subdomains", "4x1")
        whole = self.run_scene(flow, *options, "--steps", 12, out="whole")
        self.run_scene(flow, *options, "--steps", 5, out="first")
        gravity = re.search(r"\[gravity\]\n[^\[]*", flow.read_text())[0]
        scene = self.write("second.toml", '[time]\ndt = 0.01\nsteps = 7\n[start]\nstate = "first/state.h5"\n' + gravity + "\n")
        second = self.run_scene(scene, *options, out="second", ranks=2)
        self.assertEqual((second / "final.csv").read_bytes(), (whole / "final.csv").read_bytes())
        other = self.write("other.toml", scene.read_text() + "[periodic]\nx = [0, 50]\n")
        self.expect(["other.toml", "periodic.x", "[0, 50]", "leave it out"], "run", other)

    def test_checkpoints_in_a_later_stage(self):
        """A stage that is told to end goes on too."""
        whole = self.run_scene(self.scene("whole", 60, MIXTURE), out="whole")
        self.run_scene(self.scene("first", 20, MIXTURE), out="first")
        scene = self.started("second", 20, "first/state.h5")
        self.run_scene(scene, "--checkpoint-every", 5, out="second")
        done = nscdd("run", "--resume", self.folder / "second", "--steps", 60, "--quiet")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((self.folder / "second/final.csv").read_bytes(), (whole / "final.csv").read_bytes())
        self.assertEqual(self.rows(self.folder / "second"), self.rows(whole, first=21))

    def test_more_walls_and_bodies(self):
        first = self.run_scene(self.scene("first", 30, MIXTURE), out="first")
        ids = set(self.bodies(first))
        lid = '[[walls]]\ntype = "half_plane"\npoint = [0, 30]\nnormal = [0, -1]\n[[disks]]\ncentre = [5, 20]\nradius = 0.5\n'
        for ranks in (0, 2):
            second = self.run_scene(self.started("second", 1, "first/state.h5", lid), out=f"second{ranks}", ranks=ranks)
            self.assertEqual(set(self.bodies(second)) - ids, {max(ids) + 1, max(ids) + 2})
            self.assertEqual(self.notes(second), [])
        # What is far from the newcomers moves as it would without them.
        alone = self.run_scene(self.started("alone", 1, "first/state.h5"), out="alone")
        moved = self.bodies(second)
        for body, row in self.bodies(alone).items():
            self.assertAlmostEqual(float(row["y"]), float(moved[body]["y"]), places=9)

    def test_changed_settings(self):
        self.run_scene(self.scene("first", 30, MIXTURE), out="first")
        smooth = '[[materials]]\nname = "heavy"\nfriction = 0\n[[materials]]\nname = "light"\nfriction = 0\n'
        slid = self.run_scene(self.started("smooth", 5, "first/state.h5", smooth), out="smooth")
        same = self.run_scene(self.started("same", 5, "first/state.h5"), out="same")
        self.assertNotEqual(self.bodies(slid), self.bodies(same))
        self.assertTrue(all(int(row["sticking"]) == 0 or int(row["active"]) > 0 for row in self.rows(slid)))

    def test_other_subdomains(self):
        """The impulses of contacts serve there too."""
        self.run_scene(BOX, "--solver", "nscdd", "--subdomains", "1x2", "--steps", 10, out="first")
        scene = self.started("other", 1, "first/state.h5", "[gravity]\nangle = 0.37\n")
        for grid, ranks in (("2x2", 0), ("2x2", 2), ("1x1", 0), ("3x1", 3)):
            with self.subTest(grid=grid, ranks=ranks):
                options = ("--subdomains", grid, "--tolerance", "1e-4", "--option", "test_every=1")
                warm = self.run_scene(scene, *options, out="warm", ranks=ranks)
                cold = self.run_scene(scene, *options, "--cold", out="cold")
                self.assertEqual(self.notes(warm), [])
                self.assertEqual([row["step"] for row in self.rows(warm)], ["11"])
                self.assertLess(1.5 * int(self.rows(warm)[0]["iterations"]), int(self.rows(cold)[0]["iterations"]))

    @unittest.skipUnless(PLUGIN, "FAULTY_PLUGIN names no plugin")
    def test_another_plugin(self):
        """What it cannot load is said, and done without."""
        self.run_scene(self.scene("first", 30, MIXTURE), out="first")
        os.environ["NSCDD_FAULT"] = "old_minor"
        self.addCleanup(os.environ.pop, "NSCDD_FAULT")
        other = self.run_scene(self.started("other", 5, "first/state.h5"), "--plugin", PLUGIN, out="other")
        self.assertEqual(len(self.notes(other)), 1)
        self.assertIn("zero impulses", self.notes(other)[0])
        self.assertEqual([row["step"] for row in self.rows(other)], ["31", "32", "33", "34", "35"])
        self.assertEqual(self.rows(other)[0]["time"], "0.3100000000000001")

    def test_the_clock_may_begin_anew(self):
        self.run_scene(self.scene("first", 30, TURNING, MIXTURE), out="first")
        zero = self.run_scene(self.scene("zero", 3, '[start]\nstate = "first/state.h5"\nclock = "zero"\n', TURNING), out="zero")
        steep = self.run_scene(self.started("steep", 3, "first/state.h5",
                                            "[gravity]\nkind = 'table'\ntable = [[0, 0, -9.81]]\n"), out="steep")
        self.assertEqual([row["step"] for row in self.rows(zero)], ["1", "2", "3"])
        self.assertEqual(self.rows(zero)[0]["time"], "0.01")
        self.assertNotEqual(self.bodies(zero), self.bodies(steep))

    def test_with_another_time_step(self):
        self.run_scene(self.scene("first", 30, MIXTURE), out="first")
        scene = self.started("second", 2, "first/state.h5")
        scene.write_text(scene.read_text().replace("dt = 0.01", "dt = 0.005"))
        second = self.run_scene(scene, out="second")
        times = [float(row["time"]) for row in self.rows(second)]
        self.assertAlmostEqual(times[0], 0.305, places=12)
        self.assertAlmostEqual(times[1], 0.31, places=12)

    def test_other_commands(self):
        self.run_scene(self.scene("first", 30, MIXTURE), out="first")
        scene = self.started("second", 2, "first/state.h5")
        done = nscdd("check", scene)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("15 free, 4 prescribed", done.stdout)


class Longer(StateTest):
    def compare(self, scene, *options, first=0, second=0, steps=(4, 11), more=()):
        expected = self.run_scene(scene, *options, "--steps", steps[1], *more, out="expected")
        folder = self.run_scene(scene, *options, "--steps", steps[0], *more, out="out", ranks=first)
        done = nscdd("run", "--resume", folder, "--steps", steps[1], ranks=second)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"going on after step {steps[0]} of {steps[1]}", done.stdout)
        self.assertEqual(differences(folder, expected), [])
        run, whole = (json.loads((f / "run.json").read_text()) for f in (folder, expected))
        run["settings"]["ranks"] = whole["settings"]["ranks"]
        self.assertEqual({**run, "files": sorted(set(run["files"]) - {"communication.csv"})},
                         {**whole, "files": sorted(whole["files"])})
        self.assertEqual([p.name for p in folder.iterdir() if p.suffix in (".part", ".ckpt")], [])
        for name in ("expected", "out"):
            shutil.rmtree(self.folder / name)

    def test_a_finished_run_goes_on(self):
        box = ("--solver", "nscdd", "--subdomains", "2x2")
        self.compare(BOX, *box)
        self.compare(BOX, *box, first=2, second=3)
        self.compare(BOX, *box, more=("--save-every", 3), second=2)
        self.compare(BOX, *box, more=("--save-every", 4))

    def test_from_one_step(self):
        self.compare(self.scene("mixture", 1, MIXTURE), steps=(1, 4))

    def test_twice_and_with_checkpoints(self):
        scene = self.scene("mixture", 10, MIXTURE)
        expected = self.run_scene(scene, "--steps", 30, out="expected")
        folder = self.run_scene(scene, out="out")
        for steps, more in ((20, ()), (30, ("--checkpoint-every", 3))):
            done = nscdd("run", "--resume", folder, "--steps", steps, "--quiet", *more)
            self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(differences(folder, expected), [])

    def test_what_cannot_go_on(self):
        scene = self.scene("mixture", 3, MIXTURE)
        folder = self.run_scene(scene, out="out")
        before = {p.name: p.read_bytes() for p in folder.iterdir()}
        self.expect(["has finished (3 steps)", "--steps 6"], "run", "--resume", folder)
        self.expect(["has finished (3 steps)"], "run", "--resume", folder, "--steps", 3, ranks=2)
        with open(folder / "steps.csv", "a") as file:
            file.write("\n")
        (folder / "steps.csv").write_bytes(before["steps.csv"][:-9])
        self.expect(["steps.csv", "bytes"], "run", "--resume", folder, "--steps", 6)
        (folder / "steps.csv").write_bytes(before["steps.csv"])
        (folder / "state.h5").write_bytes(before["state.h5"][:-1])
        self.expect(["state.h5", "cannot be used"], "run", "--resume", folder, "--steps", 6, ranks=2)
        (folder / "state.h5").unlink()
        self.expect(["no state.h5 to go on from"], "run", "--resume", folder, "--steps", 6)
        self.assertEqual({p.name: p.read_bytes() for p in folder.iterdir()},
                         {k: v for k, v in before.items() if k != "state.h5"})


class Refusals(StateTest):
    def test_files_that_are_no_state(self):
        folder = self.run_scene(self.scene("first", 2, MIXTURE), out="first")
        good = (folder / "state.h5").read_bytes()
        newer = bytearray(good)
        struct.pack_into("<I", newer, 8, 2)
        flipped = bytearray(good)
        flipped[len(good) // 2] ^= 1
        for name, data, sentence in (("none", None, "is not there"),
                                     ("empty", b"", "no state file"),
                                     ("text", b"id,x,y\n" * 100, "no state file"),
                                     ("half", good[:len(good) // 2], "were written"),
                                     ("seal", good[:40], "were written"), ("newer", bytes(newer), "format version 2"),
                                     ("flipped", bytes(flipped), "checksum"),
                                     ("results", (folder / "results.h5").read_bytes(), "no state file")):
            with self.subTest(name):
                if data is not None:
                    (self.folder / "bad.h5").write_bytes(data)
                self.expect(["bad.h5", sentence], "run", self.started("second", 1, "bad.h5"))

    def test_scenes(self):
        self.run_scene(self.scene("first", 2, MIXTURE), out="first")
        state = "first/state.h5"
        for part, fragments in (
                ('[[disks]]\ncentre = [5, 30]\nradius = 1\nmaterial = "hevy"\n', ["hevy", "heavy"]),
                ('[[materials]]\nname = "heavy"\ndensity = 8\n', ["density", "8", "7", "another name"]),
                ("[periodic]\nx = [0, 10]\n", ["periodic.x", "not periodic"]),
                ("[[disks]]\ncentre = [5, 30]\nradius = 1\nid = 3\n", ["id", "3", "duplicate"])):
            with self.subTest(part):
                self.expect(["second.toml", *fragments] if "id" not in fragments else fragments, "run",
                            self.started("second", 1, state, part))
        self.expect(["take the place of the state", "--out"], "run", self.started("first", 1, state), "--out", "first")
        self.assertTrue((self.folder / state).exists())


class Packings(StateTest):
    def test_velocities_and_materials(self):
        scene = self.scene("first", 5, MIXTURE, '[output]\npacking = "pack.csv"\n')
        done = nscdd("run", scene, "--out", self.folder / "first")
        self.assertIn("nscdd: note: pack.csv holds the free disks; not in it: 3 walls, 1 prescribed body, 2 clusters, the "
                      "impulses.", done.stderr)
        self.assertEqual(len(self.notes(self.folder / "first")), 1)
        final = self.bodies(self.folder / "first")
        rows = read_csv(self.folder / "first/pack.csv")
        self.assertEqual(len(rows), 13)
        for row in rows:
            for key in ("x", "y", "angle", "vx", "vy", "spin"):
                self.assertEqual(row[key], final[int(row["id"])][key])
        self.assertEqual({row["material"] for row in rows}, {"heavy", "light"})
        shutil.copy(self.folder / "first/pack.csv", self.folder)
        again = self.scene("again", 1, MIXTURE[:MIXTURE.index("[[lattices]]")],
                           '[[disks]]\nfile = "pack.csv"\n[gravity]\ng = 0\n')
        moved = self.bodies(self.run_scene(again, "--option", "criterion=nat_max", out="again"))
        fast = max(rows, key=lambda row: float(row["spin"]))
        self.assertEqual(moved[int(fast["id"])]["spin"], fast["spin"])

    def test_a_scene_without_materials(self):
        scene = self.scene("first", 2, "[[disks]]\ncentre = [0, 0]\nradius = 1\n[output]\npacking = 'pack.csv'\n")
        folder = self.run_scene(scene, out="first")
        with open(folder / "pack.csv", newline="") as file:
            self.assertEqual(next(csv.reader(file)), ["id", "x", "y", "angle", "radius", "vx", "vy", "spin"])


if __name__ == "__main__":
    unittest.main()
