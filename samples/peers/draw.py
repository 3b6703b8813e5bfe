#!/usr/bin/python3
"""Draws an image specification of hiac with one of VTK's mappers of unstructured volumes.

    draw.py MESH.vtu SPECIFICATION.toml MAPPER PICTURE.npy [--first-frame] [--floats]

MAPPER: projected (vtkProjectedTetrahedraMapper), raycast (vtkUnstructuredGridVolumeRayCastMapper,
Bunyk's algorithm), tuned (the same with the linear integrator in place of the default one, which
looks segments up in a table, and with the picture moved by half a pixel, as it samples corners of
pixels) or zsweep (vtkUnstructuredGridVolumeZSweepMapper). The picture is the window's: 8 bits a channel, as a
user sees it; rows from the top, R G B from 0 to 1, linear as the specification's colours are. The second frame is kept; with --first-frame the first one. With --floats,
for projected alone, the picture is what the mapper blended before the window made bytes of it: R G B A in
single precision, colours as weighed by alpha.

What is read of the specification: image, camera, points of volume.color and volume.extinction. The
background has to be black. Needs a display (xvfb-run) and python3-vtk9.
"""
import sys
import tomllib

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401, the factory of windows
import vtkmodules.vtkRenderingVolumeOpenGL2  # noqa: F401, the factory of mappers
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_FLOAT, vtkUnsignedCharArray
from vtkmodules.vtkCommonDataModel import VTK_TETRA, vtkPiecewiseFunction
from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
from vtkmodules.vtkRenderingCore import (vtkColorTransferFunction, vtkRenderer, vtkRenderWindow,
                                         vtkVolume, vtkVolumeProperty)
from vtkmodules.vtkRenderingOpenGL2 import (vtkFramebufferPass, vtkRenderStepsPass,
                                            vtkTextureObject)
from vtkmodules.vtkRenderingVolume import (vtkProjectedTetrahedraMapper,
                                           vtkUnstructuredGridLinearRayIntegrator,
                                           vtkUnstructuredGridVolumeRayCastMapper,
                                           vtkUnstructuredGridVolumeZSweepMapper)


def read_tetrahedra(path, name):
    """The mesh as VTK's mappers take it: linear tetrahedra, whatever it has."""
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(path)
    reader.Update()
    grid = reader.GetOutput()
    grid.GetPointData().SetActiveScalars(name)
    if set(np.unique(vtk_to_numpy(grid.GetCellTypesArray()))) == {VTK_TETRA}:
        return grid
    cut = vtkDataSetTriangleFilter()
    cut.SetInputData(grid)
    cut.TetrahedraOnlyOn()
    cut.Update()
    return cut.GetOutput()


def make_mapper(name):
    if name == "projected":
        return vtkProjectedTetrahedraMapper()
    classes = {"raycast": vtkUnstructuredGridVolumeRayCastMapper,
               "tuned": vtkUnstructuredGridVolumeRayCastMapper,
               "zsweep": vtkUnstructuredGridVolumeZSweepMapper}
    mapper = classes[name]()
    if name == "tuned":
        mapper.SetRayIntegrator(vtkUnstructuredGridLinearRayIntegrator())
    mapper.AutoAdjustSampleDistancesOff()  # else the picture is as coarse as the machine is slow
    mapper.SetImageSampleDistance(1)
    return mapper


def make_property(volume):
    """Opacity o over the unit distance u means the extinction o / u to these mappers; opacities above
    1 wrap round in the projected tetrahedra's bytes, so the largest extinction becomes 1."""
    colors, opacities = vtkColorTransferFunction(), vtkPiecewiseFunction()
    colors.SetColorSpaceToRGB()
    for scalar, *rgb in volume["color"]["points"]:
        colors.AddRGBPoint(scalar, *rgb)
    largest = max(extinction for _, extinction in volume["extinction"]["points"])
    for scalar, extinction in volume["extinction"]["points"]:
        opacities.AddPoint(scalar, extinction / largest)
    prop = vtkVolumeProperty()
    prop.SetColor(colors)
    prop.SetScalarOpacity(opacities)
    prop.SetScalarOpacityUnitDistance(1 / largest)
    prop.SetInterpolationTypeToLinear()
    prop.ShadeOff()
    return prop


def place_camera(camera, view):
    camera.SetPosition(view["eye"])
    camera.SetFocalPoint(view["look_at"])
    camera.SetViewUp(view["up"])
    if view["projection"] == "orthographic":
        camera.ParallelProjectionOn()
        camera.SetParallelScale(view["height"] / 2)
    else:
        camera.SetViewAngle(view["fov"])


def pixels(window, width, height):
    bytes_of_window = vtkUnsignedCharArray()
    window.GetPixelData(0, 0, width - 1, height - 1, 0, bytes_of_window, 0)
    return vtk_to_numpy(bytes_of_window).reshape(height, width, 3)[::-1] / 255


def float_pass():
    """Lets a renderer draw into floats. The projected tetrahedra copy their depths from it, which OpenGL
    does between depths of one kind alone."""
    to_floats = vtkFramebufferPass()
    to_floats.SetDelegatePass(vtkRenderStepsPass())
    to_floats.SetColorFormat(vtkTextureObject.Float32)
    to_floats.SetDepthFormat(vtkTextureObject.Fixed24)
    return to_floats


def floats(drawn, width, height):
    values = np.zeros((height, width, 4), np.float32)
    if not drawn.GetColorTexture().Download().Download2D(VTK_FLOAT, values, [width, height], 4,
                                                         [0, 0]):
        sys.exit("draw.py: VTK does not hand over its floats")
    return values[::-1]


def draw(mesh, specification, mapper, first_frame=False, is_moved=False, as_floats=False):
    """The window's picture; moved, its mapper samples the middles of pixels."""
    with open(specification, "rb") as file:
        scene = tomllib.load(file)
    width, height = scene["image"]["width"], scene["image"]["height"]
    renderer, window = vtkRenderer(), vtkRenderWindow()
    renderer.SetBackground(0, 0, 0)
    place_camera(renderer.GetActiveCamera(), scene["camera"])
    if is_moved:
        renderer.GetActiveCamera().SetWindowCenter(1 / width, 1 / height)
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(0)
    window.SetSize(width, height)
    window.AddRenderer(renderer)
    if as_floats:
        renderer.SetBackgroundAlpha(0)
        renderer.SetPass(float_pass())
    volume = vtkVolume()
    mapper.SetInputData(read_tetrahedra(mesh, scene["volume"]["color"]["field"]))
    volume.SetMapper(mapper)
    volume.SetProperty(make_property(scene["volume"]))
    renderer.AddVolume(volume)
    renderer.ResetCameraClippingRange()
    for _ in range(1 if first_frame else 2):
        window.Render()
    if as_floats:
        return floats(renderer.GetPass(), width, height)
    return pixels(window, width, height)


def main():
    arguments = [a for a in sys.argv[1:] if a not in ("--first-frame", "--floats")]
    as_floats = "--floats" in sys.argv
    if len(arguments) != 4 or arguments[2] not in ("projected", "raycast", "tuned", "zsweep"):
        sys.exit(__doc__)
    mesh, specification, name, picture = arguments
    if as_floats and name != "projected":
        sys.exit(__doc__)
    np.save(picture, draw(mesh, specification, make_mapper(name), "--first-frame" in sys.argv,
                          is_moved=name == "tuned", as_floats=as_floats))


if __name__ == "__main__":
    main()
