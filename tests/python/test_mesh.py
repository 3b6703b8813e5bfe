"""Meshes and arrays: without copies, and refused where they are wrong."""
import gc
import os
import tempfile
import unittest
import weakref

import numpy as np

import hiac
from cells import grid, mesh_of


def address(array):
    return array.__array_interface__["data"][0]


class Meshes(unittest.TestCase):
    def test_arrays_are_not_copied(self):
        points, cells, values = grid(4)
        mesh = hiac.Mesh(points, {"tetrahedron4": cells}, {"s": values})
        self.assertEqual(address(mesh.points), address(points))
        self.assertEqual(address(mesh.cells[0][1]), address(cells))
        self.assertEqual(address(mesh.fields["s"].values), address(values))
        again = hiac.Mesh(mesh.points, mesh.cells, mesh.fields)
        self.assertEqual(address(again.points), address(points))
        self.assertEqual(again.content_hash(), mesh.content_hash())
        with self.assertRaises(ValueError):
            mesh.points[0, 0] = 1

    def test_owners_live_as_long_as_their_views(self):
        points, cells, values = grid(2)
        owner = weakref.ref(points)
        mesh = hiac.Mesh(points, {"tetrahedron4": cells}, {"s": values})
        del points
        seen = mesh.points
        del mesh
        gc.collect()
        self.assertIsNotNone(owner())
        self.assertEqual(seen[-1, 0], 2.0)
        del seen
        gc.collect()
        self.assertIsNone(owner())

    def test_every_kind_goes_through_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            for kind in hiac.KINDS:
                mesh = mesh_of(kind)
                path = os.path.join(folder, "m.zoo")
                hiac.write(mesh, path)
                read = hiac.read(path)
                self.assertEqual(read.content_hash(), mesh.content_hash())
                self.assertEqual([k for k, _ in read.cells], [kind])
                np.testing.assert_array_equal(read.fields["v"].values, mesh.fields["v"].values)
                self.assertEqual(read.fields["s"].unit, "K")

    def test_runs_of_kinds(self):
        points = np.random.default_rng(1).random((8, 3))
        cells = [("tetrahedron4", [[0, 1, 2, 3]]), ("pyramid5", [[0, 1, 2, 3, 4]]),
                 ("tetrahedron4", [[4, 5, 6, 7], [0, 5, 6, 7]])]
        mesh = hiac.Mesh(points, cells)
        self.assertEqual([(k, n.tolist()) for k, n in mesh.cells], cells)

    def test_scalars_and_further_fields(self):
        mesh = mesh_of("brick8")
        self.assertIn("v:magnitude", mesh.scalar_names)
        v = mesh.fields["v"].values
        np.testing.assert_allclose(mesh.scalar("v:magnitude").values, np.linalg.norm(v, axis=1))
        more = mesh.with_fields({"s": hiac.Field(v[:, 0], "node"), "t": hiac.Field(v, "node")})
        np.testing.assert_array_equal(more.fields["s"].values, v[:, 0])
        self.assertEqual(sorted(more.fields), ["c", "s", "t", "v"])
        self.assertEqual(address(more.points), address(mesh.points))

    def test_what_is_wrong_is_said(self):
        points, cells, values = grid(1)
        wrong = [
            (hiac.UsageError, "shape", (points[:, :2], {"tetrahedron4": cells})),
            (hiac.UsageError, "no kind", (points, {"tetra": cells})),
            (hiac.UsageError, "expected", (points, {"brick8": cells})),
            (hiac.UsageError, "-1", (points, {"tetrahedron4": cells.astype(int) - 1})),
            (hiac.UsageError, "whole numbers", (points, {"tetrahedron4": cells * 1.0})),
            (hiac.InputError, "node", (points, {"tetrahedron4": cells + np.uint32(5)})),
            (hiac.InputError, "", (points * np.nan, {"tetrahedron4": cells})),
            (hiac.UsageError, "values fit", (points, {"tetrahedron4": cells}, {"s": values[:3]})),
        ]
        for kind, words, arguments in wrong:
            with self.subTest(words=words), self.assertRaisesRegex(kind, words) as caught:
                hiac.Mesh(*arguments)
            self.assertNotIn("\n", str(caught.exception))

    def test_locations_are_named(self):
        points, cells, values = grid(1)
        for location, count in (("node", 8), ("cell", 6), ("corner", 24)):
            field = hiac.Field(np.arange(float(count)), location)
            mesh = hiac.Mesh(points, {"tetrahedron4": cells}, {"f": field})
            self.assertEqual(mesh.fields["f"].location, location)
            self.assertEqual(mesh.fields["f"].values[-1], count - 1)
        with self.assertRaisesRegex(
                hiac.UsageError, "^field location `face`: node, cell or corner expected$"):
            hiac.Mesh(points, {"tetrahedron4": cells}, {"f": hiac.Field(values, "face")})

    def test_tetrahedra_of_cells(self):
        mesh = mesh_of("brick20")
        parts = hiac.tetrahedralize(mesh)
        self.assertEqual({k for k, _ in parts.cells}, {"tetrahedron10"})
        corners = parts.points[parts.cells[0][1][:, :4]]
        volumes = np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6
        self.assertAlmostEqual(volumes.sum(), 2.0, 12)
        with self.assertRaisesRegex(hiac.UsageError, "^levels: only with linearize$"):
            hiac.tetrahedralize(mesh, levels=1)
        with self.assertRaisesRegex(hiac.UsageError, r"^levels: 0 to \d+ expected \(99 found\)$"):
            hiac.tetrahedralize(mesh, linearize=True, levels=99)

    def test_reports(self):
        mesh = mesh_of("tetrahedron4")
        report = hiac.check(mesh, overlap=True)
        self.assertTrue(report)
        turned = hiac.Mesh(mesh.points, {"tetrahedron4": mesh.cells[0][1][:, [1, 0, 2, 3]]})
        both = np.concatenate([mesh.cells[0][1][:1], turned.cells[0][1][1:]])
        report = hiac.check(hiac.Mesh(mesh.points, {"tetrahedron4": both}))
        self.assertFalse(report.valid)
        self.assertIn("inverted", [f["defect"] for f in report.findings])

    def test_meshes_are_freed(self):
        def kilobytes():
            with open("/proc/self/statm") as file:
                return int(file.read().split()[1]) * 4

        points, cells, values = grid(8)
        for k in range(60):
            if k == 10:
                before = kilobytes()
            mesh = hiac.Mesh(points, {"tetrahedron4": cells}, {"s": values})
            hiac.render(mesh, hiac.starter_view(mesh, size=(16, 12)))
        self.assertLess(kilobytes() - before, 10_000)


if __name__ == "__main__":
    unittest.main()
