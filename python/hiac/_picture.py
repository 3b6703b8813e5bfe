"""Pictures, and what their pixels are made of."""
from __future__ import annotations

import os
import pathlib
import tempfile
import warnings
from collections.abc import Sequence
from typing import Any, Callable, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._mesh import Mesh
from ._order import Order
from ._view import View
from .errors import PictureWarning, UsageError

Progress = Union[Callable[[str, int, int], Any], None]


class Picture:
    """A picture in double precision, which does not change. A notebook shows it as a PNG."""

    def __init__(self, drawn: _core.Picture) -> None:
        self._drawn = drawn

    @property
    def values(self) -> npt.NDArray[np.float64]:
        """Shape (height, width, channels), row 0 on top; read-only, no copy. R G B A are linear and
        premultiplied, alpha = 1 - transparency; the requested channels follow."""
        return self._drawn.values

    @property
    def channels(self) -> list[str]:
        """The channels' names: "R", "G", "B", "A", and those requested."""
        return self._drawn.channels

    @property
    def rgba(self) -> npt.NDArray[np.float64]:
        """The first four channels, shape (height, width, 4); no copy."""
        return self.values[:, :, :4]

    def __getitem__(self, channel: str) -> npt.NDArray[np.float64]:
        """One channel, shape (height, width); no copy."""
        if channel not in self.channels:
            raise KeyError(channel)
        return self.values[:, :, self.channels.index(channel)]

    def __array__(self, dtype: Any = None, copy: Any = None) -> npt.NDArray[np.float64]:
        return np.array(self.values, dtype=dtype) if copy or dtype else self.values

    @property
    def facts(self) -> dict[str, Any]:
        """What was found: segments (of rays in cells), violations (of them out of order),
        covered_pixels, mean_optical_depth and largest_optical_depth (over these), mesh_hash."""
        names = ("segments", "violations", "covered_pixels", "mean_optical_depth",
                 "largest_optical_depth", "mesh_hash")
        return {name: getattr(self._drawn, name) for name in names}

    @property
    def specification(self) -> str:
        """The specification it was made by, complete, as TOML."""
        return self._drawn.specification

    def save(self, path: str | os.PathLike[str], *, linear: bool = False, depth: int = 0) -> None:
        """Writes the picture in the format of the name's extension, as hiac-render does: .npy
        .f32 .exr .png .tiff .sgi .pfm .hdr. depth: bits per sample, 0: the format's first. Integer
        samples are sRGB-encoded unless `linear`, and show the specification's annotation."""
        self._drawn.save(os.fspath(path), linear, depth)

    def display_bytes(self) -> npt.NDArray[np.uint8]:
        """R G B as a screen shows them, shape (height, width, 3): those of an 8-bit PNG."""
        return self._drawn.display_bytes()

    def _repr_png_(self) -> bytes:
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "picture.png")
            self.save(path)
            return path.read_bytes()

    def __repr__(self) -> str:
        height, width, _ = self.values.shape
        return f"<hiac.Picture: {width} x {height} pixels, channels {' '.join(self.channels)}>"


def _options(order, crop, background, frame, skip_invalid, overlap):
    options = _core.DrawingOptions()
    if isinstance(order, (str, os.PathLike)):
        order = Order.load(order)
    if order is not None:
        options.order = order._handle
    options.crop = None if crop is None else list(crop)
    options.background, options.frame = background, frame
    options.skip_invalid, options.overlap = skip_invalid, overlap
    return options


def render(
    mesh: Mesh,
    view: View,
    *,
    size: tuple[int, int] | None = None,
    channels: Sequence[str] = (),
    samples: int = 1,
    filter: str = "box",
    crop: tuple[int, int, int, int] | None = None,
    background: bool = True,
    frame: int = 0,
    order: Order | str | os.PathLike[str] | None = None,
    overlap: bool = False,
    skip_invalid: bool = False,
    progress: Progress = None,
    cancel: _core.Cancellation | None = None,
) -> Picture:
    """The picture of a mesh: hiac-render's, bit for bit.

    size: (width, height) in pixels instead of the view's. channels: further ones: "depth" and
    "mean_depth" (world units along the view direction), "transparency", "cells", "witness",
    "error" (a bound of every colour's error). samples: n x n rays a pixel, weighted by `filter`
    ("box", "bspline"). crop: (x, y, width, height) of the part to draw. frame: of a camera path.
    order: one that sort() or hiac-sort made; default: made here, and kept with the mesh for the
    next picture from the same place. overlap: sort overlapping cells pixel by pixel. skip_invalid:
    leave out cells that are partly turned inside out.

    progress: called about ten times a second as progress(stage, done, total), total 0 if unknown;
    an exception that it raises stops the work. Ctrl-C and `cancel` stop it within 50 ms. The GIL is
    released meanwhile; any number of threads may draw the same mesh. PictureWarnings say why
    something may not be seen.
    """
    if filter not in ("box", "bspline"):
        raise UsageError(f"filter `{filter}`: box or bspline expected")
    options = _options(order, crop, background, frame, skip_invalid, overlap)
    options.channels, options.samples = list(channels), samples
    options.bspline = filter == "bspline"
    drawn = _core.render(mesh._handle, view._scene(size), options, progress, cancel)
    for line in drawn.warnings:
        warnings.warn(line, PictureWarning, stacklevel=2)
    return Picture(drawn)


def explain_pixel(
    mesh: Mesh,
    view: View,
    x: int,
    y: int,
    *,
    size: tuple[int, int] | None = None,
    background: bool = True,
    frame: int = 0,
    order: Order | str | os.PathLike[str] | None = None,
    overlap: bool = False,
    skip_invalid: bool = False,
    progress: Progress = None,
    cancel: _core.Cancellation | None = None,
) -> dict[str, Any]:
    """How the pixel in column x from the left and row y from the top is computed: every ray segment
    front to back, under the names of `hiac-render --pixel X,Y --json`. Depths and lengths are in
    world units, tau is the extinction coefficient per world unit; "color" and "alpha" are the
    picture's, to the last bit."""
    options = _options(order, None, background, frame, skip_invalid, overlap)
    return _core.explain_pixel(mesh._handle, view._scene(size), x, y, options, progress, cancel)
