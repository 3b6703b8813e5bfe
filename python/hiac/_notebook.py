"""In a notebook: a bar of progress, a panel with sliders, and a view under the mouse."""
from __future__ import annotations

import math
from typing import Any

from ._frames import Frames, orbited, rescaled, scalar_range
from ._mesh import Mesh
from ._picture import Picture
from ._view import View


class ProgressBar:
    """A bar of ipywidgets, shown by a notebook: pass it as progress= to the work."""

    def __init__(self) -> None:
        import ipywidgets

        self.widget = ipywidgets.FloatProgress(min=0.0, max=1.0, description="")

    def __call__(self, stage: str, done: int, total: int) -> None:
        self.widget.description = stage
        self.widget.value = done / total if total else 0.0

    def _ipython_display_(self) -> None:
        from IPython.display import display

        display(self.widget)


class Panel:
    """A picture with sliders (hiac.panel). `view` is the view that is shown; `widget` is the whole."""

    def __init__(self, mesh: Mesh, view: View, size: tuple[int, int]) -> None:
        import ipywidgets as w

        self._start, self.view, self._size = view.copy(), view.copy(), size
        self.picture: Picture | None = None
        self.image = w.Image(format="png", width=size[0], height=size[1])
        self.azimuth = w.FloatSlider(min=-180.0, max=180.0, value=0.0, description="azimuth")
        self.elevation = w.FloatSlider(min=-90.0, max=90.0, value=0.0, description="elevation")
        self.density = w.FloatSlider(min=-2.0, max=2.0, value=0.0, step=0.05,
                                     description="density 10^")
        self.range: Any = None
        limits = scalar_range(view)
        if limits is not None:
            margin = limits[1] - limits[0]
            self.range = w.FloatRangeSlider(min=limits[0] - margin, max=limits[1] + margin,
                                            value=limits, step=margin / 100, description="range")
        self.message = w.Label()
        sliders = [s for s in (self.azimuth, self.elevation, self.density, self.range) if s]
        for slider in sliders:
            slider.observe(self._change, names="value")
        self.widget = w.HBox([self.image, w.VBox([*sliders, self.message])])
        self.frames = Frames(mesh, self._show, self._fail)
        self._change()

    def close(self) -> None:
        """Stops drawing."""
        self.frames.close()

    def _change(self, _: Any = None) -> None:
        view = self._start.copy()
        changes = orbited(view, self.azimuth.value, self.elevation.value)
        low, high = self.range.value if self.range is not None else (0.0, 1.0)
        if low < high:
            changes.update(rescaled(view, low, high, 10.0**self.density.value))
        view.update(changes)
        self.view = view
        self.frames.draw(view, self._size)

    def _show(self, picture: Picture) -> None:
        self.picture = picture
        self.image.value = picture._repr_png_()
        self.message.value = ""

    def _fail(self, error: Exception) -> None:
        self.message.value = str(error)

    def _ipython_display_(self) -> None:
        from IPython.display import display

        display(self.widget)


def panel(mesh: Mesh, view: View, *, size: tuple[int, int] = (512, 384)) -> Panel:
    """A picture with sliders, for a notebook with ipywidgets: azimuth and elevation of the camera
    (degrees), density (a power of ten times the extinction), and the range of the field. Frames
    are exact; coarse ones come first. `panel(...).view` is the view as it is shown."""
    return Panel(mesh, view, size)


def rfb_view(mesh: Mesh, view: View) -> Any:
    """A widget of jupyter_rfb (which must be installed) that shows the same frames: dragging turns
    the camera, the wheel moves it towards its look_at. Its `hiac_view` is the view as shown."""
    import jupyter_rfb
    import numpy as np

    class HiacView(jupyter_rfb.RemoteFrameBuffer):
        """A mesh under the mouse."""

        def __init__(self) -> None:
            super().__init__()
            self.hiac_view = view.copy()
            self._frame = np.zeros((1, 1, 3), np.uint8)
            self._held: tuple[float, float] | None = None
            self._pixels = (512, 384)
            self.frames = Frames(mesh, self._show, self._fail)
            self._draw()

        def _draw(self) -> None:
            self.frames.draw(self.hiac_view.copy(), self._pixels)

        def _show(self, picture: Picture) -> None:
            self._frame = picture.display_bytes()
            self.request_draw()

        def _fail(self, error: Exception) -> None:
            raise error

        def get_frame(self) -> np.ndarray:
            return self._frame

        def handle_event(self, event: dict[str, Any]) -> None:
            kind = event["event_type"]
            if kind == "resize":
                ratio = event.get("pixel_ratio", 1.0)
                self._pixels = tuple(max(1, int(event[k] * ratio)) for k in ("width", "height"))
            elif kind == "pointer_down":
                self._held = (event["x"], event["y"])
                return
            elif kind == "pointer_up":
                self._held = None
                return
            elif kind == "pointer_move" and self._held is not None:
                right, down = event["x"] - self._held[0], event["y"] - self._held[1]
                self._held = (event["x"], event["y"])
                self.hiac_view.update(orbited(self.hiac_view, -0.5 * right, 0.5 * down))
            elif kind == "wheel":
                self._move(math.exp(event["dy"] / 1000.0))
            elif kind == "close":
                self.frames.close()
                return
            else:
                return
            self._draw()

        def _move(self, share: float) -> None:
            camera = self.hiac_view["camera"]
            if camera.get("projection") == "orthographic":
                camera["height"] = camera["height"] * share
                return
            eye, center = np.array(camera["eye"]), np.array(camera["look_at"])
            camera["eye"] = center + (eye - center) * share

    return HiacView()
