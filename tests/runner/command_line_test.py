# SPDX-License-Identifier: Apache-2.0
"""What is typed is read as it was meant, or refused; what is written replaces its file at once."""

import json
import re
import subprocess
import unittest

from program import MPIEXEC, NSCDD, SCENES, TWO_DISKS, ProgramTest, nscdd, read_csv

PAIR = {"dt": 0.01, "mu": 0.0, "bodies": [[0, 0, 0, 0.1, 0, 0, 1, 1, 1, 0], [2, 0, 0, -0.1, 0, 0, 1, 1, 1, 0]]}


class Numbers(ProgramTest):
    def test_leading_zeros_are_decimal(self):
        scene = self.write("test.toml", TWO_DISKS)
        out = self.run_scene(scene, "--steps", "0100", "--save-every", "010", "--max-iterations", "0100")
        self.assertEqual(len(read_csv(out / "steps.csv")), 100)
        saved = re.findall(r"/steps/0*(\d+)/grains/position", (out / "results.xdmf").read_text())
        self.assertEqual(sorted({int(step) for step in saved}), [0, 1, *range(10, 101, 10)])
        done = nscdd("render", out, "--step", "000050")
        self.assertIn("(step 50,", done.stdout, done.stderr)
        done = nscdd("export", scene, "--step", "010", "--json", self.folder / "p.json")
        self.assertIn("step 10 of", done.stdout, done.stderr)
        out = self.run_scene(scene, "--steps", "020", "--checkpoint-every", "010")
        settings = json.loads((out / "run.json").read_text())["settings"]
        self.assertEqual((settings["steps"], settings["checkpoint_every"]), ("20", "10"))

    def test_no_numbers(self):
        scene = self.write("test.toml", TWO_DISKS)
        for text in ("0x10", "1e1", "10.0", "ten", "", " 10", "-1", "0", "99999999999999999999"):
            with self.subTest(text):
                done = nscdd("run", scene, f"--steps={text}", "--out", self.folder / "out")
                self.assertEqual(done.returncode, 2, done.stdout)
                self.assertIn("nscdd: --steps:", done.stderr)
                self.assertNotIn("\n", done.stderr.strip())

    def test_negative_numbers_are_values(self):
        done = nscdd("run", SCENES / "pyramid.toml", "--tolerance", "-1", "--out", self.folder / "out")
        self.assertIn("'-1'", done.stderr)


class Words(ProgramTest):
    def expect(self, sentence, *arguments):
        done = nscdd(*arguments, cwd=self.folder)
        self.assertEqual(done.returncode, 2, done.stdout)
        self.assertIn(sentence, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)

    def test_missing_values(self):
        scene = self.write("test.toml", TWO_DISKS)
        self.expect("run: --out lacks its value (--quiet follows)", "run", scene, "--out", "--quiet")
        self.expect("run: --out lacks its value", "run", scene, "--out")
        self.expect("render: -o lacks its value (--step follows)", "render", "out", "-o", "--step", "3")
        options = re.findall(r"^  (?:-o,)?(--[a-z-]+) (?:TEXT|INT|FLOAT)", nscdd("run", "--help").stdout, re.M)
        self.assertGreater(len(options), 15)
        for option in options:
            self.expect(f"run: {option} lacks its value", "run", option, "--quiet")
        self.assertEqual([p.name for p in self.folder.iterdir()], ["test.toml"])

    def test_a_value_that_begins_with_dashes(self):
        done = nscdd("run", self.write("test.toml", TWO_DISKS), "--out=--quiet", "--quiet", cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertTrue((self.folder / "--quiet/final.csv").exists())

    def test_nearest_names(self):
        scene = self.write("test.toml", TWO_DISKS)
        self.expect("no command 'runn'; did you mean 'run'?", "runn", scene)
        self.expect("no command 'frobnicate'; commands are run, check", "frobnicate")
        self.expect("run: there is no option '--stepz'; did you mean '--steps'?", "run", scene, "--stepz", "3")
        self.expect("run: there is no option '--toleranc'; did you mean '--tolerance'?", "run", scene, "--toleranc=3")
        self.expect("no solver 'ncsd'; did you mean 'nscd'?", "run", scene, "--solver", "ncsd")
        self.expect("no solver 'newtn'; did you mean 'newton'?", "tradeoff", scene, "--solvers", "newtn")
        self.expect("no 'newtn'; did you mean 'newton'?", "extremes", "--solvers", "newtn")
        self.expect("give a command: run, check")


class Files(ProgramTest):
    def test_a_reader_keeps_what_it_opened(self):
        scene = self.write("test.toml", TWO_DISKS)
        out = self.run_scene(scene)
        for name, arguments in (("p.h5", ["export", scene, "--fclib", "p.h5"]),
                                ("p.json", ["export", scene, "--json", "p.json"]),
                                ("p.png", ["render", out, "-o", "p.png"]), ("p.svg", ["render", out, "-o", "p.svg"])):
            with self.subTest(name):
                file = self.folder / name
                file.write_text("what was there")
                with open(file) as reader:
                    done = nscdd(*arguments, cwd=self.folder)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertEqual(reader.read(), "what was there")
                self.assertNotEqual(file.read_bytes(), b"what was there")
        self.assertEqual([p.name for p in self.folder.iterdir() if p.name.endswith(".part")], [])

    def test_a_failure_leaves_the_file(self):
        lowered = TWO_DISKS.replace("point = [0.0, 0.0]", "point = [0.0, -9.0]")
        flying = self.write("flying.toml", lowered.replace("3.0]", "9.0]"))
        kept = self.write("p.h5", "what was there")
        self.assertEqual(nscdd("export", flying, "--fclib", kept).returncode, 2)
        self.assertEqual(kept.read_text(), "what was there")

    def test_no_escape_codes_in_files(self):
        scene = self.write("test.toml", TWO_DISKS.replace("steps = 3", "steps = 30"))
        for ranks in (0, 1):  # mpirun gives its ranks a terminal even if its own output is a file
            with open(self.folder / "log", "w") as log:
                command = [MPIEXEC, "-n", "1"] if ranks else []
                command += [NSCDD, "run", str(scene), "--out", str(self.folder / "out")]
                subprocess.run(command, stdout=log, stderr=log, check=True, timeout=60)
            text = (self.folder / "log").read_text()
            self.assertIn("step 30/30", text)
            self.assertEqual([c for c in text if ord(c) < 32 and c != "\n"], [], text)


class Problems(ProgramTest):
    def solve(self, normal):
        problem = self.write("pair.json", json.dumps({**PAIR, "contacts": [[1, 0, *normal, 0.0, 1.0, 1.0, 0.0]]}))
        return nscdd("solve", problem, "--tolerance", "1e-12")

    def test_normals_of_few_digits_are_normalised_with_a_note(self):
        exact = self.solve([0.6, 0.8])
        self.assertEqual(exact.stderr, "")
        self.assertNotIn("notes", json.loads(exact.stdout))
        rounded = self.solve([0.600001, 0.800001])
        self.assertEqual(rounded.returncode, 0, rounded.stderr)
        self.assertRegex(rounded.stderr, r"^nscdd: note: .*pair.json: 1 of 1 normals .* were normalised")
        answer = json.loads(rounded.stdout)
        self.assertEqual(len(answer["notes"]), 1)
        length = (0.600001**2 + 0.800001**2) ** 0.5  # a head-on impact along the normal of unit length
        n = (0.600001 / length, 0.800001 / length)
        closing = 0.2 * n[0]
        self.assertAlmostEqual(answer["V_end"][0], 0.1 - 0.5 * closing * n[0], places=12)
        self.assertAlmostEqual(answer["V_end"][1], -0.5 * closing * n[1], places=12)

    def test_no_unit_vector_at_all_is_refused(self):
        done = self.solve([1.0, 1.0])
        self.assertEqual(done.returncode, 2)
        self.assertIn("normal", done.stderr)


class Check(ProgramTest):
    def test_alert_distance_of_the_scene(self):
        apart = TWO_DISKS.replace("centre = [0.0, 3.0]", "centre = [0.0, 3.3]")
        done = nscdd("check", self.write("test.toml", apart))
        self.assertIn("1 candidates within 0.1 m", done.stdout)
        done = nscdd("check", self.write("test.toml", apart + "alert_distance = 0.5\n"))
        self.assertIn("2 candidates within 0.5 m", done.stdout)
        done = nscdd("check", self.write("test.toml", apart), "--option", "alert_distance=0.4")
        self.assertIn("2 candidates within 0.4 m", done.stdout)


FLOOR = 'type = "half_plane"\npoint = [0.0, 0.0]'
ODD = {  # what is odd: (text of the scene, its replacement, what the note must say)
    "degrees": ('[scene]', '[gravity]\nangle = 30.0\n[scene]', "'gravity.angle' is 30, more than a whole turn"),
    "rotating by degrees": ('[scene]', '[gravity]\nkind = "rotating"\nfrom_angle = 0.0\nto_angle = 22.5\nin_steps = 3\n[scene]',
                            "'gravity.to_angle' is 22.5"),
    "upwards": ('[scene]', '[gravity]\nvector = [0.0, 9.81]\n[scene]', "upwards"),
    "below": (FLOOR, 'type = "segments"\npoints = [[-5.0, 9.0], [5.0, 9.0]]', "beyond all walls"),
    "beside": (FLOOR, 'type = "segments"\npoints = [[2.0, 0.0], [5.0, 0.0]]', "beside all walls"),
    "no wall": (f"[[walls]]\n{FLOOR}\n", "", "fall for ever"),
    "radii in mm": ('centre = [0.0, 3.0]', 'centre = [0.0, 1.002]', "both in metres"),
    "positions in mm": ('centre = [0.0, 3.0]', 'centre = [3000.0, 3000.0]', "both in metres"),
    "one radius in mm": ('centre = [0.0, 3.0]\nradius = 1.0', 'centre = [0.0, 2002.0]\nradius = 1000.0', "radii go from"),
}


class Oddities(ProgramTest):
    def test_each_is_noted(self):
        for name, (old, new, sentence) in ODD.items():
            with self.subTest(name):
                self.assertIn(old, TWO_DISKS)
                scene = self.write("odd.toml", TWO_DISKS.replace(old, new))
                done = nscdd("check", scene)
                self.assertEqual(done.returncode, 0, done.stderr)
                notes = [line for line in done.stderr.splitlines() if line.startswith("nscdd: note: ")]
                self.assertEqual(len([n for n in notes if sentence in n]), 1, done.stderr)
                out = self.run_scene(scene, "--steps", "1", out="out_" + name.replace(" ", "_"))
                self.assertIn(sentence, " ".join(json.loads((out / "run.json").read_text())["notes"]))

    def test_sound_scenes_are_not(self):
        scenes = [*SCENES.glob("*.toml"), *SCENES.glob("settle/*.toml"), self.write("test.toml", TWO_DISKS)]
        self.assertGreater(len(scenes), 10)
        for scene in scenes:
            done = nscdd("check", scene)
            self.assertEqual((done.returncode, done.stderr), (0, ""), scene)


if __name__ == "__main__":
    unittest.main()
