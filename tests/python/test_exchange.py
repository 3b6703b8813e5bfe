"""Meshes of VTK, pyvista and meshio are what hiac-convert reads from their files."""
import os
import pathlib
import sys
import types
import unittest

import numpy as np

import hiac
from cells import mesh_of

DATA = pathlib.Path(os.environ["HIAC_DATA"])
MOST_BYTES = int(os.environ.get("HIAC_EXCHANGE_BYTES", "300000"))

try:
    from vtkmodules import vtkIOLegacy, vtkIOXML
except ImportError:
    vtkIOXML = None
try:
    import meshio
except ImportError:
    meshio = None


def read_by_vtk(path):
    """The dataset in a file, or None where VTK does not read it, or not as volume cells."""
    readers = {".vtu": "vtkXMLUnstructuredGridReader", ".vts": "vtkXMLStructuredGridReader",
               ".vtr": "vtkXMLRectilinearGridReader", ".vti": "vtkXMLImageDataReader"}
    if path.suffix == ".vtk":
        reader = vtkIOLegacy.vtkGenericDataObjectReader()
        for kind in ("Scalars", "Vectors", "Normals", "Tensors", "ColorScalars", "TCoords",
                     "Fields"):
            getattr(reader, f"ReadAll{kind}On")()
    else:
        reader = getattr(vtkIOXML, readers[path.suffix])()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput() if path.suffix != ".vtk" else reader.GetOutputDataObject(0)


@unittest.skipIf(vtkIOXML is None, "VTK's Python modules are not installed")
class FromVtk(unittest.TestCase):
    @unittest.skipUnless(DATA.is_dir(), "the shared data are not there")
    def test_shared_files(self):
        seen = 0
        for path in sorted([*(DATA / "vtk_xml").rglob("*.vt[ursi]"),
                            *(DATA / "vtk_legacy").rglob("*.vtk")]):
            if path.stat().st_size > MOST_BYTES:
                continue
            try:
                expected = hiac.read(path)
            except hiac.Error:
                continue  # not a mesh that hiac-convert takes
            with self.subTest(path=path.name):
                self.assertEqual(hiac.from_vtk(read_by_vtk(path)).content_hash(),
                                 expected.content_hash())
                seen += 1
        self.assertGreater(seen, 10)

    def test_there_and_back(self):
        for kind in ("tetrahedron4", "tetrahedron10", "pyramid13", "prism15", "brick20"):
            mesh = mesh_of(kind)
            again = hiac.from_vtk(hiac.to_vtk(mesh))
            self.assertEqual([k for k, _ in again.cells], [kind])
            np.testing.assert_array_equal(again.points, mesh.points)
            np.testing.assert_array_equal(again.cells[0][1], mesh.cells[0][1])
            np.testing.assert_array_equal(again.fields["v"].values, mesh.fields["v"].values)

    def test_pyvista_by_a_stand_in(self):
        stand_in = types.ModuleType("pyvista")
        stand_in.wrap = lambda dataset: dataset  # documented: VTK's dataset, as pyvista's subclass
        sys.modules.setdefault("pyvista", stand_in)
        self.addCleanup(lambda: sys.modules.pop("pyvista", None))
        mesh = mesh_of("brick8")
        again = hiac.from_pyvista(hiac.to_pyvista(mesh))
        np.testing.assert_array_equal(again.points, mesh.points)

    def test_surfaces_are_refused(self):
        from vtkmodules.vtkCommonDataModel import vtkPolyData

        with self.assertRaisesRegex(hiac.UsageError, "vtkPolyData"):
            hiac.from_vtk(vtkPolyData())


@unittest.skipIf(meshio is None, "meshio is not installed")
class FromMeshio(unittest.TestCase):
    def test_there_and_back(self):
        for kind, name in (("tetrahedron4", "tetra"), ("tetrahedron10", "tetra10"),
                           ("brick8", "hexahedron"), ("brick20", "hexahedron20"),
                           ("prism6", "wedge")):
            mesh = mesh_of(kind)
            other = hiac.to_meshio(mesh)
            self.assertEqual([block.type for block in other.cells], [name])
            if kind != "prism6":  # meshio turns these the other way round, and back
                np.testing.assert_array_equal(other.cells[0].data, mesh.cells[0][1])
            again = hiac.from_meshio(other)
            np.testing.assert_array_equal(again.points, mesh.points)
            np.testing.assert_array_equal(again.cells[0][1], mesh.cells[0][1])
            np.testing.assert_array_equal(again.fields["s"].values, mesh.fields["s"].values)


if __name__ == "__main__":
    unittest.main()
