"""Meshes of finite elements, from and to numpy arrays without copies."""
from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Union

import numpy as np
import numpy.typing as npt

from . import _core
from .errors import UsageError

KINDS: tuple[str, ...] = _core.kind_names
"""The kinds of cells: "tetrahedron4", "tetrahedron10" ... "brick32"."""

NODES_OF_KIND: dict[str, int] = dict(zip(_core.kind_names, _core.kind_nodes))
"""How many nodes a cell of a kind has."""

Cells = Union[Mapping[str, npt.ArrayLike], Sequence[tuple[str, npt.ArrayLike]]]


@dataclass(frozen=True)
class Field:
    """Values over a mesh.

    values: float64, shape (tuples,) for a scalar, (tuples, components) otherwise: a tuple a node,
        a cell, or an entry of the cells' node lists (a corner).
    location: "node", "cell" or "corner"; None: by the number of tuples, where that is unique.
    unit: free text, empty if unknown.
    """

    values: npt.NDArray[np.float64]
    location: str | None = None
    unit: str = ""


class Fields(Mapping[str, Field]):
    """The fields of a mesh by name; where several share a name, NAME@node, NAME@cell, NAME@corner."""

    def __init__(self, handle: _core.Mesh) -> None:
        self._fields = {
            handle.distinct_name(k): Field(field.values, field.location, field.unit)
            for k, field in enumerate(handle.fields)
        }

    def __getitem__(self, name: str) -> Field:
        return self._fields[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self._fields)

    def __len__(self) -> int:
        return len(self._fields)

    def __repr__(self) -> str:
        lines = (f"{name}: {f.location}, {f.values.shape}" for name, f in self.items())
        return "{" + "; ".join(lines) + "}"


class Mesh:
    """A mesh of cells of the fifteen kinds (KINDS), which does not change.

    points: float64, shape (n, 3): x y z of every node, world units.
    cells: kind and node numbers, by kind or as a list of blocks, in the mesh's order: numbers from
        0, shape (cells, nodes of the kind), in the order that docs/python.md states (VTK's).
    fields: by name: a Field, or an array whose length says where its values belong.
    metadata: free text by key.

    C-contiguous arrays of float64, and one block of cells in uint32, are used as they are, without
    a copy: they must not be written to while the mesh lives. Raises InputError for node numbers
    that do not exist, coordinates that are not finite, and sizes that do not fit.
    """

    def __init__(
        self,
        points: npt.ArrayLike,
        cells: Cells,
        fields: Mapping[str, Field | npt.ArrayLike] | None = None,
        metadata: Mapping[str, str] | None = None,
    ) -> None:
        positions = _as_points(points)
        kinds, offsets, nodes = _packed(cells)
        counts = {"node": len(positions), "cell": len(kinds), "corner": len(nodes)}
        packed = [_packed_field(n, f, counts) for n, f in (fields or {}).items()]
        self._handle = _core.Mesh(
            positions, kinds, offsets, nodes, packed, list((metadata or {}).items())
        )
        self.notes: list[str] = []

    @classmethod
    def _of(cls, handle: _core.Mesh, notes: Sequence[str] = ()) -> Mesh:
        mesh = cls.__new__(cls)
        mesh._handle = handle
        mesh.notes = list(notes)
        return mesh

    @property
    def points(self) -> npt.NDArray[np.float64]:
        """Positions of the nodes, shape (n, 3), world units; read-only, no copy."""
        return self._handle.points

    @property
    def cells(self) -> list[tuple[str, npt.NDArray[np.uint32]]]:
        """Runs of cells of one kind: the kind, and node numbers of shape (cells, nodes of the
        kind); read-only, no copy. Mesh(m.points, m.cells, m.fields) is the same mesh."""
        kinds, offsets, nodes = self._handle.kinds, self._handle.offsets, self._handle.nodes
        starts = np.concatenate(([0], np.flatnonzero(np.diff(kinds)) + 1, [len(kinds)]))
        blocks = []
        for begin, end in zip(starts[:-1], starts[1:]):
            if begin == end:
                continue
            kind = KINDS[kinds[begin]]
            part = nodes[offsets[begin] : offsets[end]]
            blocks.append((kind, part.reshape(end - begin, NODES_OF_KIND[kind])))
        return blocks

    @property
    def kinds(self) -> npt.NDArray[np.uint8]:
        """Of every cell the index of its kind into KINDS; read-only, no copy."""
        return self._handle.kinds

    @property
    def fields(self) -> Fields:
        """The fields by name; their values are read-only and no copies."""
        return Fields(self._handle)

    @property
    def metadata(self) -> dict[str, str]:
        """Free text by key: source file, time ..."""
        return dict(self._handle.metadata)

    @property
    def scalar_names(self) -> list[str]:
        """The scalars that a view may show: fields, components (`v:x`), magnitudes, invariants."""
        return self._handle.scalar_names()

    def scalar(self, name: str) -> Field:
        """A scalar by one of scalar_names. Raises UsageError, naming them, for another."""
        field = self._handle.scalar(name)
        return Field(field.values, field.location, field.unit)

    def with_fields(self, fields: Mapping[str, Field | npt.ArrayLike]) -> Mesh:
        """The mesh with further fields, which replace those of the same names. Shares all arrays."""
        handle = self._handle
        counts = {"node": len(handle.points), "cell": len(handle.kinds), "corner": len(handle.nodes)}
        kept = [f for k, f in enumerate(handle.fields)
                if f.name not in fields and handle.distinct_name(k) not in fields]
        new = [_packed_field(n, f, counts) for n, f in fields.items()]
        return Mesh._of(_core.Mesh(handle.points, handle.kinds, handle.offsets, handle.nodes,
                                   kept + new, handle.metadata), self.notes)

    def content_hash(self) -> str:
        """32 hexadecimal digits: of kinds, nodes, coordinates and fields, not of metadata."""
        return self._handle.content_hash()

    def __repr__(self) -> str:
        counts = np.bincount(self.kinds, minlength=len(KINDS))
        kinds = ", ".join(f"{n} {kind}" for kind, n in zip(KINDS, counts) if n)
        return f"<hiac.Mesh: {len(self.points)} nodes; {kinds or 'no cells'}; fields {list(self.fields)}>"


def _as_points(points: npt.ArrayLike) -> npt.NDArray[np.float64]:
    positions = np.ascontiguousarray(points, dtype=np.float64)
    if positions.ndim != 2 or positions.shape[1] != 3:
        raise UsageError(f"points: shape (n, 3) expected ({positions.shape} found)")
    return positions


def _as_nodes(kind: str, cells: npt.ArrayLike) -> npt.NDArray[np.uint32]:
    if kind not in NODES_OF_KIND:
        raise UsageError(f"cells: no kind `{kind}` ({', '.join(KINDS)})")
    nodes = np.asarray(cells)
    wanted = NODES_OF_KIND[kind]
    if nodes.ndim != 2 or nodes.shape[1] != wanted:
        raise UsageError(f"cells of {kind}: shape (n, {wanted}) expected ({nodes.shape} found)")
    if nodes.dtype.kind not in "iu":
        raise UsageError(f"cells of {kind}: whole numbers expected ({nodes.dtype} found)")
    if nodes.dtype != np.uint32 and nodes.size and (nodes.min() < 0 or nodes.max() >= 2**32):
        raise UsageError(f"cells of {kind}: node numbers from 0 to 2^32 - 1 expected "
                         f"({nodes.min()} to {nodes.max()} found)")
    return np.ascontiguousarray(nodes, dtype=np.uint32)


def _packed(cells: Cells) -> tuple[npt.NDArray, npt.NDArray, npt.NDArray]:
    """Kinds, cumulative node counts and nodes of all cells."""
    items = cells.items() if isinstance(cells, Mapping) else cells
    blocks = [(kind, _as_nodes(kind, nodes)) for kind, nodes in items]
    counts = [len(nodes) for _, nodes in blocks]
    kinds = np.repeat(np.array([KINDS.index(k) for k, _ in blocks], np.uint8), counts)
    if len(blocks) == 1:
        nodes = blocks[0][1].reshape(-1)
        per_cell = blocks[0][1].shape[1]
        return kinds, np.arange(0, nodes.size + 1, per_cell, dtype=np.uint64), nodes
    offsets = np.zeros(len(kinds) + 1, np.uint64)
    sizes = np.array([NODES_OF_KIND[kind] for kind in KINDS], np.uint64)
    np.cumsum(sizes[kinds], out=offsets[1:])
    parts = [nodes.reshape(-1) for _, nodes in blocks]
    return kinds, offsets, np.concatenate(parts) if parts else np.empty(0, np.uint32)


def _packed_field(name: str, field: Field | npt.ArrayLike, counts: dict[str, int]) -> _core.Field:
    if not isinstance(field, Field):
        field = Field(field)
    values = np.ascontiguousarray(field.values, dtype=np.float64)
    if values.ndim not in (1, 2):
        raise UsageError(f"field `{name}`: shape (tuples,) or (tuples, components) expected "
                         f"({values.shape} found)")
    location = field.location
    if location is None:
        fitting = [where for where, count in counts.items() if count == len(values)]
        if len(fitting) != 1:
            sizes = ", ".join(f"{count} {where}s" for where, count in counts.items())
            raise UsageError(f"field `{name}`: {len(values)} values fit "
                             f"{' and '.join(fitting) or 'nothing'} of the mesh ({sizes}): "
                             "Field(values, location) expected")
        location = fitting[0]
    for suffix in ("@node", "@cell", "@corner"):
        name = name.removesuffix(suffix)
    return _core.Field(name, location, field.unit, values)
