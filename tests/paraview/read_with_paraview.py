# SPDX-License-Identifier: Apache-2.0
"""Opens results with ParaView and compares what each of its readers shows with results.h5.

    pvpython tests/paraview/read_with_paraview.py DIR...        # folders of nscdd run
    xvfb-run -a pvpython tests/paraview/read_with_paraview.py --picture out.png DIR

Debian: paraview, python3-paraview (5.11.0), python3-h5py; for pictures without a screen xvfb, xauth, libgl1-mesa-dri. Installs
nothing. Each reader runs in a process of its own, for a reader may take the process with it."""

import argparse
import os
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

try:
    from paraview import servermanager, simple, vtk
    from paraview.vtk.util.numpy_support import vtk_to_numpy
except ImportError:
    sys.exit("read_with_paraview.py: no paraview module: apt-get install paraview python3-paraview, and run it with pvpython")
import numpy

READERS = {
    "the reader that ParaView chooses": lambda file: simple.OpenDataFile(file),
    "XDMFReader": lambda file: simple.XDMFReader(FileNames=[file]),
    "Xdmf3ReaderS": lambda file: simple.Xdmf3ReaderS(FileName=[file]),
    "Xdmf3ReaderT": lambda file: simple.Xdmf3ReaderT(FileName=[file]),
}


def leaves(data):
    """The blocks, in order; an empty one may be missing (None)."""
    iterator = data.NewIterator()
    iterator.SkipEmptyNodesOff()
    iterator.InitTraversal()
    while not iterator.IsDoneWithTraversal():
        yield iterator.GetCurrentDataObject()
        iterator.GoToNextItem()


def same(seen, expected):
    return seen.shape == expected.shape and numpy.array_equal(seen, expected)


def compare(block, grid):
    what = f"{grid.name} at {grid.time}"
    if grid.rows == 0:
        assert block is None or block.GetNumberOfPoints() == 0, what
        return
    assert block.GetNumberOfPoints() == len(grid.points) and block.GetNumberOfCells() == grid.rows, what
    assert same(vtk_to_numpy(block.GetPoints().GetData()), grid.points), what
    bounds = numpy.ravel([grid.points.min(axis=0), grid.points.max(axis=0)], order="F")
    assert numpy.allclose(block.GetBounds(), bounds, rtol=0, atol=0), what
    points = vtk.vtkIdList()
    for cell in range(grid.rows):
        block.GetCellPoints(cell, points)
        assert [points.GetId(k) for k in range(points.GetNumberOfIds())] == list(grid.connectivity[cell]), what
    for name, values in grid.attributes.items():
        data = block.GetPointData() if grid.centring[name] == "Node" else block.GetCellData()
        assert data.HasArray(name), f"{what}: no {name}"
        assert same(vtk_to_numpy(data.GetArray(name)), values), f"{what}: {name}"


def read(folder, reader_name):
    import structure
    expected = structure.check(folder)
    file = str(pathlib.Path(folder).resolve() / "results.xdmf")  # Xdmf3 looks for results.h5 beside an absolute name only
    reader = READERS[reader_name](file)
    times = [grid.time for grid in next(iter(expected.values()))]
    assert list(reader.TimestepValues) == times, f"times {list(reader.TimestepValues)}, expected {times}"
    for step, time in enumerate(times):
        reader.UpdatePipeline(time)
        blocks = list(leaves(servermanager.Fetch(reader)))
        assert len(blocks) == len(expected), f"{len(blocks)} blocks, expected {list(expected)}"
        for block, grids in zip(blocks, expected.values()):
            compare(block, grids[step])
    rows = {name: grids[-1].rows for name, grids in expected.items()}
    print(f"ok  {folder}  {reader_name} ({reader.SMProxy.GetXMLName()}): {len(times)} times, at the last {rows}", flush=True)


def draw(folder, picture):
    """README.md's recipe: spheres by radius, tubes by normal force, walls."""
    simple._DisableFirstRenderCameraReset()
    reader = simple.OpenDataFile(str(pathlib.Path(folder).resolve() / "results.xdmf"))
    time = reader.TimestepValues[-1]
    reader.UpdatePipeline(time)
    view = simple.CreateView("RenderView")
    view.ViewSize = [1200, 1000]
    view.Background = [1, 1, 1]
    view.UseColorPaletteForBackground = 0
    view.OrientationAxesVisibility = 0
    view.ViewTime = time

    grains = simple.Threshold(Input=reader, Scalars=["POINTS", "radius"], LowerThreshold=1e-300, UpperThreshold=1e300)
    spheres = simple.Glyph(Input=grains, GlyphType="Sphere", GlyphMode="All Points", ScaleArray=["POINTS", "radius"],
                           OrientationArray=["POINTS", "No orientation array"], ScaleFactor=2.0)
    spheres.GlyphType.ThetaResolution = spheres.GlyphType.PhiResolution = 16
    shown = simple.Show(spheres, view)
    simple.ColorBy(shown, ("POINTS", "velocity", "Magnitude"))
    shown.RescaleTransferFunctionToDataRange(False)

    chains = simple.Threshold(Input=reader, Scalars=["CELLS", "force_n"], LowerThreshold=1e-300, UpperThreshold=1e300)
    points = simple.CellDatatoPointData(Input=simple.MergeBlocks(Input=chains))
    points.UpdatePipeline(time)
    largest = points.PointData["force_n"].GetRange()[1] if points.PointData.GetArray("force_n") else 1.0
    radius = numpy.mean(grains.PointData["radius"].GetRange())
    tubes = simple.Tube(Input=simple.ExtractSurface(Input=points), Scalars=["POINTS", "force_n"], VaryRadius="By Scalar",
                        Radius=0.02 * radius, RadiusFactor=25.0)
    red = simple.Show(tubes, view)
    red.AmbientColor = red.DiffuseColor = [0.75, 0.05, 0.05]
    simple.ColorBy(red, ("POINTS", ""))
    red.Position = [0, 0, 4 * radius]  # before the spheres

    lines = simple.Threshold(Input=reader, Scalars=["CELLS", "body"], LowerThreshold=0, UpperThreshold=1e300)
    black = simple.Show(lines, view)
    simple.ColorBy(black, ("POINTS", ""))
    black.AmbientColor = black.DiffuseColor = [0, 0, 0]
    black.LineWidth = 3
    view.InteractionMode = "2D"
    simple.ResetCamera(view)
    simple.Render(view)
    simple.SaveScreenshot(picture, view)
    print(f"{picture}: t = {time}, largest normal force {largest:.4g} N", flush=True)
    os._exit(0)  # leaving the ordinary way ends with an X error under Xvfb


def main():
    parser = argparse.ArgumentParser(description="Compares what ParaView's readers show with results.h5.")
    parser.add_argument("folders", nargs="+")
    parser.add_argument("--picture", help="draw the last state of the folder instead")
    parser.add_argument("--reader", choices=READERS, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.picture:
        return draw(arguments.folders[0], arguments.picture)
    if arguments.reader:
        return read(arguments.folders[0], arguments.reader)
    failed = 0
    for folder in arguments.folders:
        for reader in READERS:
            command = ["pvpython", "--force-offscreen-rendering", os.path.abspath(__file__), "--reader", reader, folder]
            done = subprocess.run(command, capture_output=True, text=True, check=False)
            print(done.stdout, end="")
            if done.returncode != 0:
                failed += 1
                print(f"FAILED  {folder}  {reader}: exit code {done.returncode}\n{done.stderr[-1500:]}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
