# SPDX-License-Identifier: Apache-2.0
"""Does results.xdmf say what is in results.h5, and in the form that all readers of ParaView take?   structure.py DIR...

Needs h5py. `blocks(folder)` reads a results.xdmf; `check(folder)` raises AssertionError with what is wrong."""

import pathlib
import sys
import xml.etree.ElementTree as xml

import h5py
import numpy

KINDS = {"f": "Float", "i": "Int", "u": "UChar"}


class Grid:
    """One block at one time: points (n, 3), connectivity (rows, points per row), attributes by name."""

    def __init__(self, file, grid):
        topology, geometry = grid.find("Topology"), grid.find("Geometry")
        self.name = grid.get("Name")
        self.time = float(grid.find("Time").get("Value"))
        self.type = topology.get("TopologyType")
        self.rows = int(topology.get("NumberOfElements"))
        self.path, connectivity = data_of(file, topology)
        self.connectivity = connectivity.reshape(self.rows, int(topology.get("NodesPerElement")))
        assert geometry.get("GeometryType") == "XYZ", self.name
        self.points = data_of(file, geometry)[1]
        self.centring = {a.get("Name"): a.get("Center") for a in grid.iter("Attribute")}
        self.attributes = {a.get("Name"): data_of(file, a)[1] for a in grid.iter("Attribute")}
        self.types = {a.get("Name"): a.get("AttributeType") for a in grid.iter("Attribute")}


def data_of(file, element):
    """Name and values of the element's one data set, which must be in the file with the extent and the type that it says."""
    items = element.findall("DataItem")
    assert len(items) == 1, f"{element.tag} has {len(items)} data items, Xdmf3 wants one"
    name, path = items[0].text.split(":")
    assert name == "results.h5" and path in file, items[0].text
    data = file[path]
    assert data.shape == tuple(map(int, items[0].get("Dimensions").split())), (path, data.shape)
    assert data.dtype.itemsize == int(items[0].get("Precision")), (path, data.dtype)
    assert KINDS[data.dtype.kind] == items[0].get("NumberType"), (path, data.dtype)
    return path, data[...]


def blocks(folder):
    """{name of a block: [its Grid at each time]}"""
    folder = pathlib.Path(folder)
    with h5py.File(folder / "results.h5", "r") as file:
        domain = xml.parse(folder / "results.xdmf").getroot().find("Domain")
        for collection in domain:
            assert collection.get("GridType") == "Collection" and collection.get("CollectionType") == "Temporal"
        return {c.get("Name"): [Grid(file, grid) for grid in c.findall("Grid")] for c in domain}


def check_grid(grid, first):
    assert grid.name == first.name and grid.type == first.type
    assert grid.centring == first.centring and grid.types == first.types, f"{grid.name}: attributes differ in time"
    width = {"Polyvertex": 1, "Polyline": 2}[grid.type]
    assert grid.connectivity.shape == (grid.rows, width) and grid.points.shape == (len(grid.points), 3)
    # Each point is used.
    assert numpy.array_equal(numpy.unique(grid.connectivity), numpy.arange(len(grid.points))), f"{grid.path}: out of range"
    assert numpy.isfinite(grid.points).all() and not grid.points[:, 2].any()
    for name, values in grid.attributes.items():
        assert values.shape == ((grid.rows, 3) if grid.types[name] == "Vector" else (grid.rows,)), name
        assert grid.centring[name] == ("Node" if width == 1 else "Cell"), name


def check(folder):
    """Returns blocks(folder) if all is well."""
    found = blocks(folder)
    with h5py.File(pathlib.Path(folder) / "results.h5", "r") as file:
        assert file.attrs["format_version"] == 2
        dt, steps = file.attrs["dt"], sorted(file["steps"], key=int)
        times = [file["steps"][s].attrs["time"] for s in steps]
        assert times == [int(s) * dt for s in steps], "the time of step k must be the product k dt"
        for name, grids in found.items():
            assert [g.time for g in grids] == times, f"{name}: a block has a grid at every time"
            assert [g.path.split("/")[2] for g in grids] == steps, f"{name}: of the step of that time"
            for grid in grids:
                check_grid(grid, grids[0])
        for step in steps:
            contacts = file["steps"][step]["contacts"]
            assert numpy.array_equal(contacts["force_n"][:], contacts["impulse_n"][:] / dt)
            n, t = contacts["normal"][:], contacts["normal"][:][:, [1, 0, 2]] * [1, -1, 1]
            force = contacts["force_n"][:][:, None] * n + contacts["force_t"][:][:, None] * t
            assert numpy.allclose(contacts["force"][:], force, rtol=1e-14)
            ends = file["steps"][step]["chains/position"][:].reshape(-1, 2, 3)
            length = contacts["lever_a"][:] + contacts["lever_b"][:]
            assert numpy.allclose(ends[:, 1] - ends[:, 0], length[:, None] * n, atol=1e-9)
    return found


if __name__ == "__main__":
    for argument in sys.argv[1:]:
        result = check(argument)
        last = {name: grids[-1].rows for name, grids in result.items()}
        print(f"{argument}: {len(next(iter(result.values())))} times, rows at the last: {last}")
