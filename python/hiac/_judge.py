"""How wrong a picture of another renderer is."""
from __future__ import annotations

import json
import os
import tempfile
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from . import _core, _programs
from ._compare import AnyPicture
from ._mesh import Mesh
from ._picture import Picture
from ._view import View


@dataclass(frozen=True)
class Judgement:
    """How far a picture is from the truth, as `hiac-compare --truth` states it.

    facts: its JSON: channels with rmse, largest_error ..., psnr, ssim, flip, truth_error (a bound
        of the truth's own error) and what is wrong with the picture as a whole.
    text: the same for people.
    heat_map: linear R G B, shape (height, width, 3): where the picture is wrong, from dark blue (0)
        to yellow (facts["heat_map"]["largest"], the largest difference of all channels).
    """

    facts: dict[str, Any]
    text: str
    heat_map: npt.NDArray[np.float64]

    @property
    def channels(self) -> dict[str, dict[str, Any]]:
        """The measures by channel."""
        return {channel["name"]: channel for channel in self.facts["channels"]}

    def __str__(self) -> str:
        return self.text


def judge(
    picture: AnyPicture,
    mesh: Mesh,
    view: View,
    *,
    background: bool = True,
    skip_invalid: bool = False,
    frame: int | None = None,
    cancel: _core.Cancellation | None = None,
) -> Judgement:
    """Judges a picture that another renderer made of a mesh and a view: renders the truth in its
    size and compares, also with the picture turned, shifted, scaled, in another encoding or in another projection.

    picture: a file, a Picture, or an array of linear R G B (A), shape (height, width, 3 or 4).
    background: whether the picture has the view's background behind the volume.
    """
    with tempfile.TemporaryDirectory() as folder:
        specification, facts, heat_map = (
            os.path.join(folder, name) for name in ("view.toml", "facts.json", "heat.npy"))
        view._save_elsewhere(specification)
        if not isinstance(picture, (str, os.PathLike)):
            path = os.path.join(folder, "picture.npy")
            np.save(path, picture.rgba if isinstance(picture, Picture)
                    else np.asarray(picture, np.float64))
            picture = path
        arguments = [os.fspath(picture), "--truth", "-", "--view", specification, "--json", facts,
                     "--heatmap", heat_map]
        if not background:
            arguments.append("--no-background")
        if skip_invalid:
            arguments.append("--skip-invalid")
        if frame is not None:
            arguments.append(f"--frame={frame}")
        with _programs.run("hiac-compare", arguments, mesh._handle, cancel) as done:
            with open(facts, encoding="utf-8") as file:
                return Judgement(json.load(file), done.text(), np.load(heat_map))
