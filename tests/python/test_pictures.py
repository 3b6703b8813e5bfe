"""Pictures of the package are those of the tools, bit for bit."""
import json
import os
import pathlib
import subprocess
import tempfile
import time
import unittest
import warnings

import numpy as np

import hiac
from cells import grid, mesh_of, view_of

RENDER = os.environ["HIAC_RENDER"]
SORT = os.environ["HIAC_SORT"]


def drawn_by_tool(folder, mesh, view, *options):
    """What hiac-render makes of a mesh in a file."""
    zoo, toml, image = (str(pathlib.Path(folder, name)) for name in ("m.zoo", "v.toml", "p.npy"))
    hiac.write(mesh, zoo)
    view.save(toml)
    subprocess.run([RENDER, zoo, "--view", toml, "-o", image, "-q", *options], check=True)
    return np.load(image)


class Pictures(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def same(self, mesh, view, *options, **keywords):
        expected = drawn_by_tool(self.folder, mesh, view, *options)
        found = hiac.render(mesh, view, **keywords).values
        self.assertEqual(found.shape, expected.shape)
        self.assertEqual(found.tobytes(), expected.tobytes())
        return found

    def test_every_kind_of_cell(self):
        for kind in hiac.KINDS:
            with self.subTest(kind=kind):
                mesh = mesh_of(kind)
                found = self.same(mesh, view_of(mesh))
                self.assertGreater(np.ptp(found[:, :, 0]), 0.01)  # something is to be seen

    def test_fields_of_every_place(self):
        mesh = mesh_of("brick20")
        for field in ("v:magnitude", "c", "position:z"):
            with self.subTest(field=field):
                self.same(mesh, view_of(mesh, field))

    def test_mixed_cells_and_channels(self):
        tetrahedra, bricks = mesh_of("tetrahedron4"), mesh_of("brick8")
        points = np.concatenate([tetrahedra.points, bricks.points + [2.0, 0, 0]])
        moved = bricks.cells[0][1] + np.uint32(len(tetrahedra.points))
        mesh = hiac.Mesh(points, [("tetrahedron4", tetrahedra.cells[0][1]), ("brick8", moved)],
                         {"s": hiac.Field(points[:, 0], "node")})
        self.same(mesh, view_of(mesh), "--channels", "depth,error", channels=["depth", "error"])

    def test_options(self):
        points, cells, values = grid(3, 0.1)
        mesh = hiac.Mesh(points, {"tetrahedron4": cells}, {"s": values})
        view = view_of(mesh)
        self.same(mesh, view, "--size", "31x20", size=(31, 20))
        self.same(mesh, view, "--samples", "2", "--filter", "bspline", samples=2, filter="bspline")
        self.same(mesh, view, "--crop", "5,6,20,10", crop=(5, 6, 20, 10))
        self.same(mesh, view, "--no-background", background=False)

    def test_field_ranges_and_view_as_assigned(self):
        mesh = mesh_of("tetrahedron10")
        view = view_of(mesh)
        view["volume.color.range"] = "auto"
        view.update({"isosurface": [{"field": "s", "value": 0.5, "opacity": 0.25}],
                     "skin.opacity": 0.2, "background.color": (0.1, 0.2, 1 / 3)})
        self.same(mesh, view)

    def test_given_orders(self):
        points, cells, values = grid(3, 0.1)
        mesh = hiac.Mesh(points, {"tetrahedron4": cells}, {"s": values})
        view = view_of(mesh)
        made = hiac.render(mesh, view).values
        order = hiac.sort(mesh, view)
        self.assertEqual(sorted(order.cells()), list(range(len(cells))))
        self.assertEqual(order.algorithm, "exact")
        self.assertEqual(hiac.render(mesh, view, order=order).values.tobytes(), made.tobytes())
        path = os.path.join(self.folder, "m.order")
        order.save(path)
        self.same(mesh, view, "--order", path, order=path)
        drawn_by_tool(self.folder, mesh, view)
        by_tool = os.path.join(self.folder, "tool.order")
        subprocess.run([SORT, f"{self.folder}/m.zoo", "--view", f"{self.folder}/v.toml", "-o",
                        by_tool, "-q"], check=True)
        np.testing.assert_array_equal(hiac.Order.load(by_tool).cells(), order.cells())
        other = view.copy()
        other["camera.eye"] = [9.0, 9.0, 9.0]
        with self.assertRaises(hiac.InputError):
            hiac.render(mesh, other, order=order)

    def test_explained_pixel_is_the_picture(self):
        mesh = mesh_of("brick20")
        view = view_of(mesh)
        picture = hiac.render(mesh, view)
        x, y = 24, 18
        pixel = hiac.explain_pixel(mesh, view, x, y)
        self.assertEqual([*pixel["color"], pixel["alpha"]], list(picture.values[y, x]))
        self.assertTrue(all(s["kind"] == "brick20" for s in pixel["segments"]))

    def test_files_and_bytes_of_notebooks(self):
        mesh = mesh_of("brick8")
        view = view_of(mesh)
        view["annotation.title.text"] = "Bricks"
        picture = hiac.render(mesh, view)
        ours, theirs = (os.path.join(self.folder, n) for n in ("ours.png", "theirs.png"))
        picture.save(ours)
        drawn_by_tool(self.folder, mesh, view)
        subprocess.run([RENDER, f"{self.folder}/m.zoo", "--view", f"{self.folder}/v.toml", "-o",
                        theirs, "-q"], check=True)
        self.assertTrue(hiac.compare(ours, theirs).equal)  # the title included
        self.assertGreater(hiac.compare(picture, ours).largest_error, 0.5)
        self.assertEqual(picture._repr_png_(), pathlib.Path(ours).read_bytes())
        self.assertEqual(hiac.View.load(ours).toml, picture.specification)
        del view["annotation"]
        plain = hiac.render(mesh, view)
        plain.save(ours)
        shown, _, _ = hiac._core.read_picture(ours, 0)
        encoded = np.where(shown <= 0.0031308, shown * 12.92, 1.055 * shown**(1 / 2.4) - 0.055)
        np.testing.assert_allclose(plain.display_bytes(), 255 * encoded[:, :, :3], atol=0.5001)

    def test_invisible_pictures_warn(self):
        mesh = mesh_of("brick8")
        view = view_of(mesh)
        view["camera.look_at"] = [1000.0, 1000.0, 1000.0]
        with self.assertWarns(hiac.PictureWarning):
            hiac.render(mesh, view)

    def test_a_call_costs_little(self):
        mesh = mesh_of("tetrahedron4")
        view = view_of(mesh, size=(8, 6))
        hiac.render(mesh, view)
        times = []
        for _ in range(30):
            start = time.perf_counter()
            hiac.render(mesh, view)
            times.append(time.perf_counter() - start)
        self.assertLess(min(times), 5e-3)

    def test_view_of_paraview(self):
        state = pathlib.Path(os.environ["HIAC_SAMPLES"], "reactor-pool", "state.pvsm")
        view = hiac.paraview.view_from_state(state)
        image = os.path.join(self.folder, "p.npy")
        data = state.with_name("flow.vtu")  # the state names a file of another machine
        mesh = hiac.read(data)
        zoo = os.path.join(self.folder, "m.zoo")
        hiac.write(mesh, zoo)
        subprocess.run([RENDER, zoo, "--view", state, "--size", "80x60", "-o", image, "-q"],
                       check=True)
        picture = hiac.render(mesh, view, size=(80, 60))
        self.assertTrue(view.data_file.endswith("run.vtu"))
        self.assertEqual(picture.values.tobytes(), np.load(image).tobytes())
        self.assertTrue(view.notes)
        with self.assertRaises(hiac.InputError):
            hiac.paraview.view_from_state(os.path.join(self.folder, "missing.pvsm"))

    def test_preview(self):
        mesh = mesh_of("tetrahedron4")
        view = view_of(mesh)
        if not (pathlib.Path(hiac.__file__).parent / "programs" / "hiac-preview").exists():
            with self.assertRaisesRegex(hiac.Error, "not a part of this installation"):
                hiac.preview(mesh, view)
            return
        found, exact = hiac.preview(mesh, view, size=(60, 40)), hiac.render(mesh, view, size=(60, 40))
        self.assertEqual(found.shape, (40, 60, 4))
        self.assertLess(np.abs(found[:, :, :3] - exact.values[:, :, :3]).max(), 1e-3)

    def test_presets_in_files_are_found_from_other_folders(self):
        map_points = [0, 0, 0, 1, 1, 1, 0, 0]
        preset = [{"Name": "ours", "ColorSpace": "RGB", "RGBPoints": map_points}]
        pathlib.Path(self.folder, "ours.json").write_text(json.dumps(preset))
        mesh = mesh_of("brick8")
        view = view_of(mesh)
        view.save(os.path.join(self.folder, "v.toml"))
        view = hiac.View.load(os.path.join(self.folder, "v.toml"))
        view["volume.color.preset"] = "ours.json"
        report = hiac.judge(hiac.render(mesh, view), mesh, view)
        self.assertEqual(report.channels["R"]["largest_error"], 0)

    def test_judgement_of_a_picture(self):
        mesh = mesh_of("brick20")
        view = view_of(mesh, size=(96, 72))
        exact = hiac.render(mesh, view)
        report = hiac.judge(exact, mesh, view)
        self.assertEqual([c["largest_error"] for c in report.channels.values()], [0] * 4)
        wrong = exact.rgba[:, :, :3] + 0.01 * (np.arange(96) > 50)[None, :, None]
        report = hiac.judge(wrong, mesh, view)
        for channel in report.channels.values():
            self.assertAlmostEqual(channel["largest_error"], 0.01, 12)
        self.assertGreater(np.ptp(report.heat_map[:, 40:60]), 0.1)
        self.assertEqual(np.ptp(report.heat_map[:, :50], axis=(0, 1)).max(), 0)
        turned = hiac.judge(exact.rgba[::-1, :, :3], mesh, view)
        self.assertNotEqual(turned.text.count("\n"), report.text.count("\n"))  # that is told

    def test_comparison_is_numpy_arithmetic(self):
        random = np.random.default_rng(5)
        a, b = random.random((20, 30, 3)), random.random((20, 30, 3))
        found = hiac.compare(a, b)
        for k, name in enumerate("RGB"):
            self.assertAlmostEqual(found.channels[name]["rmse"],
                                   np.sqrt(((a - b)[:, :, k]**2).mean()), 12)
        np.testing.assert_array_equal(found.differences, np.abs(a - b).max(2))
        self.assertAlmostEqual(found.psnr, -10 * np.log10(((a - b)**2).mean()), 9)
        self.assertTrue(hiac.compare(a, a).equal)
        with self.assertRaises(hiac.JudgementError):
            hiac.compare(a, a[:10])


if __name__ == "__main__":
    warnings.simplefilter("ignore", hiac.PictureWarning)
    unittest.main()
