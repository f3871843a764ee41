# SPDX-License-Identifier: Apache-2.0
"""Bad input: one sentence on stderr with the place and the mend, exit code 2, nothing written."""

import unittest

from program import SCENES, TWO_DISKS, ProgramTest, nscdd

SPOILT = {  # what is written wrong: (text, its replacement, what the sentence must say)
    "misspelt key": ('radius = 1.0', 'radiux = 1.0', ["bad.toml:", "radiux", "radius"]),
    "wrong type": ('steps = 3', 'steps = "three"', ["bad.toml:6", "steps"]),
    "negative radius": ('radius = 1.0', 'radius = -1.0', ["bad.toml:", "radius"]),
    "not a number": ('dt = 0.01', 'dt = nan', ["bad.toml:5", "dt"]),
    "infinite": ('centre = [0.0, 3.0]', 'centre = [0.0, inf]', ["bad.toml:", "centre"]),
    "negative density": ('[[walls]]', '[[materials]]\nname = "m"\ndensity = -1\n[[walls]]', ["bad.toml:", "density"]),
    "no such solver": ('name = "nscd"', 'name = "nscx"', ["bad.toml:", "nscx", "nscd"]),
    "no such option": ('name = "nscd"', 'name = "nscd"\ntolerence = 1e-3', ["bad.toml:", "tolerence", "tolerance"]),
    "bad option value": ('name = "nscd"', 'name = "nscd"\ntolerance = -1.0', ["bad.toml:", "tolerance"]),
    "theta outside its limits": ('dt = 0.01', 'dt = 0.01\ntheta = 0.4', ["bad.toml:6: key 'time.theta'", "0.4", ">= 0.5"]),
    "criterion of other solvers": ('name = "nscd"', 'name = "newton"\ncriterion = "quad"', ["bad.toml:", "criterion"]),
    "too many subdomains": ('name = "nscd"', 'name = "nscdd"\nsubdomains = "5000x5000"', ["bad.toml:", "at most 1000000"]),
    "option of another solver": ('name = "nscd"', 'name = "nscd"\nlambda = 1.0', ["bad.toml:", "lambda", "fea"]),
    "duplicate ids": ('radius = 1.0', 'radius = 1.0\nid = 5', ["bad.toml", "5"]),
    "no TOML": ('[time]', '[time', ["bad.toml:"]),
    "missing file": ('centre = [0.0, 1.0]\nradius = 1.0', 'file = "none.csv"', ["bad.toml:", "none.csv"]),
}


class Refusals(ProgramTest):
    def expect(self, fragments, *arguments, ranks=0):
        before = sorted(p.name for p in self.folder.iterdir())
        done = nscdd(*arguments, ranks=ranks, cwd=self.folder, timeout=60)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        sentences = [line for line in done.stderr.splitlines() if line.startswith("nscdd: ")]
        self.assertEqual(len(sentences), 1, done.stderr)
        self.assertLess(len(sentences[0]), 1500)
        self.assertFalse(any(ord(c) < 32 for c in sentences[0]), sentences[0])
        for fragment in fragments:
            self.assertIn(fragment, sentences[0])
        self.assertEqual(sorted(p.name for p in self.folder.iterdir()), before)

    def test_spoilt_scenes(self):
        for name, (old, new, fragments) in SPOILT.items():
            with self.subTest(name):
                self.assertIn(old, TWO_DISKS)
                scene = self.write("bad.toml", TWO_DISKS.replace(old, new))
                self.expect(fragments, "run", scene)

    def test_on_two_ranks(self):
        scene = self.write("bad.toml", TWO_DISKS.replace("radius = 1.0", "radius = -1.0")
                           .replace('"nscd"', '"nscdd"\nsubdomains=[2,1]'))
        self.expect(["radius"], "run", scene, ranks=2)

    def test_settings_of_a_tradeoff(self):
        settings = self.write("bad.toml", '[[settings]]\nname = "a"\nsolver = "nscd"\ntolerance = -1.0\n')
        self.expect(["bad.toml:4", "tolerance", ">= 0"], "tradeoff", self.write("test.toml", TWO_DISKS), "--settings", settings)

    def test_no_bodies(self):
        scene = self.write("bad.toml", '[scene]\nname = "x"\n[time]\ndt = 0.1\nsteps = 1\n')
        self.expect(["bod"], "run", scene)

    def test_more_ranks_than_subdomains(self):
        scene = self.write("test.toml", TWO_DISKS)
        self.expect(["2 ranks", "1 subdomain"], "run", scene, ranks=2)

    def test_missing_scene(self):
        self.expect(["nowhere.toml"], "run", self.folder / "nowhere.toml")

    def test_unwritable_output(self):
        scene = self.write("test.toml", TWO_DISKS)
        self.expect(["test.toml"], "run", scene, "--out", scene)  # a file is in the way

    def test_folder_of_another_scene(self):
        self.run_scene(self.write("test.toml", TWO_DISKS))
        other = self.write("other.toml", TWO_DISKS.replace('name = "test"', 'name = "other"'))
        kept = (self.folder / "out/final.csv").read_bytes()
        self.expect(["test", "other", "--out"], "run", other, "--out", self.folder / "out")
        self.assertEqual((self.folder / "out/final.csv").read_bytes(), kept)

    def test_command_line(self):
        scene = SCENES / "pyramid.toml"
        self.expect(["--solver", "nscd"], "run", scene, "--solver", "ncsd")
        self.expect(["subdomains", "nscdd"], "run", scene, "--solver", "nscd", "--subdomains", "2x2")
        self.expect(["subdomains"], "run", scene, "--subdomains", "2by2")
        self.expect(["criterion", "qm16"], "run", scene, "--criterion", "qm")
        self.expect(["lambda", "1e"], "run", scene, "--solver", "fea", "--lambda", "1e12")
        self.expect(["adapter", "box2d"], "run", scene, "--adapter", "bullet")
        self.expect(["none.so"], "run", scene, "--plugin", "none.so")
        self.expect(["mpirun"], "run", scene, "--solver", "fea", "--option", "linear_solver=mumps")
        for arguments in (["walk"], ["run"], ["run", scene, "--steps", "0"], ["run", scene, "--option", "x"]):
            self.assertEqual(nscdd(*arguments).returncode, 2, arguments)

    def test_export(self):
        scene = self.write("test.toml", TWO_DISKS)
        flying = self.write("flying.toml", TWO_DISKS.replace("point = [0.0, 0.0]", "point = [0.0, -9.0]")
                            .replace("3.0]", "9.0]"))
        self.expect(["--fclib", "--json"], "export", scene)
        self.expect(["no contact", "step"], "export", flying, "--fclib", "p.h5")
        self.expect(["p.h5"], "export", scene, "--fclib", "nowhere/p.h5")
        self.expect(["p.json"], "export", scene, "--json", "nowhere/p.json")
        self.assertEqual(nscdd("export", scene, "--step", 0, "--json", "p.json", cwd=self.folder).returncode, 2)

    def test_problem_files(self):
        bad = self.write("bad.json", '{"dt": 0.01, "bodies": [[0, 1]], "contacts": []}')
        self.expect(["bad.json", "bodies", "10"], "solve", bad)
        for key, rows in (("arms", "[[0, 0, 0, 0]]"), ("forces", "[[0, 0, 0], [0, 0, 0]]"), ("mu", "[0.3]"),
                          ("sites", "[[0]]")):
            bodies = '"bodies": [[0, 1, 0, 0, 0, 0, 1, 1, 1, 0]]'
            bad = self.write("bad.json", '{"dt": 0.01, %s, "contacts": [], "%s": %s}' % (bodies, key, rows))
            self.expect(["bad.json", key], "solve", bad)
        deep = self.write("deep.json", '{"dt": ' + '{"a": ' * 1000000 + "1" + "}" * 1000000 + "}")
        self.expect(["deep.json", "dt", "object"], "solve", deep)
        deep = self.write("deep.json", '{"dt": 0.1, "bodies": ' + "[" * 1000000 + "]" * 1000000 + "}")
        self.expect(["deep.json", "bodies"], "solve", deep)
        for text, word in (('{"dt": NaN}', "JSON"), ('{"dt": 1e999}', "JSON"), ('{"dt": "\\u001b[2J"}', "string"),
                           ('{"' + "x" * 9999, "JSON")):
            self.expect(["bad.json", word], "solve", self.write("bad.json", text))
        worse = self.write("bad.json", "{")
        self.expect(["bad.json", "JSON"], "solve", worse)


if __name__ == "__main__":
    unittest.main()
