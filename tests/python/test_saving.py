"""No way of saving destroys a device, a pipe or a file of another kind."""
import os
import pathlib
import stat
import tempfile
import threading
import unittest
import warnings

import hiac
from cells import mesh_of, view_of


class Saving(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        mesh = mesh_of("brick8")
        view = view_of(mesh)
        order = hiac.sort(mesh, view)
        picture = hiac.render(mesh, view)
        # the kind, what saves it, and the file that it makes of the name "out" + extension
        self.ways = [("mesh", lambda path: hiac.write(mesh, path), extension)
                     for extension in (".zoo", ".vtu", ".vtkhdf", ".msh", ".stl", ".ply", ".vtp")]
        self.ways += [("picture", picture.save, extension)
                      for extension in (".npy", ".exr", ".png", ".tiff", ".sgi", ".pfm", ".hdr",
                                        ".f32")]
        self.ways += [("view", view.save, ".toml"), ("order", order.save, ".order")]

    def each(self):
        for kind, save, extension in self.ways:
            with self.subTest(kind=kind, extension=extension):
                name = self.folder / ("out" + extension)
                written = self.folder / "out.r.f32" if extension == ".f32" else name
                for file in self.folder.glob("out*"):
                    file.unlink()
                yield kind, lambda: save(name), written

    def test_devices_are_written_to(self):
        for _, save, written in self.each():
            written.symlink_to("/dev/full")
            with self.assertRaises(hiac.InputError) as caught:
                save()
            self.assertIn(f"{written}: cannot be written (No space left", str(caught.exception))
            self.assertTrue(stat.S_ISCHR(os.stat("/dev/full").st_mode))
            self.assertTrue(written.is_symlink())

    def test_pipes_are_written_to(self):
        for kind, save, written in self.each():
            save()
            expected = written.read_bytes()
            for file in self.folder.glob("out*"):
                file.unlink()
            os.mkfifo(written)
            got = []
            reader = threading.Thread(target=lambda: got.append(written.read_bytes()))
            reader.start()
            save()
            reader.join()
            self.assertTrue(stat.S_ISFIFO(os.stat(written).st_mode))
            if written.suffix != ".vtkhdf":  # has the time in it
                self.assertEqual(got[0], expected)

    def test_regular_files_keep_their_mode(self):
        for _, save, written in self.each():
            written.write_text("?")
            written.chmod(0o604)
            save()
            self.assertNotEqual(written.read_bytes(), b"?")
            self.assertEqual(stat.S_IMODE(os.stat(written).st_mode), 0o604)

    def test_files_of_another_kind_are_kept(self):
        kept = {}
        for kind, save, written in self.each():
            save()
            kept[kind, written.suffix] = written.read_bytes()
        for kind, save, written in self.each():
            for (other, suffix), content in kept.items():
                if other == kind or suffix == ".f32":  # values alone: nothing tells what they are
                    continue
                written.write_bytes(content)
                with self.assertRaises(hiac.UsageError, msg=suffix) as caught:
                    save()
                self.assertIn(f"{written}: is a file of another kind", str(caught.exception))
                self.assertEqual(written.read_bytes(), content)


if __name__ == "__main__":
    warnings.simplefilter("ignore", hiac.PictureWarning)
    unittest.main()
