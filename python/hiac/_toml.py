"""Nested dicts and lists, by paths of keys, and as TOML text that is exact to the last bit."""
from __future__ import annotations

import json
import math
import re
from collections.abc import Mapping
from typing import Any

import numpy as np

from .errors import UsageError

_BARE = re.compile(r"[A-Za-z0-9_-]+")


def plain(value: Any) -> Any:
    """A deep copy in dict, list and numbers of Python: numpy's numbers and arrays become such."""
    if isinstance(value, Mapping):
        return {str(key): plain(inner) for key, inner in value.items()}
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, np.generic):
        return value.item()
    if isinstance(value, (str, bool, int, float)):
        return value
    try:
        return [plain(inner) for inner in value]
    except TypeError:
        raise UsageError(f"view: {type(value).__name__} is no value of a specification") from None


def frozen(value: Any) -> Any:
    """Lists as tuples, so that nobody changes a copy and believes to have changed the view."""
    return tuple(frozen(inner) for inner in value) if isinstance(value, list) else value


def _step(data: Any, key: str, path: list[str]) -> Any:
    try:
        return data[int(key)] if isinstance(data, list) else data[key]
    except (KeyError, IndexError, ValueError, TypeError):
        raise KeyError(".".join(path)) from None


def get(data: Any, path: list[str]) -> Any:
    """The value at a path. Raises KeyError."""
    for key in path:
        data = _step(data, key, path)
    return data


def put(data: Any, path: list[str], value: Any) -> None:
    """Sets the value at a path; tables on the way are made, and the element after the last of a
    list."""
    for key in path[:-1]:
        if isinstance(data, dict) and key not in data:
            data[key] = {}
        data = _step(data, key, path)
    if isinstance(data, list) and path[-1] == str(len(data)):
        data.append(value)
    elif isinstance(data, list):
        _step(data, path[-1], path)
        data[int(path[-1])] = value
    elif isinstance(data, dict):
        data[path[-1]] = value
    else:
        raise KeyError(".".join(path))


def remove(data: Any, path: list[str]) -> None:
    """Removes the value at a path. Raises KeyError."""
    table = get(data, path[:-1])
    _step(table, path[-1], path)
    del table[int(path[-1]) if isinstance(table, list) else path[-1]]


def _number(value: float) -> str:
    if math.isnan(value):
        return "nan"
    if math.isinf(value):
        return "inf" if value > 0 else "-inf"
    digits = repr(value)
    return digits if any(c in digits for c in ".en") else digits + ".0"


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return _number(value)
    if isinstance(value, int):
        return str(value)
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, list):
        return "[" + ", ".join(map(_value, value)) + "]"
    return "{" + ", ".join(f"{_key(k)} = {_value(v)}" for k, v in value.items()) + "}"


def _key(key: str) -> str:
    return key if _BARE.fullmatch(key) else json.dumps(key, ensure_ascii=False)


def _is_tables(value: Any) -> bool:
    return isinstance(value, list) and bool(value) and all(isinstance(v, dict) for v in value)


def _lines(table: dict[str, Any], path: list[str]) -> list[str]:
    inner = {k: v for k, v in table.items() if isinstance(v, dict) or _is_tables(v)}
    lines = [f"{_key(k)} = {_value(v)}" for k, v in table.items() if k not in inner]
    for key, value in inner.items():
        name = ".".join(map(_key, [*path, key]))
        for one in [value] if isinstance(value, dict) else value:
            lines += ["", f"[{name}]" if isinstance(value, dict) else f"[[{name}]]"]
            lines += _lines(one, [*path, key])
    return lines


def text(data: dict[str, Any]) -> str:
    """TOML text that tomllib.loads turns into the same data."""
    return "\n".join(_lines(data, [])).strip("\n") + "\n"
