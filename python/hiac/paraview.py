"""Views of ParaView, read from the files that it saves; needs no ParaView."""
from __future__ import annotations

import os

from . import _core
from ._view import View


def view_from_state(path: str | os.PathLike[str]) -> View:
    """The view in a state (.pvsm) or a camera file (.pvcc) of ParaView, as `hiac-render --view`
    reads it; PATH#VIEW names one of several render views. Of a camera file the view has the camera
    and a size alone.

    Its `notes` tell how it was read: the law of the extinction, the error of the colours. Its
    `omitted` is what ParaView shows and the specification has no equal for, a line each, and its
    `data_file` the file of the data that is shown, "" if there is none. Raises InputError for what
    has no equal at all.
    """
    name = os.fspath(path)
    found = _core.view_from_state(name)
    view = View.loads(found["text"], "", name)
    view.notes, view.omitted, view.data_file = found["notes"], found["omitted"], found["data_file"]
    return view
