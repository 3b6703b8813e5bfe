"""The panel and the view under the mouse, without a notebook: widgets are driven by their values."""
import sys
import types
import unittest

import numpy as np

import hiac
from cells import mesh_of, view_of
from hiac._frames import orbited, rescaled, scalar_range

try:
    import ipywidgets
except ImportError:
    ipywidgets = None

MOST_SECONDS = 60


class Changes(unittest.TestCase):
    def setUp(self):
        self.view = view_of(mesh_of("brick8"))

    def arm(self, view):
        return np.array(view["camera.eye"]) - np.array(view["camera.look_at"])

    def test_a_turn_keeps_the_distance_and_comes_back(self):
        start = self.arm(self.view)
        for _ in range(4):
            self.view.update(orbited(self.view, 90, 0))
            self.assertAlmostEqual(np.linalg.norm(self.arm(self.view)), np.linalg.norm(start), 12)
        np.testing.assert_allclose(self.arm(self.view), start, atol=1e-12)

    def test_a_quarter_turn(self):
        x, y, z = self.arm(self.view)
        self.view.update(orbited(self.view, 90, 0))
        np.testing.assert_allclose(self.arm(self.view), [-y, x, z], atol=1e-12)

    def test_elevation_ends_before_the_poles(self):
        start = self.arm(self.view)
        height = np.degrees(np.arcsin(start[2] / np.linalg.norm(start)))
        self.view.update(orbited(self.view, 0, 10))
        arm = self.arm(self.view)
        self.assertAlmostEqual(np.degrees(np.arcsin(arm[2] / np.linalg.norm(arm))), height + 10)
        self.view.update(orbited(self.view, 0, 500))
        arm = self.arm(self.view)
        self.assertAlmostEqual(np.degrees(np.arcsin(arm[2] / np.linalg.norm(arm))), 89)

    def test_range_and_density(self):
        low, high = scalar_range(self.view)
        points = np.array(self.view["volume.extinction.points"])
        self.view.update(rescaled(self.view, low + 1, high + 3, 10.0))
        self.assertEqual(scalar_range(self.view), (low + 1, high + 3))
        moved = np.array(self.view["volume.extinction.points"])
        np.testing.assert_allclose(moved[:, 1], 10 * points[:, 1])
        stretch = (high - low + 2) / (high - low)
        np.testing.assert_allclose(moved[:, 0], low + 1 + (points[:, 0] - low) * stretch)


@unittest.skipIf(ipywidgets is None, "ipywidgets is not installed")
class Panels(unittest.TestCase):
    def setUp(self):
        self.mesh = mesh_of("brick20")
        self.view = view_of(self.mesh)
        self.panel = hiac.panel(self.mesh, self.view, size=(64, 48))
        self.addCleanup(self.panel.close)

    def shown(self):
        self.assertTrue(self.panel.frames.wait(MOST_SECONDS))
        return self.panel.picture.values

    def test_last_frame_is_the_picture_of_the_view(self):
        expected = hiac.render(self.mesh, self.view, size=(64, 48)).values
        np.testing.assert_allclose(self.shown(), expected, atol=1e-12)  # the eye is computed
        self.assertEqual(self.panel.image.value[:8], b"\x89PNG\r\n\x1a\n")

    def test_sliders_change_view_and_picture(self):
        before = self.shown()
        for slider, value in ((self.panel.azimuth, 40.0), (self.panel.density, 0.5),
                              (self.panel.range, (0.2, 0.6))):
            slider.value = value
            after = self.shown()
            self.assertGreater(np.abs(after - before).max(), 0.01)
            view = self.panel.view
            self.assertEqual(after.tobytes(),
                             hiac.render(self.mesh, view, size=(64, 48)).values.tobytes())
            before = after

    def test_what_cannot_be_drawn_is_said(self):
        wrong = self.view.copy()
        wrong["volume.color.field"] = "no such field"
        panel = hiac.panel(self.mesh, wrong, size=(16, 12))
        self.addCleanup(panel.close)
        self.assertTrue(panel.frames.wait(MOST_SECONDS))
        self.assertIn("no such field", panel.message.value)

    def test_progress_bar(self):
        bar = hiac.ProgressBar()
        hiac.render(self.mesh, self.view, samples=4, progress=bar)
        bar("render", 3, 4)
        self.assertEqual(bar.widget.value, 0.75)


class StandIn:
    """What jupyter_rfb documents of RemoteFrameBuffer: get_frame, handle_event, request_draw."""

    def __init__(self):
        self.requests = 0

    def request_draw(self):
        self.requests += 1


class UnderTheMouse(unittest.TestCase):
    def setUp(self):
        module = types.ModuleType("jupyter_rfb")
        module.RemoteFrameBuffer = StandIn
        sys.modules["jupyter_rfb"] = module
        self.addCleanup(sys.modules.pop, "jupyter_rfb")
        self.mesh = mesh_of("brick8")
        self.widget = hiac.rfb_view(self.mesh, view_of(self.mesh))
        self.addCleanup(self.widget.frames.close)

    def send(self, kind, **event):
        self.widget.handle_event({"event_type": kind, **event})

    def frame(self):
        self.assertTrue(self.widget.frames.wait(MOST_SECONDS))
        return self.widget.get_frame()

    def test_frames_are_the_pictures(self):
        self.send("resize", width=40, height=30, pixel_ratio=1.5)
        frame = self.frame()
        expected = hiac.render(self.mesh, self.widget.hiac_view, size=(60, 45)).display_bytes()
        np.testing.assert_array_equal(frame, expected)
        self.assertGreaterEqual(self.widget.requests, 3)  # coarse ones came first

    def test_mouse(self):
        self.send("resize", width=40, height=30, pixel_ratio=1.0)
        still, eye = self.frame(), self.widget.hiac_view["camera.eye"]
        self.send("pointer_move", x=30, y=3)  # no button is held
        self.assertEqual(self.widget.hiac_view["camera.eye"], eye)
        self.send("pointer_down", x=10, y=10)
        self.send("pointer_move", x=70, y=20)
        self.send("pointer_up", x=70, y=20)
        self.assertGreater(np.abs(self.frame().astype(int) - still).max(), 5)
        view = self.widget.hiac_view
        before = np.linalg.norm(np.subtract(view["camera.eye"], view["camera.look_at"]))
        self.send("wheel", dx=0, dy=-300)
        after = np.linalg.norm(np.subtract(view["camera.eye"], view["camera.look_at"]))
        self.assertAlmostEqual(after / before, np.exp(-0.3))


if __name__ == "__main__":
    unittest.main()
