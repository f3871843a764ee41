# SPDX-License-Identifier: Apache-2.0
"""Tables of disks: notes on them, ids beside walls on several ranks, and final.csv and packings read back."""

import json
import unittest

from program import ProgramTest, nscdd, read_csv

WALLS = """
[scene]
name = "test"
[time]
dt = 0.01
steps = 3
[[walls]]
type = "half_plane"
point = [0.0, 0.0]
[[walls]]
type = "disks"
points = [[-9.0, 0.0], [-9.0, 4.0]]
radius = 1.0
one_body = false
"""
BODIES = """
[[lattices]]
count = 6
x = [0.0, 6.0]
bottom = 0.1
radius = [0.5, 0.9]
velocity = [0.5, 0.0]
[[disks]]
centre = [20.0, 3.0]
radius = 0.3
kind = "prescribed"
spin = 2.0
[[clusters]]
disks = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.5]]
at = [[30.0, 5.0, 0.0]]
"""
TABLE = '[[disks]]\nfile = "{}"\n'


class Tables(ProgramTest):
    def test_notes_are_printed_and_kept(self):
        self.write("d.csv", "id,type,x,y,z,radius,mass\n1,1,1,2,0,0.5,0.785\n2,1,3,2,0,0.5,0.785\n")
        scene = self.write("test.toml", WALLS + TABLE.format("d.csv"))
        note = "d.csv: columns type, z, mass are not used."
        for command in (("check", scene), ("run", scene, "--out", self.folder / "out")):
            done = nscdd(*command)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual(done.stderr.count(note), 1, done.stderr)
        kept = json.loads((self.folder / "out/run.json").read_text())["notes"]
        self.assertEqual(len(kept), 1)
        self.assertTrue(kept[0].endswith(note), kept)
        quiet = nscdd("run", scene, "--quiet", "--out", self.folder / "out")
        self.assertEqual(quiet.stderr, "")

    def test_ids_beside_walls_are_the_same_on_all_ranks(self):
        self.write("d.csv", "id x y r\n" + "".join(f"{k} {3 * k} 2 0.5\n" for k in (1, 2, 5, 7, 300)))
        scene = self.write("test.toml", WALLS + TABLE.format("d.csv"))
        finals = [self.run_scene(scene, "--solver", "nscdd", "--subdomains", "3x1", out=f"ranks{ranks}", ranks=ranks)
                  for ranks in (1, 2, 3)]
        rows = read_csv(finals[0] / "final.csv")
        self.assertEqual({int(r["id"]): r["kind"] for r in rows},
                         {0: "wall", 3: "wall", 4: "wall", 6: "wall", **dict.fromkeys((1, 2, 5, 7, 300), "free")})
        for out in finals[1:]:
            self.assertEqual((out / "final.csv").read_bytes(), (finals[0] / "final.csv").read_bytes())

    def test_final_csv_is_read_back(self):
        for adapter in ("box2d", "reference"):
            first = self.run_scene(self.write("a.toml", WALLS + BODIES), "--adapter", adapter, out=adapter)
            rows = [r for r in read_csv(first / "final.csv") if r["kind"] in ("free", "prescribed")]
            self.assertEqual(len(rows), 7)
            # More walls than before, and one step without forces or contacts: what was read is what is written.
            text = WALLS.replace("steps = 3", "steps = 1").replace("dt = 0.01", "dt = 1e-12") + \
                WALLS[WALLS.index("[[walls]]"):].replace("-9.0", "-19.0") + TABLE.format(f"{adapter}/final.csv")
            scene = self.write("b.toml", text + "[gravity]\nvector = [0.0, 0.0]\n[solver]\nalert_distance = 1e-9\n")
            done = nscdd("run", scene, "--adapter", adapter, "--out", self.folder / (adapter + "2"))
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn("5 walls or clusters are left out", done.stderr)
            again = {r["id"]: r for r in read_csv(self.folder / (adapter + "2") / "final.csv")}
            self.assertEqual(len(again), 7 + 8)
            for row in rows:
                read = again[row["id"]]
                self.assertEqual(read["kind"], row["kind"])
                for key in ("x", "y", "angle", "vx", "vy", "spin", "radius"):
                    self.assertAlmostEqual(float(read[key]), float(row[key]), delta=1e-9, msg=key)

    def test_a_packing_is_read_beside_more_walls(self):
        self.run_scene(self.write("a.toml", WALLS + BODIES + '[output]\npacking = "packing.csv"\n'), out="a")
        packed = read_csv(self.folder / "a/packing.csv")
        more = WALLS + WALLS[WALLS.index("[[walls]]"):].replace("-9.0", "-19.0") + TABLE.format("a/packing.csv")
        rows = {r["id"]: r for r in read_csv(self.run_scene(self.write("b.toml", more), out="b") / "final.csv")}
        self.assertEqual(len(rows), len(packed) + 8)
        for disk in packed:
            self.assertEqual(rows[disk["id"]]["kind"], "free")


if __name__ == "__main__":
    unittest.main()
