"""How far a picture is from another one."""
from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, Union

import numpy as np
import numpy.typing as npt

from . import _core
from ._picture import Picture
from .errors import UsageError

AnyPicture = Union[Picture, npt.ArrayLike, str, "os.PathLike[str]"]


@dataclass(frozen=True)
class Comparison:
    """Measures of the difference from a reference, as hiac-compare states them.

    channels: by name: rmse, relative_mse, mean_error, largest_error, largest_at (x, y), infinite
        (how many values differ infinitely).
    psnr: dB, over the linear colours; ssim: structural similarity; None where not defined.
    flip: FLIP a pixel, 0 to 1, shape (height, width), or None.
    differences: largest difference of all channels a pixel, shape (height, width).
    """

    channels: dict[str, dict[str, Any]]
    psnr: float | None
    ssim: float | None
    flip: npt.NDArray[np.float64] | None
    differences: npt.NDArray[np.float64]

    @property
    def equal(self) -> bool:
        """Whether the channels in common are the same."""
        return all(d["largest_error"] == 0 for d in self.channels.values())

    @property
    def largest_error(self) -> float:
        """Over all channels."""
        return max(d["largest_error"] for d in self.channels.values())


def _named(picture: AnyPicture, width: int) -> tuple[npt.NDArray[np.float64], list[str]]:
    if isinstance(picture, Picture):
        return picture.values, picture.channels
    if isinstance(picture, (str, os.PathLike)):
        values, channels, _ = _core.read_picture(os.fspath(picture), width)
        return values, channels
    values = np.asarray(picture, dtype=np.float64)
    if values.ndim == 2:
        values = values[:, :, np.newaxis]
    names = {1: ["Y"], 3: ["R", "G", "B"], 4: ["R", "G", "B", "A"]}
    if values.ndim != 3 or values.shape[2] not in names:
        raise UsageError("picture: shape (height, width), or (height, width, 1, 3 or 4) expected "
                         f"({values.shape} found)")
    return values, names[values.shape[2]]


def compare(picture: AnyPicture, reference: AnyPicture, *, width: int = 0) -> Comparison:
    """Compares a picture with a reference: each a Picture, an array of linear colours (Y, R G B or
    R G B A), or a file. width: pixels in a row of `.f32` files.

    Raises JudgementError for pictures of different sizes or without a channel in common.
    """
    found = _core.compare(*_named(picture, width), *_named(reference, width))
    flip = found["flip"]
    return Comparison({d.pop("channel"): d for d in found["channels"]}, found["psnr"],
                      found["ssim"], None if flip is None else flip[:, :, 0],
                      found["differences"][:, :, 0])
