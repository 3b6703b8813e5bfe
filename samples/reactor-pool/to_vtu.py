#!/usr/bin/python3
"""Turns flow.txt, which pool.edp writes, into flow.vtu: quadratic tetrahedra, zlib-compressed.

    /usr/bin/python3 to_vtu.py [flow.txt [flow.vtu]]      (Debian: python3-vtk9, python3-numpy)

Checks what it writes and prints the facts that README.md states; a failed check ends it.
"""
import sys

import numpy as np
import vtk
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray

# Edges of a tetrahedron in FreeFem++'s order of P2 nodes, and in VTK's.
FREEFEM_EDGES = [(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)]
VTK_EDGES = [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)]


def read_flow(path):
    """Returns positions, velocities, pressures and cells in VTK's node order."""
    with open(path) as file:
        nodes, cells = map(int, file.readline().split())
        table = np.loadtxt(file, max_rows=nodes)
        cell_nodes = np.loadtxt(file, max_rows=cells, dtype=np.int64)
    assert table.shape == (nodes, 7) and cell_nodes.shape == (cells, 10)
    order = [0, 1, 2, 3] + [4 + FREEFEM_EDGES.index(edge) for edge in VTK_EDGES]
    return table[:, :3], table[:, 3:6], table[:, 6], cell_nodes[:, order]


def check(xyz, velocity, pressure, cells):
    """Ends the program unless mesh and fields are sound; prints the facts."""
    assert np.isfinite(xyz).all() and np.isfinite(velocity).all() and np.isfinite(pressure).all()
    assert np.array_equal(np.unique(cells), np.arange(len(xyz))), "a node belongs to no cell"
    corners = xyz[cells[:, :4]]
    edge_vectors = corners[:, 1:] - corners[:, :1]
    jacobian = np.linalg.det(edge_vectors)
    assert (jacobian > 0).all(), "a cell is turned inside out"
    size = np.abs(edge_vectors).max(axis=(1, 2))
    off = [np.abs(xyz[cells[:, 4 + k]] - (corners[:, a] + corners[:, b]) / 2).max(axis=1) / size
           for k, (a, b) in enumerate(VTK_EDGES)]
    assert np.max(off) < 1e-12, "a mid-edge node is not at its edge's middle"
    speed = np.linalg.norm(velocity, axis=1)
    print(f"cells {len(cells)}, nodes {len(xyz)}, volume {jacobian.sum() / 6:.6f} m3")
    print(f"smallest Jacobian {jacobian.min():.3e} m3, mid-edge nodes off by {np.max(off):.1e}")
    print(f"speed up to {speed.max():.4f} m/s, pressure {pressure.min():.1f} to "
          f"{pressure.max():.1f} Pa")
    print("speed at corners alone up to "
          f"{speed[np.unique(cells[:, :4])].max():.4f} m/s")


def unstructured_grid(xyz, velocity, pressure, cells):
    grid = vtk.vtkUnstructuredGrid()
    points = vtk.vtkPoints()
    points.SetData(numpy_to_vtk(np.ascontiguousarray(xyz), deep=True))
    grid.SetPoints(points)
    table = vtk.vtkCellArray()
    offsets = np.arange(0, cells.size + 1, 10, dtype=np.int64)
    table.SetData(numpy_to_vtkIdTypeArray(offsets, deep=True),
                  numpy_to_vtkIdTypeArray(np.ascontiguousarray(cells).ravel(), deep=True))
    grid.SetCells(vtk.VTK_QUADRATIC_TETRA, table)
    for name, values in (("velocity", velocity), ("pressure", pressure)):
        array = numpy_to_vtk(np.ascontiguousarray(values, dtype=np.float32), deep=True)
        array.SetName(name)
        grid.GetPointData().AddArray(array)
    grid.GetPointData().SetActiveVectors("velocity")
    return grid


def main():
    source = sys.argv[1] if len(sys.argv) > 1 else "flow.txt"
    target = sys.argv[2] if len(sys.argv) > 2 else "flow.vtu"
    flow = read_flow(source)
    check(*flow)
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetFileName(target)
    writer.SetInputData(unstructured_grid(*flow))
    writer.SetCompressorTypeToZLib()
    writer.SetCompressionLevel(9)
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()
    writer.SetHeaderTypeToUInt32()
    if not writer.Write():
        sys.exit(f"to_vtu.py: {target}: cannot be written")


if __name__ == "__main__":
    main()
