"""Files of every format that hiac-convert knows, read and written."""
from __future__ import annotations

import os
from collections.abc import Mapping, Sequence

from . import _core, _programs
from ._mesh import Mesh


def read(
    path: str | os.PathLike[str],
    *,
    format: str | None = None,
    fields: Sequence[str] | Mapping[str, str] = (),
    derive: Sequence[str] = (),
    time: float | str | None = None,
    step: int | None = None,
    block: str | None = None,
    warp: str | None = None,
    threshold: str | None = None,
    invalid: str | None = None,
    corners_only: bool = False,
    skip_unsupported: bool = False,
    approximate: bool = False,
    allow_external: bool = False,
    cancel: _core.Cancellation | None = None,
) -> Mesh:
    """Reads the mesh in a file, as hiac-convert does, whose options these are.

    format: the format's name (hiac-convert --list-formats); None: found by content and extension.
    fields: names of the fields to keep, or a mapping from them to new names; default: all.
    derive: further fields by formula, "speed = magnitude(velocity)".
    time, step: which time step: its time ("nearest:2.5": the nearest one), or its number from 0.
    invalid: what becomes of cells that are partly turned inside out: "refuse", "skip" or "cut".

    What hiac-convert has to say is in Mesh.notes. The file is read in a process of its own: reading
    is safe in a program with threads, and Ctrl-C or `cancel` ends it at once. Memory: the mesh's
    arrays, once. Raises InputError for a file that cannot be read, UsageError for options that do
    not fit it.
    """
    names = [f"{old}={new}" for old, new in fields.items()] if isinstance(fields, Mapping) else fields
    arguments = [os.fspath(path)]
    for option, value in (("format", format), ("time", time), ("step", step), ("block", block),
                          ("warp", warp), ("threshold", threshold), ("invalid", invalid)):
        if value is not None:
            arguments.append(f"--{option}={value}")
    arguments += [f"--field={name}" for name in names]
    arguments += [f"--derive={formula}" for formula in derive]
    for option, wanted in (("corners-only", corners_only), ("skip-unsupported", skip_unsupported),
                           ("approximate", approximate), ("allow-external", allow_external)):
        if wanted:
            arguments.append(f"--{option}")
    if len(arguments) == 1 and arguments[0].endswith(".zoo"):
        return Mesh._of(_core.read_zoo(arguments[0]))
    with _programs.run("hiac-convert", arguments, cancel=cancel) as done:
        return Mesh._of(done.mesh(), done.lines)


def write(mesh: Mesh, path: str | os.PathLike[str]) -> list[str]:
    """Writes a mesh in the format of the name's extension: .zoo, .vtu, .vtkhdf, .msh; .stl, .ply
    and .vtp hold its boundary. Returns notes on what the format cannot hold."""
    name = os.fspath(path)
    if name.endswith(".zoo"):
        _core.write_zoo(mesh._handle, name)
        return []
    with _programs.run("hiac-convert", ["-", "-o", name], mesh=mesh._handle) as done:
        return done.lines
