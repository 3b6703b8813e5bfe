"""Judgement of meshes."""
from __future__ import annotations

import json
import os
import tempfile
from dataclasses import dataclass
from typing import Any

from . import _core, _programs
from ._mesh import Mesh


@dataclass(frozen=True)
class Report:
    """What hiac-check finds in a mesh.

    valid: whether the mesh can be drawn as it is. facts: hiac-check's JSON: findings with their
    offenders, cells, proofs. text: its table, for people.
    """

    valid: bool
    facts: dict[str, Any]
    text: str

    @property
    def findings(self) -> list[dict[str, Any]]:
        """The findings, each with its defect, severity, number and first offenders."""
        return self.facts.get("findings", [])

    def __bool__(self) -> bool:
        return self.valid

    def __str__(self) -> str:
        return self.text


def check(
    mesh: Mesh,
    *,
    overlap: bool = False,
    cycles: bool = False,
    directions: int = 0,
    quality: bool = False,
    planarity: float | None = None,
    max_ids: int = 20,
    cancel: _core.Cancellation | None = None,
) -> Report:
    """Judges a mesh, as hiac-check does, in a process of its own.

    overlap: look for cells whose interiors overlap. cycles, directions: look for a proof that no
    view has a visibility cycle, and for cycles in so many parallel views. quality: shapes of cells.
    planarity: deviation, relative to a face's size, below which it counts as planar.
    """
    with tempfile.TemporaryDirectory() as folder:
        facts = os.path.join(folder, "facts.json")
        arguments = ["--json", facts, f"--max-ids={max_ids}"]
        for option, wanted in (("overlap", overlap), ("cycles", cycles), ("quality", quality)):
            if wanted:
                arguments.append(f"--{option}")
        if directions:
            arguments.append(f"--directions={directions}")
        if planarity is not None:
            arguments.append(f"--planarity={planarity!r}")
        with _programs.run("hiac-check", arguments, mesh._handle, cancel, accepted=(0, 1)) as done:
            with open(facts, encoding="utf-8") as file:
                return Report(done.code == 0, json.load(file), "\n".join(done.lines))
