"""The notebooks of samples/ run from their first cell to their last."""
import contextlib
import io
import json
import os
import pathlib
import unittest

FOLDER = pathlib.Path(os.environ["HIAC_SAMPLES"], "notebooks")

try:
    import ipywidgets
except ImportError:
    ipywidgets = None


def code_of(path):
    cells = json.loads(path.read_text())["cells"]
    return ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]


@unittest.skipIf(ipywidgets is None, "ipywidgets is not installed")
class Notebooks(unittest.TestCase):
    def test_notebooks(self):
        notebooks = sorted(FOLDER.glob("*.ipynb"))
        self.assertGreaterEqual(len(notebooks), 2)
        before = os.getcwd()
        self.addCleanup(os.chdir, before)
        os.chdir(FOLDER)
        for path in notebooks:
            with self.subTest(path=path.name), contextlib.redirect_stdout(io.StringIO()) as out:
                names = {"__name__": "__main__"}
                for number, code in enumerate(code_of(path)):
                    exec(compile(code, f"{path.name}, cell {number}", "exec"), names)
                self.assertTrue(out.getvalue())
                height, width, _ = names["picture"].values.shape
                self.assertEqual((width, height), (480, 360))


if __name__ == "__main__":
    unittest.main()
