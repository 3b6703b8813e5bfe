"""Visibility orders."""
from __future__ import annotations

import os
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core
from ._mesh import Mesh
from ._view import View


class Order:
    """The visibility order of a mesh's cells for a view, or one for each frame of a camera path."""

    def __init__(self, handle: _core.Order) -> None:
        self._handle = handle

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Order:
        """Reads an order file of hiac-sort."""
        return cls(_core.load_order(os.fspath(path)))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes an order file, for hiac-render --order."""
        self._handle.save(os.fspath(path))

    @property
    def frames(self) -> int:
        """How many orders there are."""
        return self._handle.frames

    @property
    def algorithm(self) -> str:
        """The algorithm that made them."""
        return self._handle.algorithm

    def cells(self, frame: int = 0) -> npt.NDArray[np.uint32]:
        """All cells, front to back, shape (cells,)."""
        return self._handle.cells(frame)

    def groups(self, frame: int = 0) -> list[tuple[int, int]]:
        """Runs of cells that have no order (visibility cycles): first index into cells, count."""
        return self._handle.groups(frame)


def sort(
    mesh: Mesh,
    view: View,
    *,
    algorithm: str = "exact",
    overlap: bool = False,
    progress: Any = None,
    cancel: _core.Cancellation | None = None,
) -> Order:
    """The visibility order of a mesh's cells, as hiac-sort finds it.

    algorithm: "exact", "stein", "multitiled", "mpvo" or "centroid". Raises JudgementError where an
    algorithm meets a cycle that it has no answer to.
    """
    return Order(_core.sort(mesh._handle, view._scene(None), algorithm, overlap, progress, cancel))
