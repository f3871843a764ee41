# SPDX-License-Identifier: Apache-2.0
"""results.h5 and results.xdmf of real runs, as structure.py checks them, and that it sees what is wrong."""

import json
import pathlib
import re
import sys
import unittest

import h5py
import numpy

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "runner"))
from program import SCENES, TWO_DISKS, ProgramTest, nscdd  # noqa: E402
from structure import check  # noqa: E402


STEPS = {"clusters": 120}  # until they touch


class Structure(ProgramTest):
    def check_scene(self, scene, *arguments, steps=4, ranks=0, out="out"):
        folder = self.run_scene(scene, "--steps", steps, "--save-every", steps // 2, *arguments, out=out, ranks=ranks)
        return folder, check(folder)

    def test_sample_scenes(self):
        for name in ("rotating_box_730", "sloped_flow_750", "drum", "clusters"):
            with self.subTest(scene=name):
                _, found = self.check_scene(SCENES / f"{name}.toml", steps=STEPS.get(name, 4), out=name)
                self.assertEqual(list(found), ["grains", "contacts", "chains", "walls"])
                self.assertEqual([g.rows for g in found["contacts"]][0], 0)  # before the first step
                self.assertGreater(found["contacts"][-1].rows, 0)

    def test_ranks_agree(self):
        """The rows are the same, in whatever order."""
        for name in ("clusters", "drum"):
            arguments = "--solver", "nscdd", "--subdomains", "2x2"
            steps = STEPS.get(name, 4)
            _, one = self.check_scene(SCENES / f"{name}.toml", *arguments, steps=steps, out=name + "1")
            _, two = self.check_scene(SCENES / f"{name}.toml", *arguments, steps=steps, ranks=2, out=name + "2")
            for block in one:
                for a, b in zip(one[block], two[block]):
                    with self.subTest(scene=name, block=block, time=a.time):
                        self.assertTrue(numpy.array_equal(rows_of(a), rows_of(b)))

    def test_every_disk_of_a_cluster_is_a_grain(self):
        folder, found = self.check_scene(SCENES / "clusters.toml")
        with h5py.File(folder / "results.h5") as file:
            shapes = file["shapes"]
            disks = numpy.flatnonzero(shapes["kind"][:] == 0)
            for grid, step in zip(found["grains"], sorted(file["steps"], key=int)):
                grains = file["steps"][step]["grains"]
                plain = ~numpy.isin(grains["id"][:], shapes["body"][:])
                self.assertEqual(grid.rows, len(disks) + plain.sum())
                row = {id: i for i, id in enumerate(grains["id"][:])}
                expected = []
                for k in disks:
                    i = row[shapes["body"][k]]
                    c, s = numpy.cos(grains["angle"][i]), numpy.sin(grains["angle"][i])
                    arm = numpy.array([[c, -s], [s, c]]) @ [shapes["x0"][k], shapes["y0"][k]]
                    expected.append([*(grains["position"][i][:2] + arm), shapes["radius"][k]])
                expected += [[*p[:2], r] for p, r in zip(grains["position"][plain], grains["radius"][plain])]
                seen = numpy.column_stack([grid.points[:, :2], grid.attributes["radius"]])
                self.assertTrue(numpy.allclose(sort_rows(seen), sort_rows(expected), atol=1e-12))

    def test_walls(self):
        """A half-plane as long as the sample, a fixed disks as circles, a segment as it is."""
        text = TWO_DISKS.replace("[[disks]]\ncentre = [0.0, 1.0]", """[[walls]]
type = "segments"
points = [[-3.0, 0.0], [-3.0, 5.0]]
[[walls]]
type = "disks"
points = [[4.0, 1.0], [8.0, 1.0]]
radius = 1.0
spacing = 4.0
[[disks]]
centre = [0.0, 1.0]""", 1)
        _, found = self.check_scene(self.write("walls.toml", text))
        walls = found["walls"][-1]
        ends = walls.points[walls.connectivity]
        bodies = walls.attributes["body"]
        lines = {body: ends[bodies == body] for body in set(bodies)}
        plane, segment, disks = (lines[body] for body in sorted(lines))
        self.assertEqual(len(plane), 1)
        self.assertTrue((plane[0][:, 1] == 0).all())
        self.assertAlmostEqual(abs(plane[0][0, 0] - plane[0][1, 0]), numpy.hypot(12.0, 5.0), places=2)  # from -3 to 9, 0 to 5
        self.assertAlmostEqual(plane[0][:, 0].mean(), 3.0)
        self.assertEqual(sorted(map(tuple, segment[0][:, :2])), [(-3.0, 0.0), (-3.0, 5.0)])
        for x, circle in ((4.0, disks[:16]), (8.0, disks[16:])):
            self.assertEqual(len(circle), 16)
            self.assertTrue(numpy.allclose(numpy.hypot(*(circle[:, 0, :2] - [x, 1.0]).T), 1.0))
            self.assertTrue(numpy.allclose(circle[:, 1], numpy.roll(circle[:, 0], -1, axis=0)))  # closed

    def test_chains_lead_from_centre_to_centre_or_to_the_wall(self):
        folder, _ = self.check_scene(self.write("test.toml", TWO_DISKS))
        with h5py.File(folder / "results.h5") as file:
            step = file["steps/000004"]
            contacts = step["contacts"]
            pair = {(a, b): k for k, (a, b) in enumerate(zip(contacts["body_a"][:], contacts["body_b"][:]))}
            ends = step["chains/position"][:].reshape(-1, 2, 3)
            self.assertTrue(numpy.allclose(ends[pair[1, 2]][:, :2], [[0, 1], [0, 3]], atol=1e-4))
            self.assertTrue(numpy.allclose(sorted(ends[pair[0, 1]][:, 1]), [0, 1], atol=1e-4))
            weight = contacts["force_n"][pair[0, 1]]
            self.assertGreater(weight, 0.0)
            self.assertTrue(numpy.allclose(contacts["force"][pair[0, 1]], [0.0, weight, 0.0], atol=1e-9 * weight))

    def test_times_and_the_initial_state(self):
        folder, _ = self.check_scene(self.write("test.toml", TWO_DISKS.replace("dt = 0.01", "dt = 0.1")), steps=12)
        with h5py.File(folder / "results.h5") as file:
            self.assertEqual(list(file["steps"]), ["000000", "000001", "000006", "000012"])
            self.assertEqual(file.attrs["dt"], 0.1)
            self.assertEqual(file["steps/000006"].attrs["time"], 6 * 0.1)  # which is not 0.1 + 0.1 + ...
            initial = file["steps/000000"]
            self.assertEqual(initial.attrs["time"], 0.0)
            self.assertEqual(initial.attrs["mean_radius"], 1.0)
            order = numpy.argsort(initial["grains/id"][:])
            self.assertEqual(initial["grains/position"][:][order].tolist(), [[0, 0, 0], [0, 1, 0], [0, 3, 0]])
        self.assertEqual(json.loads((folder / "run.json").read_text())["dt"], 0.1)
        self.assertEqual(nscdd("render", folder, "--step", 0).returncode, 0)

    def test_files_of_the_earlier_format_are_refused(self):
        folder, _ = self.check_scene(self.write("test.toml", TWO_DISKS))
        with h5py.File(folder / "results.h5", "r+") as file:
            file.attrs["format_version"] = 1
        done = nscdd("render", folder)
        self.assertEqual(done.returncode, 2)
        self.assertIn("format version 1, this program reads 2: run the scene again, or use nscdd", done.stderr)

    def test_faults_are_seen(self):
        folder, _ = self.check_scene(self.write("test.toml", TWO_DISKS))
        text = (folder / "results.xdmf").read_text()
        faults = {
            "a missing data set": text.replace("/grains/spin", "/grains/spun", 1),
            "a wrong extent": re.sub(r'Dimensions="3 3"', 'Dimensions="2 3"', text, count=1),
            "a wrong type": text.replace('NumberType="UChar"', 'NumberType="Int"', 1),
            "a wrong time": re.sub(r'Value="0.02"', 'Value="0.020000000000000004"', text, count=1),
            "a grid less": re.sub(r'   <Grid Name="chains".*?</Grid>\n', "", text, count=1, flags=re.S),
            "an attribute less": re.sub(r'    <Attribute Name="spin".*\n', "", text, count=1),
            "coordinates in two data sets": re.sub(r"(<Geometry[^>]*>)(.*)</Geometry>", r"\1\2\2</Geometry>", text, count=1),
        }
        for what, spoilt in faults.items():
            with self.subTest(what):
                self.assertNotEqual(spoilt, text)
                (folder / "results.xdmf").write_text(spoilt)
                with self.assertRaises(AssertionError):
                    check(folder)


def sort_rows(rows):
    rows = numpy.asarray(rows)
    return rows[numpy.lexsort(rows.round(9).T)]


def rows_of(grid):
    """Each row's points and attributes, sorted."""
    if grid.rows == 0:
        return numpy.empty(0)
    columns = [grid.points[grid.connectivity], *grid.attributes.values()]
    rows = numpy.column_stack([c.reshape(grid.rows, -1).astype(float) for c in columns])
    return rows[numpy.lexsort(rows.T)]


if __name__ == "__main__":
    unittest.main()
