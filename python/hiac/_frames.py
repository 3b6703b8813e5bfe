"""Progressive exact frames on a thread, and views that change under sliders and mouse."""
from __future__ import annotations

import math
import threading
from collections.abc import Callable
from typing import Any

import numpy as np

from . import _core
from ._mesh import Mesh
from ._picture import Picture, render
from ._view import View
from .errors import Cancelled, Error

_SHARES = (0.25, 0.5, 1.0)  # of the picture's sides, one frame after the other


class Frames:
    """Draws the view asked for last, coarse frames first; every frame is exact for its size.

    show(picture) is called on the drawing thread for every frame, fail(error) where one cannot be
    drawn. Asking for another view stops the one that is being drawn.
    """

    def __init__(self, mesh: Mesh, show: Callable[[Picture], Any],
                 fail: Callable[[Error], Any]) -> None:
        self._mesh, self._show, self._fail = mesh, show, fail
        self._changed = threading.Condition()
        self._wanted: tuple[View, tuple[int, int]] | None = None
        self._cancel = _core.Cancellation()
        self._busy = self._closed = False
        self._thread = threading.Thread(target=self._run, name="hiac frames", daemon=True)
        self._thread.start()

    def draw(self, view: View, size: tuple[int, int]) -> None:
        """Asks for a view in this size, pixels."""
        with self._changed:
            self._wanted = (view, size)
            self._cancel.request()
            self._changed.notify_all()

    def wait(self, timeout: float | None = None) -> bool:
        """Waits until the last frame asked for has been shown; whether that happened in time."""
        with self._changed:
            return self._changed.wait_for(lambda: not self._busy and self._wanted is None, timeout)

    def close(self) -> None:
        """Stops drawing, for ever."""
        with self._changed:
            self._closed, self._wanted = True, None
            self._cancel.request()
            self._changed.notify_all()
        if threading.current_thread() is not self._thread:
            self._thread.join()

    def _run(self) -> None:
        while True:
            with self._changed:
                self._busy = False
                self._changed.notify_all()
                self._changed.wait_for(lambda: self._closed or self._wanted is not None)
                if self._closed:
                    return
                view, size = self._wanted
                self._wanted, self._busy, self._cancel = None, True, _core.Cancellation()
                cancel = self._cancel
            try:
                self._draw_progressively(view, size, cancel)
            except Cancelled:
                continue
            except Error as error:
                self._fail(error)

    def _draw_progressively(self, view: View, size: tuple[int, int],
                            cancel: _core.Cancellation) -> None:
        for share in _SHARES:
            part = tuple(max(1, round(share * side)) for side in size)
            picture = render(self._mesh, view, size=part, cancel=cancel)
            if cancel.requested:
                return
            self._show(picture)


def orbited(view: View, azimuth: float, elevation: float) -> dict[str, Any]:
    """The change of a view that turns its camera around look_at: by `azimuth` degrees about `up`,
    to the right, then by `elevation` degrees upwards, at most to the poles."""
    camera = view["camera"]
    center = np.array(camera["look_at"], float)
    arm = np.array(camera["eye"], float) - center
    up = np.array(camera["up"], float)
    up /= np.linalg.norm(up)
    arm = _turned(arm, up, math.radians(azimuth))
    side = np.cross(up, arm)
    height = math.degrees(math.asin(np.clip(arm @ up / np.linalg.norm(arm), -1, 1)))
    limit = 89.0
    turn = min(max(height + elevation, -limit), limit) - height
    arm = _turned(arm, side / np.linalg.norm(side), -math.radians(turn))
    return {"camera.eye": (center + arm).tolist()}


def _turned(vector: np.ndarray, axis: np.ndarray, angle: float) -> np.ndarray:
    """Rodrigues' formula."""
    return (vector * math.cos(angle) + np.cross(axis, vector) * math.sin(angle)
            + axis * (axis @ vector) * (1 - math.cos(angle)))


def scalar_range(view: View) -> tuple[float, float] | None:
    """The scalars between which the colours of a view's volume change; None if the mesh decides."""
    color = view.get("volume.color")
    if color is None:
        return None
    if "points" in color and isinstance(color.get("range", ()), tuple) and not color.get("range"):
        scalars = [point[0] for point in color["points"]]
        return (scalars[0], scalars[-1]) if scalars[0] < scalars[-1] else None
    limits = color.get("range")
    return (float(limits[0]), float(limits[1])) if isinstance(limits, tuple) else None


def rescaled(view: View, low: float, high: float, density: float) -> dict[str, Any]:
    """The change of a view that moves the scalars of its colours and extinction from their range to
    [low, high], and multiplies the extinction by `density`."""
    changes: dict[str, Any] = {}
    old = scalar_range(view)
    for name, thicker in (("volume.color", 1.0), ("volume.extinction", density)):
        table = view.get(name)
        if table is None:
            continue
        limits = table.get("range")
        if limits is not None and old is not None and isinstance(limits, tuple):
            changes[f"{name}.range"] = [low, high]
        if "points" in table:
            points = [list(point) for point in table["points"]]
            if limits is None and old is not None:
                stretch = (high - low) / (old[1] - old[0])
                for point in points:
                    point[0] = low + (point[0] - old[0]) * stretch
            if name == "volume.extinction":
                for point in points:
                    point[1] *= thicker
            changes[f"{name}.points"] = points
    return changes
