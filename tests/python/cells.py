"""Small meshes of every kind of cell, made of numpy arrays, and views of them."""
import numpy as np

import hiac

CORNERS = {
    "tetrahedron": [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
    "pyramid": [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.5, 0.5, 1)],
    "prism": [(0, 0, 0), (0, 1, 0), (1, 0, 0), (0, 0, 1), (0, 1, 1), (1, 0, 1)],
    "wedge": [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (0.5, 1, 1)],
    "brick": [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0),
              (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)],
}
EDGES = {
    "tetrahedron": [(0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3)],
    "pyramid": [(0, 1), (1, 2), (2, 3), (3, 0), (0, 4), (1, 4), (2, 4), (3, 4)],
    "prism": [(0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5)],
    "wedge": [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 4), (0, 4), (1, 5), (2, 6),
              (3, 6)],
    "brick": [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5),
              (2, 6), (3, 7)],
}
FACES_OF_TETRAHEDRON = [(0, 1, 3), (1, 2, 3), (2, 0, 3), (0, 2, 1)]


def nodes_of_cell(kind):
    """Positions of the nodes of one cell: corners, nodes on edges, centres of faces."""
    shape = kind.rstrip("0123456789")
    points = [np.array(p, float) for p in CORNERS[shape]]
    corners = list(points)
    left = hiac.NODES_OF_KIND[kind] - len(corners)
    order = 1 + left // len(EDGES[shape])
    for a, b in EDGES[shape]:
        for k in range(1, order):
            points.append(corners[a] + (corners[b] - corners[a]) * k / order)
    if kind == "tetrahedron20":
        points += [sum(corners[c] for c in face) / 3 for face in FACES_OF_TETRAHEDRON]
    return np.array(points)


def mesh_of(kind, seed=7):
    """Two cells of a kind, apart from one another, with a node field, a vector, and cell values."""
    one = nodes_of_cell(kind)
    points = np.concatenate([one, one + [0.3, 1.5, 0.1]])
    cells = np.arange(len(points), dtype=np.uint32).reshape(2, -1)
    random = np.random.default_rng(seed)
    return hiac.Mesh(points, {kind: cells}, {
        "s": hiac.Field(random.random(len(points)), "node", "K"),
        "v": hiac.Field(random.random((len(points), 3)), "node"),
        "c": hiac.Field(np.array([0.25, 0.75]), "cell")})


def grid(n, jitter=0.0, seed=3):
    """n^3 cubes of six tetrahedra each, with the field s."""
    side = n + 1
    axis = np.arange(side, dtype=float)
    points = np.stack(np.meshgrid(axis, axis, axis, indexing="ij"), -1).reshape(-1, 3)
    points += jitter * np.random.default_rng(seed).uniform(-1, 1, points.shape)
    number = np.arange(side**3, dtype=np.uint32).reshape(side, side, side)
    corner = [number[i:n + i, j:n + j, k:n + k].ravel()
              for i in (0, 1) for j in (0, 1) for k in (0, 1)]
    paths = [(0, 1, 3, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7), (0, 4, 5, 7), (0, 5, 1, 7)]
    cells = np.stack([np.stack([corner[c] for c in path], 1) for path in paths], 1).reshape(-1, 4)
    return points, np.ascontiguousarray(cells), np.sin(points).sum(1)


def view_of(mesh, field="s", size=(48, 36)):
    return hiac.starter_view(mesh, field, size=size)
