"""Long work: progress, cancellation, Ctrl-C, and threads that draw, read and fail at once."""
import os
import signal
import tempfile
import threading
import time
import unittest

import hiac
from cells import grid, mesh_of, view_of


def long_work():
    """A mesh, and a view that takes seconds to draw with 4 x 4 rays a pixel."""
    points, cells, values = grid(14, 0.1)
    mesh = hiac.Mesh(points, {"tetrahedron4": cells}, {"s": values})
    return mesh, view_of(mesh, size=(1600, 1200))


class Work(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.mesh, cls.view = long_work()

    def stopped_in(self, stop, expected):
        """Seconds from `stop`, on another thread, to the exception."""
        asked = []

        def ask():
            time.sleep(0.3)
            asked.append(time.perf_counter())
            stop()

        thread = threading.Thread(target=ask)
        thread.start()
        with self.assertRaises(expected):
            hiac.render(self.mesh, self.view, samples=4,
                        cancel=getattr(self, "cancel", None))
        ended = time.perf_counter()
        thread.join()
        return ended - asked[0]

    def test_interrupt(self):
        times = [self.stopped_in(lambda: os.kill(os.getpid(), signal.SIGINT), KeyboardInterrupt)
                 for _ in range(3)]
        self.assertLess(min(times), 0.05)

    def test_cancellation(self):
        self.cancel = hiac.Cancellation()
        times = []
        for _ in range(3):
            self.cancel.reset()
            times.append(self.stopped_in(self.cancel.request, hiac.Cancelled))
        self.assertLess(min(times), 0.05)
        with self.assertRaises(hiac.Cancelled):  # requested before
            hiac.render(self.mesh, self.view, cancel=self.cancel)
        del self.cancel

    def test_progress(self):
        told = []
        hiac.render(self.mesh, self.view, size=(1200, 900), samples=2,
                    progress=lambda *state: told.append(state))
        self.assertIn("rows of samples", [stage for stage, _, _ in told])
        self.assertTrue(all(done <= total or total == 0 for _, done, total in told))

        def fail(*_):
            raise ZeroDivisionError("of the caller's")

        with self.assertRaises(ZeroDivisionError):
            hiac.render(self.mesh, self.view, samples=4, progress=fail)

    def test_other_threads_run_meanwhile(self):
        counted = 0
        cancel = hiac.Cancellation()

        def draw():
            try:
                hiac.render(self.mesh, self.view, samples=4, cancel=cancel)
            except hiac.Cancelled:
                pass

        thread = threading.Thread(target=draw)
        thread.start()
        end = time.perf_counter() + 0.3
        while time.perf_counter() < end:
            counted += 1
        cancel.request()
        thread.join()
        self.assertGreater(counted, 10_000)

    def test_a_reader_can_be_stopped(self):
        with tempfile.TemporaryDirectory() as folder:
            pipe = os.path.join(folder, "never.vtu")
            os.mkfifo(pipe)  # nobody writes to it
            cancel = hiac.Cancellation()
            threading.Timer(0.2, cancel.request).start()
            start = time.perf_counter()
            with self.assertRaises(hiac.Cancelled):
                hiac.read(pipe, cancel=cancel)
            self.assertLess(time.perf_counter() - start, 1.0)

    def test_threads(self):
        threads, renders = (int(n) for n in os.environ.get("HIAC_THREADS", "8x6").split("x"))
        failures = storm(threads, renders)
        self.assertEqual(failures, [])


def storm(threads, renders):
    """Threads that draw, fail, are cancelled and read at once; what went wrong."""
    points, cells, values = grid(3, 0.1)
    shared = hiac.Mesh(points, {"tetrahedron4": cells}, {"s": values})
    view = view_of(shared, size=(16, 12))
    curved = mesh_of("brick20")
    curved_view = view_of(curved, size=(16, 12))
    expected = {id(m): hiac.render(m, v).values.tobytes()
                for m, v in ((shared, view), (curved, curved_view))}
    failures = []
    with tempfile.TemporaryDirectory() as folder:
        vtu = os.path.join(folder, "m.vtu")
        hiac.write(shared, vtu)
        content = hiac.read(vtu).content_hash()

        def one(k):
            mesh, spec = ((shared, view), (curved, curved_view))[k % 2]
            if k % 5 == 1:
                try:
                    hiac.render(mesh, spec, channels=["no such channel"])
                    failures.append("no exception")
                except hiac.UsageError:
                    pass
            if k % 5 == 2:
                cancel = hiac.Cancellation()
                timer = threading.Timer(0.001 * (k % 7), cancel.request)
                timer.start()
                try:
                    hiac.render(mesh, spec, samples=3, cancel=cancel)
                except hiac.Cancelled:
                    pass
                timer.join()
            if k % 25 == 3 and hiac.read(vtu).content_hash() != content:
                failures.append("another mesh")
            if hiac.render(mesh, spec).values.tobytes() != expected[id(mesh)]:
                failures.append("other bits")

        def work(start):
            try:
                for k in range(renders):
                    one(start + k)
            except BaseException as error:  # noqa: B902: whatever it is, it is a failure
                failures.append(repr(error))

        workers = [threading.Thread(target=work, args=(k,)) for k in range(threads)]
        for worker in workers:
            worker.start()
        for worker in workers:
            worker.join()
    return failures


if __name__ == "__main__":
    unittest.main()
