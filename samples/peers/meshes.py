"""The meshes of docs/peers.md: cubes of a few kinds of cells, with the field "f" at their nodes.

Every function returns points (n x 3), VTK's type of all cells, and cells (m x nodes of a cell).
"""
import itertools

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (VTK_HEXAHEDRON, VTK_QUADRATIC_TETRA, VTK_TETRA,
                                           vtkCellArray, vtkUnstructuredGrid)
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter


def field(points):
    """0 to 1, smooth, with several maxima in the unit cube."""
    x, y, z = points.T
    wave = np.sin(2 * np.pi * x) * np.sin(2 * np.pi * y) * np.cos(np.pi * z)
    return 0.5 + 0.5 * wave * np.exp(-((points - 0.5) ** 2).sum(axis=1))


def lattice(n, jitter):
    """The nodes of n^3 cubes, those inside moved by up to `jitter` of a cube's edge."""
    axis = np.linspace(0, 1, n + 1)
    points = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), -1).reshape(-1, 3)
    inside = ((points > 0) & (points < 1)).all(axis=1)
    random = np.random.default_rng(1)
    points[inside] += jitter / n * (2 * random.random((inside.sum(), 3)) - 1)
    return points


def bricks(n, jitter):
    """Hexahedra; a jitter makes their faces curved."""
    index = np.arange((n + 1) ** 3).reshape(n + 1, n + 1, n + 1)
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    cells = [index[i:n + i, j:n + j, k:n + k].ravel() for i, j, k in corners]
    return lattice(n, jitter), VTK_HEXAHEDRON, np.stack(cells, axis=1)


def tetrahedra(n, jitter):
    """Kuhn's division: six tetrahedra a cube, one for each way along its edges from corner to corner."""
    index = np.arange((n + 1) ** 3).reshape(n + 1, n + 1, n + 1)
    cells = []
    for way in itertools.permutations(range(3)):
        steps = [np.zeros(3, int)]
        for axis in way:
            steps.append(steps[-1] + np.eye(3, dtype=int)[axis])
        nodes = [index[i:n + i, j:n + j, k:n + k].ravel() for i, j, k in steps]
        if np.linalg.det(np.diff(steps, axis=0)) < 0:
            nodes[2], nodes[3] = nodes[3], nodes[2]
        cells.append(np.stack(nodes, axis=1))
    return lattice(n, jitter), VTK_TETRA, np.concatenate(cells)


def hollow(n, jitter):
    """The tetrahedra whose centres are outside a ball: a mesh that is not convex."""
    points, kind, cells = tetrahedra(n, jitter)
    distance = np.linalg.norm(points[cells].mean(axis=1) - 0.5, axis=1)
    used, cells = np.unique(cells[distance > 0.3], return_inverse=True)
    return points[used], kind, cells.reshape(-1, 4)


def quadratic(n, jitter):
    """Ten-node tetrahedra with straight edges; the field is sampled at the middles of edges, too."""
    points, _, cells = tetrahedra(n, jitter)
    edges = np.concatenate([np.sort(cells[:, [a, b]], axis=1)
                            for a, b in ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3))])
    unique, number = np.unique(edges, axis=0, return_inverse=True)
    middles = points[unique].mean(axis=1)
    nodes = len(points) + number.reshape(6, -1).T
    return np.concatenate([points, middles]), VTK_QUADRATIC_TETRA, np.hstack([cells, nodes])


def far_away(n, jitter):
    """The tetrahedra, 1e6 of their size away from the origin."""
    points, kind, cells = tetrahedra(n, jitter)
    return points + 1e6, kind, cells, field(points)


def write(path, points, kind, cells, values=None):
    """Writes a .vtu; `values`: of the field, where it is not that of the points."""
    grid = vtkUnstructuredGrid()
    places = vtkPoints()
    places.SetDataTypeToDouble()
    places.SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=1))
    grid.SetPoints(places)
    offsets = np.arange(0, cells.size + 1, cells.shape[1], dtype=np.int64)
    array = vtkCellArray()
    array.SetData(numpy_to_vtkIdTypeArray(offsets, deep=1),
                  numpy_to_vtkIdTypeArray(np.ascontiguousarray(cells, np.int64).ravel(), deep=1))
    grid.SetCells(kind, array)
    data = numpy_to_vtk(field(points) if values is None else values, deep=1)
    data.SetName("f")
    grid.GetPointData().AddArray(data)
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(grid)
    if not writer.Write():
        raise OSError(f"{path}: cannot be written")
