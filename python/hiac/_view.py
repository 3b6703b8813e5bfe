"""Image specifications as mappings."""
from __future__ import annotations

import os
import tomllib
from collections.abc import Iterator, Mapping, MutableMapping, Sequence
from typing import Any

from . import _core, _toml
from ._mesh import Mesh
from .errors import InputError


class View(MutableMapping[str, Any]):
    """An image specification: all that decides a picture except the mesh.

    A mapping that mirrors the specification file (docs/image-specification.md): view["camera"]["fov"],
    view["camera.fov"] and view["isosurface.0.value"] are values that can be read and assigned.
    Every change is checked by the parser of the tools, and one that it refuses changes nothing:
    InputError names the key. Change what belongs together by update():

        view.update({"camera.projection": "orthographic", "camera.height": 2.0})

    Tables and lists of tables that are read are windows into the view; lists of numbers are tuples.
    """

    notes: Sequence[str] = ()
    """What its maker had to say: starter_view, paraview.view_from_state."""
    omitted: Sequence[str] = ()
    """What paraview.view_from_state found no equal for."""
    data_file: str = ""
    """The data that paraview.view_from_state found in the state."""

    def __init__(self, data: Mapping[str, Any] | None = None, *, folder: str = "") -> None:
        """data: as tomllib.load returns it; folder: where relative names of presets begin."""
        self._folder = folder
        self._set(_toml.plain(data or {}))

    @classmethod
    def loads(cls, text: str, folder: str = "", subject: str = "view") -> View:
        """A specification from TOML text. Raises InputError with the line."""
        view = cls.__new__(cls)
        view._folder = folder
        view._parsed = _core.parse_scene(text, subject, folder, [])
        view._data, view._text = tomllib.loads(text), text
        return view

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> View:
        """A specification from a file, or from a picture that holds its own (.png .exr .tiff)."""
        name = os.fspath(path)
        folder = os.path.dirname(name)
        if name.lower().endswith((".png", ".exr", ".tif", ".tiff")):
            texts = dict(_core.read_picture(name, 0)[2])
            if "hiac:specification" not in texts:
                raise InputError(f"{name}: is a picture that does not hold its specification")
            return cls.loads(texts["hiac:specification"], folder, name)
        try:
            with open(name, encoding="utf-8") as file:
                text = file.read()
        except (OSError, UnicodeDecodeError) as error:
            raise InputError(f"{name}: {getattr(error, 'strerror', None) or error}") from None
        return cls.loads(text, folder, name)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the specification: as it was read, comments included, if it was not changed."""
        _core.write_specification(os.fspath(path), self.toml)

    @property
    def toml(self) -> str:
        """The specification's text."""
        return self._text

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the picture, pixels."""
        return self._parsed.size

    @property
    def frames(self) -> int:
        """How many frames the camera's path has; 1 without one."""
        return self._parsed.frames

    def copy(self) -> View:
        """A view of its own."""
        return View.loads(self._text, self._folder)

    def update(self, *changes: Any, **more: Any) -> None:
        """Makes several changes at once, which together have to give a valid specification."""
        data = _toml.plain(self._data)
        for key, value in dict(*changes, **more).items():
            _toml.put(data, key.split("."), _toml.plain(value))
        self._set(data)

    def _set(self, data: dict[str, Any]) -> None:
        text = _toml.text(data)
        self._parsed = _core.parse_scene(text, "view", self._folder, [])
        self._data, self._text = data, text

    def _save_elsewhere(self, path: str) -> None:
        """Writes the specification for a program that reads it from another folder: names of preset
        files become absolute."""
        data = _toml.plain(self._data)
        for key in (["volume", "color"], ["skin", "color"]):
            try:
                table = _toml.get(data, key)
                file = os.path.join(os.path.abspath(self._folder), table["preset"])
            except (KeyError, TypeError):
                continue  # no colours by a field, or not by a preset
            if os.path.isfile(file):
                table["preset"] = file
        with open(path, "w", encoding="utf-8") as text:
            text.write(_toml.text(data))

    def _scene(self, size: tuple[int, int] | None) -> _core.ParsedScene:
        if size is None:
            return self._parsed
        width, height = size
        overrides = [f"image.width={int(width)}", f"image.height={int(height)}"]
        return _core.parse_scene(self._text, "view", self._folder, overrides)

    def __getitem__(self, key: str) -> Any:
        path = key.split(".")
        return _window(self, path, _toml.get(self._data, path))

    def __setitem__(self, key: str, value: Any) -> None:
        self.update({key: value})

    def __delitem__(self, key: str) -> None:
        data = _toml.plain(self._data)
        _toml.remove(data, key.split("."))
        self._set(data)

    def __iter__(self) -> Iterator[str]:
        return iter(self._data)

    def __len__(self) -> int:
        return len(self._data)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, View) and self._data == other._data

    def __repr__(self) -> str:
        return f"hiac.View({self._data!r})"

    def _repr_markdown_(self) -> str:
        return f"```toml\n{self._text}\n```"


class Table(MutableMapping[str, Any]):
    """A table of a view: assigning to it changes the view."""

    def __init__(self, view: View, path: list[str]) -> None:
        self._view, self._path = view, path

    def _data(self) -> dict[str, Any]:
        return _toml.get(self._view._data, self._path)

    def __getitem__(self, key: str) -> Any:
        return self._view[".".join([*self._path, key])]

    def __setitem__(self, key: str, value: Any) -> None:
        self._view[".".join([*self._path, key])] = value

    def __delitem__(self, key: str) -> None:
        del self._view[".".join([*self._path, key])]

    def __iter__(self) -> Iterator[str]:
        return iter(self._data())

    def __len__(self) -> int:
        return len(self._data())

    def __repr__(self) -> str:
        return repr(self._data())


class Tables(Sequence[Table]):
    """A list of tables of a view, such as its isosurfaces."""

    def __init__(self, view: View, path: list[str]) -> None:
        self._view, self._path = view, path

    def __getitem__(self, index):
        if isinstance(index, slice):
            return [self[k] for k in range(*index.indices(len(self)))]
        if not -len(self) <= index < len(self):
            raise IndexError(index)
        return Table(self._view, [*self._path, str(index % len(self))])

    def __len__(self) -> int:
        return len(_toml.get(self._view._data, self._path))

    def __repr__(self) -> str:
        return repr(_toml.get(self._view._data, self._path))


def _window(view: View, path: list[str], value: Any) -> Any:
    if isinstance(value, dict):
        return Table(view, path)
    if isinstance(value, list):
        return Tables(view, path) if value and isinstance(value[0], dict) else _toml.frozen(value)
    return value


def starter_view(
    mesh: Mesh,
    field: str = "",
    *,
    preset: str = "viridis",
    isosurfaces: int = 0,
    dark: bool = False,
    size: tuple[int, int] | None = None,
    progress: Any = None,
    cancel: _core.Cancellation | None = None,
) -> View:
    """A first view of a mesh, as `hiac-info --starter-view` writes it: the whole model in sight, a
    field over its range, extinction for a mean optical depth near 1.

    field: one of mesh.scalar_names, or a field of several components; "": the one that says most.
    preset: a colour map by name. isosurfaces: so many, evenly over the range. size: pixels.
    """
    text, notes = _core.starter_view(mesh._handle, field, preset, isosurfaces, dark,
                                     None if size is None else list(size), progress, cancel)
    view = View.loads(text)
    view.notes = notes
    return view
