"""Views mirror specifications, and refuse what the tools refuse."""
import os
import pathlib
import tempfile
import tomllib
import unittest

import numpy as np

import hiac
from cells import mesh_of, view_of


class Views(unittest.TestCase):
    def setUp(self):
        self.view = view_of(mesh_of("brick8"))

    def test_mirrors_the_text(self):
        data = tomllib.loads(self.view.toml)
        self.assertEqual(self.view["camera"]["fov"], data["camera"]["fov"])
        self.assertEqual(list(self.view["camera.eye"]), data["camera"]["eye"])
        self.assertEqual(set(self.view), set(data))
        self.assertEqual(self.view["light"][0]["color"], tuple(data["light"][0]["color"]))

    def test_assignments_by_all_ways(self):
        self.view["camera.fov"] = 20
        self.view["camera"]["up"] = np.array([0, 1.0, 0])
        self.view["isosurface"] = [{"field": "s", "value": 0.1}]
        self.view["isosurface.0.value"] = 0.1 + 0.2
        self.view["isosurface"][0]["opacity"] = 0.5
        data = tomllib.loads(self.view.toml)
        self.assertEqual(data["camera"]["fov"], 20)
        self.assertEqual(data["camera"]["up"], [0, 1, 0])
        self.assertEqual(data["isosurface"], [{"field": "s", "value": 0.1 + 0.2, "opacity": 0.5}])
        del self.view["isosurface"]
        self.assertNotIn("isosurface", self.view)

    def test_refused_changes_change_nothing(self):
        before = self.view.toml
        for key, value in (("camera.fov", 200), ("camera.fow", 20), ("camera.eye", "left"),
                           ("image.width", 0), ("render.integration", "wrong")):
            with self.subTest(key=key), self.assertRaises(hiac.InputError) as caught:
                self.view[key] = value
            self.assertIn(key.split(".")[1], str(caught.exception))
        with self.assertRaises(hiac.UsageError):
            self.view["camera.fov"] = object()
        self.assertEqual(self.view.toml, before)

    def test_changes_that_belong_together(self):
        with self.assertRaises(hiac.InputError):
            self.view["camera.projection"] = "orthographic"
        del_fov = {k: v for k, v in self.view["camera"].items() if k != "fov"}
        self.view.update({"camera": {**del_fov, "projection": "orthographic", "height": 2.5}})
        self.assertEqual(self.view["camera.height"], 2.5)

    def test_files(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "v.toml")
            self.view.save(path)
            self.assertIn("#", pathlib.Path(path).read_text())  # comments stay
            read = hiac.View.load(path)
            self.assertEqual(read, self.view)
            with self.assertRaisesRegex(hiac.InputError, "missing.toml"):
                hiac.View.load(os.path.join(folder, "missing.toml"))
            pathlib.Path(path).write_text("[camera]\nfov = 'wide'\n")
            with self.assertRaisesRegex(hiac.InputError, "v.toml:"):
                hiac.View.load(path)

    def test_numbers_are_exact(self):
        random = np.random.default_rng(11)
        for value in np.exp(random.uniform(-300, 200, 200)):
            self.view.update({"camera.clip": [0.0, float(value)]}) if value < 1e90 else None
            self.assertEqual(hiac.View.loads(self.view.toml)["camera.clip"],
                             self.view["camera.clip"])

    def test_any_text_in_strings(self):
        for text in ('a "quoted" title', "back\\slash", "ü µ 中", "# no comment"):
            self.view["annotation.title.text"] = text
            self.assertEqual(hiac.View.loads(self.view.toml)["annotation.title.text"], text)


if __name__ == "__main__":
    unittest.main()
