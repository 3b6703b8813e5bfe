"""Meshes of other packages, which are imported when they are needed.

They are handed over in files of VTK's XML format, in full precision, and read as hiac-convert reads
such files: what VTK's cells become is decided in one place.
"""
from __future__ import annotations

import os
import tempfile
from typing import Any

from ._mesh import Mesh
from ._reading import read, write
from .errors import UsageError

_WRITERS = {
    "vtkUnstructuredGrid": ("vtkXMLUnstructuredGridWriter", ".vtu"),
    "vtkStructuredGrid": ("vtkXMLStructuredGridWriter", ".vts"),
    "vtkRectilinearGrid": ("vtkXMLRectilinearGridWriter", ".vtr"),
    "vtkImageData": ("vtkXMLImageDataWriter", ".vti"),
}


def _vtk() -> tuple[Any, Any]:
    from vtkmodules import vtkCommonDataModel, vtkIOXML

    return vtkCommonDataModel, vtkIOXML


def from_vtk(dataset: Any, **options: Any) -> Mesh:
    """The mesh in a vtkUnstructuredGrid, vtkStructuredGrid, vtkRectilinearGrid or vtkImageData, with
    its point and cell data. options: those of read()."""
    _, io = _vtk()
    for name, (writer_name, extension) in _WRITERS.items():
        if dataset.IsA(name):
            break
    else:
        raise UsageError(f"{dataset.GetClassName()}: no dataset with volume cells "
                         f"({', '.join(_WRITERS)} expected)")
    writer = getattr(io, writer_name)()
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "mesh" + extension)
        writer.SetFileName(path)
        writer.SetInputData(dataset)
        writer.SetDataModeToAppended()
        writer.SetEncodeAppendedData(False)
        writer.SetCompressor(None)
        writer.SetHeaderTypeToUInt64()
        if writer.Write() != 1:
            raise UsageError(f"{dataset.GetClassName()}: VTK cannot write it")
        return read(path, **options)


def to_vtk(mesh: Mesh) -> Any:
    """The mesh as a vtkUnstructuredGrid. Raises InputError for kinds that VTK has no cell for."""
    _, io = _vtk()
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "mesh.vtu")
        write(mesh, path)
        reader = io.vtkXMLUnstructuredGridReader()
        reader.SetFileName(path)
        reader.Update()
        return reader.GetOutput()


def from_pyvista(dataset: Any, **options: Any) -> Mesh:
    """The mesh in a dataset of pyvista, which is one of VTK's. options: those of read()."""
    return from_vtk(dataset, **options)


def to_pyvista(mesh: Mesh) -> Any:
    """The mesh as a pyvista.UnstructuredGrid."""
    import pyvista

    return pyvista.wrap(to_vtk(mesh))


def from_meshio(mesh: Any, **options: Any) -> Mesh:
    """The mesh in a meshio.Mesh, with its point and cell data. options: those of read()."""
    import meshio

    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "mesh.vtu")
        meshio.write(path, mesh, file_format="vtu", compression=None)
        return read(path, **options)


def to_meshio(mesh: Mesh) -> Any:
    """The mesh as a meshio.Mesh. Raises InputError for kinds that VTK has no cell for."""
    import meshio

    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "mesh.vtu")
        write(mesh, path)
        return meshio.read(path)
