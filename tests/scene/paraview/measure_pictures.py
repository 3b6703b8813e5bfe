"""Draws one smooth scene by ParaView's mappers, and says how hiac draws the same states.

    xvfb-run pvpython --force-offscreen-rendering tests/scene/paraview/measure_pictures.py FOLDER BIN

Makes the table of docs/paraview.md: ParaView's pictures, those of BIN/hiac-render from the states that
ParaView saved of them, and the differences of their bytes, in 1/255. hiac's pictures are blended in
display values, as ParaView's are.
"""
import pathlib
import subprocess
import sys

import numpy
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

MAPPERS = ("Projected tetra", "Z sweep", "Bunyk ray cast", "Resample To Image")
CELLS = (4, 8, 16, 32)  # along an edge of the cube
BLENDED = ["--set", "volume.color.color_space=linear", "--linear"]


def make_data(path, cells):
    """A cube of edge 4 whose field has no kink: a wave of about one period."""
    wave = Wavelet(WholeExtent=[0, cells, 0, cells, 0, cells])
    unit = Transform(Input=Tetrahedralize(Input=wave))
    unit.Transform.Scale, unit.Transform.Translate = [4.0 / cells] * 3, [-2.0] * 3
    field = Calculator(Input=unit, ResultArrayName="wave",
                       Function="0.5+0.25*sin(coordsX*1.3+0.4)+0.25*cos(coordsY*1.1-coordsZ*0.7)")
    SaveData(str(path), proxy=field, PointDataArrays=["wave"])


def draw(folder, name, mapper):
    """ParaView's picture and state of a mesh."""
    source = XMLUnstructuredGridReader(FileName=[str(folder / f"{name}.vtu")])
    view = CreateView("RenderView")
    view.ViewSize, view.OrientationAxesVisibility = [400, 300], 0
    view.UseColorPaletteForBackground, view.Background = 0, [0, 0, 0]
    shown = Show(source, view)
    ColorBy(shown, ("POINTS", "wave"))
    shown.SetRepresentationType("Volume")
    shown.SelectMapper, shown.ScalarOpacityUnitDistance = mapper, 1.0
    color, opacity = shown.LookupTable, shown.ScalarOpacityFunction
    color.RGBPoints, color.ColorSpace = [0.0, 0.1, 0.2, 0.9, 1.0, 0.9, 0.6, 0.1], "RGB"
    color.Discretize = 0
    opacity.Points = [0.0, 0.05, 0.5, 0.0, 1.0, 0.6, 0.5, 0.0]
    view.CameraPosition, view.CameraFocalPoint = [5.0, -8.0, 4.0], [0.0, 0.0, 0.0]
    view.CameraViewUp, view.CameraViewAngle = [0.0, 0.0, 1.0], 35.0
    Render(view)
    base = folder / f"{name}-{mapper.split()[0].lower()}"
    SaveScreenshot(f"{base}.paraview.png", view, ImageResolution=[400, 300])
    servermanager.SaveState(f"{base}.pvsm")
    return base


def pixels(picture):
    reader = vtkPNGReader()
    reader.SetFileName(picture)
    reader.Update()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())[:, :3].astype(float)


def differences(base, programs):
    """Root mean square, 99th percentile and maximum over all channels of pixels that either covers."""
    picture = f"{base}.hiac.png"
    subprocess.run([programs / "hiac-render", "-q", "--view", f"{base}.pvsm", *BLENDED, "-o", picture], check=True,
                   stdin=subprocess.DEVNULL)
    one, other = pixels(f"{base}.paraview.png"), pixels(picture)
    covered = (one + other).sum(axis=1) > 0
    error = numpy.abs(one - other)[covered]
    return numpy.sqrt((error ** 2).mean()), numpy.percentile(error, 99), error.max()


def main():
    folder, programs = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
    folder.mkdir(exist_ok=True)
    for cells in CELLS:
        name = f"wave{cells}"
        make_data(folder / f"{name}.vtu", cells)
        for mapper in MAPPERS:
            ResetSession()
            rms, most, largest = differences(draw(folder, name, mapper), programs)
            print(f"{name:7} {mapper:18} rms {rms:6.2f}  99 % {most:5.0f}  largest {largest:4.0f}", flush=True)


main()
