"""Work on meshes beside pictures: tetrahedra, and previews by the graphics hardware."""
from __future__ import annotations

import os
import tempfile
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core, _programs
from ._mesh import Mesh
from ._view import View


def tetrahedralize(
    mesh: Mesh,
    *,
    linearize: bool = False,
    levels: int = 0,
    progress: Any = None,
    cancel: _core.Cancellation | None = None,
) -> Mesh:
    """Cuts a mesh's cells into conforming tetrahedra, as `hiac-tetrahedralize --cells` does, with
    its fields: quadratic and cubic cells become 10- and 20-node tetrahedra, or linear ones with
    `linearize`, whose edges are first halved `levels` times."""
    return Mesh._of(_core.tetrahedralize(mesh._handle, linearize, levels, progress, cancel))


def preview(
    mesh: Mesh,
    view: View,
    *,
    size: tuple[int, int] | None = None,
    method: str = "exact",
    cancel: _core.Cancellation | None = None,
) -> npt.NDArray[np.float64]:
    """A quick picture by the graphics hardware (hiac-preview): linear premultiplied R G B A, shape
    (height, width, 4). method: "exact", or "M0" to "M3". Raises Error where hiac-preview is not a
    part of the installation, or finds no OpenGL."""
    with tempfile.TemporaryDirectory() as folder:
        specification = os.path.join(folder, "view.toml")
        result = os.path.join(folder, "picture.npy")
        view._save_elsewhere(specification)
        arguments = ["-", "--view", specification, "--method", method, "-o", result]
        if size is not None:
            arguments += ["--size", f"{int(size[0])}x{int(size[1])}"]
        with _programs.run("hiac-preview", arguments, mesh._handle, cancel):
            return np.load(result)
