"""Makes the states of this folder, and what ParaView itself computes for them (states/NAME.truth).

    xvfb-run pvpython --force-offscreen-rendering tests/scene/paraview/make_states.py states

Written with ParaView 5.11.0 (Debian 12). A state loses what no view depends on: domains, twins
`...Info`, decoration, and proxies that are neither view, representation, transfer function nor
pipeline.

A truth is lines of a word and numbers: `corner` x y z and the position on the picture in pixels from
its left upper corner; `color` scalar r g b (vtkColorTransferFunction::GetTable
of one scalar); `table` r g b (the discretized table, before bytes); `opacity` scalar o.
"""
import pathlib
import sys
import xml.etree.ElementTree as ElementTree

from paraview import servermanager
from paraview.simple import *

KEPT = {("views", "RenderView"), ("lookup_tables", "PVLookupTable"),
        ("piecewise_functions", "PiecewiseFunction"), ("settings", "ColorPalette"),
        ("representations", "UnstructuredGridRepresentation"),
        ("representations", "GeometryRepresentation")}
GLYPHS = {"ArrowSource", "ConeSource", "CubeSource", "CylinderSource", "LineSource", "SphereSource",
          "GlyphSource2D"}
RAMP = [0.0, 0.2, 0.3, 0.9, 0.35, 0.9, 0.85, 0.1, 1.0, 0.8, 0.1, 0.3]
DECORATION = ("Axes", "Coat", "CustomShader", "Gaussian", "Glyph", "Info", "LIC", "Mask", "Noise", "OSPRay",
              "Polar", "Texture")


def is_kept(proxy):
    kind = proxy.get("group"), proxy.get("type")
    return kind in KEPT or kind[0] in ("sources", "filters") and kind[1] not in GLYPHS


def strip(path):
    tree = ElementTree.parse(path)
    manager = tree.getroot().find("ServerManagerState")
    for proxy in manager.findall("Proxy"):
        if not is_kept(proxy):
            manager.remove(proxy)
            continue
        for prop in proxy.findall("Property"):
            if any(word in prop.get("name") for word in DECORATION):
                proxy.remove(prop)
            for child in prop.findall("Domain") + prop.findall("Hints"):
                prop.remove(child)
    for settings in manager.findall("Settings"):
        manager.remove(settings)
    for collection in manager.findall("ProxyCollection"):
        if collection.get("name").startswith("pq_helper"):
            manager.remove(collection)
    tree.write(path)


def make_data(folder):
    wave = Wavelet(WholeExtent=[-2, 2, -2, 2, -2, 2])
    cells = Tetrahedralize(Input=wave)
    vector = Calculator(Input=cells, ResultArrayName="velocity",
                        Function="coordsX*iHat+(2*coordsY-1)*jHat+(coordsZ*coordsX+3)*kHat")
    size = PointDatatoCellData(Input=vector, ProcessAllArrays=1, PassPointData=1)
    SaveData(str(folder / "block.vtu"), proxy=size, DataMode="Appended", CompressorType="ZLib")
    for source in (size, vector, cells, wave):
        Delete(source)


def positions(view, bounds):
    """The corners of a box on the picture."""
    renderer = view.GetRenderer()
    width, height = view.ViewSize
    for index in range(8):
        point = [bounds[2 * axis + (index >> axis & 1)] for axis in range(3)]
        renderer.SetWorldPoint(*point, 1)
        renderer.WorldToView()
        x, y, _ = renderer.GetViewPoint()
        yield (*point, (x + 1) / 2 * width, (1 - y) / 2 * height)


def write_truth(path, view, source, color, opacity, count):
    lines = [("corner", *c) for c in positions(view, source.GetDataInformation().GetBounds())]
    function = color.GetClientSideObject()
    low, high = function.GetRange()
    if function.GetDiscretize():
        size = function.GetNumberOfValues()
        table = [0.0] * (3 * size)
        function.GetTable(low, high, size, table)
        lines += [("table", *table[3 * k:3 * k + 3]) for k in range(size)]
    margin = 0.02 * (high - low) if not function.GetUseLogScale() else 0
    scalars = [low - margin + (high - low + 2 * margin) * k / (count - 1) for k in range(count)]
    rgb = [0.0] * 3
    for scalar in scalars:
        function.GetTable(scalar, scalar, 1, rgb)
        lines.append(("color", scalar, *rgb))
    curve = opacity.GetClientSideObject()
    low, high = curve.GetRange()
    scalars = [low + (high - low) * k / (count - 1) for k in range(count)]
    lines += [("opacity", s, curve.GetValue(s)) for s in scalars]
    text = "".join(word + "".join(f" {n:.9g}" for n in numbers) + "\n" for word, *numbers in lines)
    path.write_text(text)


def ramp(low, high, logarithmic=False):
    points = list(RAMP)
    for k in range(0, len(points), 4):
        points[k] = low * (high / low) ** points[k] if logarithmic else low + (high - low) * points[k]
    return points


class Case:
    """One state: a volume of block.vtu, changed by the case, saved with its truth."""

    def __init__(self, folder, name, array=("POINTS", "RTData"), span=(40.0, 260.0)):
        self.folder, self.name = folder, name
        ResetSession()
        self.source = XMLUnstructuredGridReader(FileName=[str(folder / "block.vtu")])
        self.view = CreateView("RenderView")
        self.view.ViewSize = [300, 200]
        self.shown = Show(self.source, self.view)
        ColorBy(self.shown, array)
        self.shown.SetRepresentationType("Volume")
        self.color, self.opacity = self.shown.LookupTable, self.shown.ScalarOpacityFunction
        self.color.RGBPoints = ramp(*span)
        self.color.Discretize = 0
        self.opacity.Points = [span[0], 0, 0.5, 0, span[0] + 0.4 * (span[1] - span[0]), 0.6, 0.5, 0,
                               span[1], 0.2, 0.5, 0]
        self.view.CameraPosition, self.view.CameraFocalPoint = [4.0, -9.0, 5.0], [0.1, 0.2, -0.3]
        self.view.CameraViewUp, self.view.CameraViewAngle = [0.1, 0.2, 1.0], 33.0

    def save(self, count=100):
        Render(self.view)
        path = self.folder / (self.name + ".pvsm")
        servermanager.SaveState(str(path))
        # the data lie beside the state, wherever the folder is
        path.write_text(path.read_text().replace(str(self.folder), "/data/of/paraview"))
        strip(path)
        write_truth(self.folder / (self.name + ".truth"), self.view, self.source, self.color, self.opacity, count)


def spaces(folder):
    for name, space in (("rgb", "RGB"), ("lab", "Lab"), ("diverging", "Diverging"), ("step", "Step"),
                        ("ciede2000", "Lab/CIEDE2000")):
        case = Case(folder, name)
        case.color.ColorSpace = space
        case.save(1000)
    for wrap in (0, 1):
        case = Case(folder, f"hsv{wrap}")
        case.color.ColorSpace, case.color.HSVWrap = "HSV", wrap
        case.shown.SelectMapper = ("Z sweep", "Bunyk ray cast")[wrap]
        case.save(1000)


def scales(folder):
    case = Case(folder, "log")
    case.color.RGBPoints, case.color.ColorSpace = ramp(2.0, 2000.0, True), "Lab"
    case.color.UseLogScale = 1
    case.opacity.Points = [2.0, 0.1, 0.5, 0, 100.0, 0.7, 0.3, 0.0, 2000.0, 0.3, 0.5, 0.0]
    case.opacity.UseLogScale = 1
    case.save(1000)
    case = Case(folder, "table")
    case.color.ColorSpace, case.color.Discretize, case.color.NumberOfTableValues = "Diverging", 1, 11
    case.save()
    case = Case(folder, "logtable")
    case.color.RGBPoints, case.color.UseLogScale = ramp(2.0, 2000.0, True), 1
    case.color.Discretize, case.color.NumberOfTableValues = 1, 16
    case.save()


def arrays(folder):
    case = Case(folder, "magnitude", ("POINTS", "velocity"), (1.0, 8.0))
    case.save()
    case = Case(folder, "component", ("CELLS", "velocity", "Y"), (-4.0, 3.0))
    case.view.CameraParallelProjection, case.view.CameraParallelScale = 1, 3.25
    case.view.UseColorPaletteForBackground, case.view.BackgroundColorMode = 0, "Gradient"
    case.view.Background, case.view.Background2 = [0.8, 0.7, 0.6], [0.1, 0.2, 0.3]
    case.save()
    case = Case(folder, "separate")
    case.shown.UseSeparateOpacityArray = 1
    case.shown.OpacityArrayName, case.shown.OpacityComponent = ["POINTS", "velocity"], "X"
    case.save()


def curves(folder):
    case = Case(folder, "sharp")
    case.opacity.Points = [40.0, 0.0, 0.3, 0.0, 90.0, 0.8, 0.6, 0.4, 150.0, 0.1, 0.2, 1.0, 200.0, 0.9, 0.5, 0.05,
                           260.0, 0.3, 0.5, 0.0]
    case.save(1000)
    case = Case(folder, "resample")
    case.shown.SelectMapper = "Resample To Image"
    case.shown.ScalarOpacityUnitDistance = 0.7
    case.opacity.Points = [40.0, 0.0, 0.5, 0.0, 200.0, 1.0, 0.5, 0.0, 260.0, 0.25, 0.5, 0.0]
    case.save()


def surfaces(folder):
    case = Case(folder, "surfaces")
    case.color.Discretize = 1
    contour = Contour(Input=case.source, ContourBy=["POINTS", "RTData"], Isosurfaces=[120.0, 180.0])
    shown = Show(contour, case.view)
    ColorBy(shown, None)
    shown.DiffuseColor, shown.AmbientColor = [0.9, 0.5, 0.2], [0.9, 0.5, 0.2]
    shown.Opacity, shown.Specular, shown.SpecularPower = 0.4, 0.3, 40
    colored = Contour(Input=case.source, ContourBy=["POINTS", "RTData"], Isosurfaces=[150.0])
    ColorBy(Show(colored, case.view), ("POINTS", "RTData"))
    Show(Slice(Input=case.source), case.view)
    SetActiveSource(case.source)
    case.save()
    case = Case(folder, "views")
    other = CreateView("RenderView")
    other.ViewSize = [120, 90]
    RenameView("Second", other)
    shown = Show(case.source, other)
    shown.SetRepresentationType("Volume")
    ColorBy(shown, ("POINTS", "velocity"))
    case.save()


def main():
    folder = pathlib.Path(sys.argv[1]).resolve()
    make_data(folder)
    for part in (spaces, scales, arrays, curves, surfaces):
        part(folder)


main()
