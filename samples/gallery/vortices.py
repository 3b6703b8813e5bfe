#!/usr/bin/python3
"""Makes vortices.vtk: the density of two trailing vortices, one of which bursts, on a mesh of
tetrahedra that is refined towards their cores.

    /usr/bin/python3 vortices.py [vortices.vtk]      (Debian: python3-numpy)

The kind of data of figures 15 and 16 of Williams, Max and Stein (1998); a case of this project's
own, its field a formula (density). The mesh starts from Kuhn's cubes, six tetrahedra each, and
halves longest edges (Rivara) until every cell is as small as the formula target_size wants it
there; it has no hanging nodes.
"""
import sys

import numpy as np

LENGTHS = np.array([4.0, 2.0, 1.25])  # the block, from the origin on; flow in x
CUBES = np.array([16, 8, 5])
BURST = 1.9  # x at which the nearer vortex bursts


def axis_of_vortex(x, side):
    """Where the core of the vortex at y = 1 + side * 0.42 lies: y and z, by x."""
    swirl = np.clip((x - BURST) / 0.5, 0, 1) ** 2 * 0.09 if side < 0 else np.zeros_like(x)
    return (1 + side * (0.30 + 0.06 * x) + swirl * np.cos(9 * x),
            0.30 + 0.14 * x + swirl * np.sin(9 * x))


def radius_of_vortex(x, side):
    """Of its core: grows slowly, after the burst fast."""
    burst = np.clip((x - BURST) / 0.35, 0, 1) if side < 0 else np.zeros_like(x)
    return 0.020 + 0.012 * x + burst * (0.045 + 0.03 * (x - BURST))


def density(p):
    """1 far away, low in the cores; a thin sheet of the shear layer winds round each of them."""
    x, y, z = p.T
    value = np.ones_like(x)
    for side in (-1, 1):
        cy, cz = axis_of_vortex(x, side)
        core = radius_of_vortex(x, side)
        distance = np.hypot(y - cy, z - cz)
        angle = np.arctan2(z - cz, side * (y - cy))
        value -= 0.75 * np.exp(-(distance / core) ** 2)
        spiral = np.cos(angle - 6 * np.log(1 + distance / core) + 2.5 * x)
        value -= 0.10 * (1 + spiral) * np.exp(-(distance / (3.2 * core)) ** 2)
    return value


def target_size(p):
    """Longest edge wanted at a place."""
    x, y, z = p.T
    size = np.full_like(x, np.inf)
    for side in (-1, 1):
        cy, cz = axis_of_vortex(x, side)
        core = radius_of_vortex(x, side)
        outside = np.maximum(np.hypot(y - cy, z - cz) - 1.5 * core, 0)
        size = np.minimum(size, 0.8 * core + 0.75 * outside)
    return size


def kuhn_mesh():
    """Positions and cells of the block of cubes, each cut in six around its diagonal."""
    nodes = CUBES + 1
    grid = np.stack(np.meshgrid(*map(np.arange, nodes), indexing="ij"), -1).reshape(-1, 3)
    stride = np.array([nodes[1] * nodes[2], nodes[2], 1])
    first = (np.stack(np.meshgrid(*map(np.arange, CUBES), indexing="ij"), -1).reshape(-1, 3)
             @ stride)
    cells = []
    for a, b in ((0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)):
        c = 3 - a - b
        steps = np.cumsum([0, stride[a], stride[b], stride[c]])
        cells.append(first[:, None] + steps)
    return grid * (LENGTHS / CUBES), np.concatenate(cells)


PAIRS = np.array([(0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3)])


def edge_keys(xyz, cells):
    """A number for each cell's six edges, the same in all cells that share the edge, and squares of
    their lengths, rounded: by both, edges have one order that all cells agree on."""
    ends = np.sort(cells[:, PAIRS], axis=2)
    squared = ((xyz[ends[..., 0]] - xyz[ends[..., 1]]) ** 2).sum(2)
    return ends[..., 0] * np.int64(len(xyz)) + ends[..., 1], np.round(squared, 12)


def halve_longest(xyz, cells, wanted):
    """Halves the longest edges of the cells `wanted`, and whatever edges else that takes so that
    every cell with a halved edge has its longest edge halved."""
    key, squared = edge_keys(xyz, cells)
    row = np.arange(len(cells))
    longest = np.lexsort((key, squared), axis=1)[:, -1]
    keys, number = np.unique(key, return_inverse=True)
    number = number.reshape(-1, 6)
    halved = np.zeros(len(keys), bool)
    touched = wanted
    while not halved[number[row, longest]][touched].all():
        halved[number[row, longest][touched]] = True
        touched = halved[number].any(1)
    keys = keys[halved]
    middles = len(xyz) + np.arange(len(keys))
    new = (xyz[keys // len(xyz)] + xyz[keys % len(xyz)]) / 2
    return np.concatenate([xyz, new]), halve_cells(xyz, cells, keys, middles)


def halve_cells(xyz, cells, keys, middles):
    """Halves cells, at the longest of their edges that has a middle, until no cell has such an
    edge. Cells with a common face halve it alike: no node hangs."""
    done = []
    while len(cells):
        new = (cells >= len(xyz))[:, PAIRS].any(2)  # edges that end in a middle have none
        known = np.where(cells < len(xyz), cells, 0)
        key, squared = edge_keys(xyz, known)
        place = np.minimum(np.searchsorted(keys, key), len(keys) - 1)
        has_middle = (keys[place] == key) & ~new
        touched = has_middle.any(1)
        done.append(cells[~touched])
        cells, place = cells[touched], place[touched]
        squared = np.where(has_middle, squared, -1)[touched]
        edge = np.lexsort((key[touched], squared), axis=1)[:, -1]
        row = np.arange(len(cells))
        children = [cells.copy(), cells.copy()]
        for child, end in zip(children, PAIRS[edge].T):
            child[row, end] = middles[place[row, edge]]
        cells = np.concatenate(children)
    return np.concatenate(done)


def refined_mesh():
    xyz, cells = kuhn_mesh()
    while True:
        edge = xyz[cells[:, PAIRS[:, 0]]] - xyz[cells[:, PAIRS[:, 1]]]
        length = np.sqrt((edge ** 2).sum(2).max(1))
        wanted = length > target_size(xyz[cells].mean(1))
        if not wanted.any():
            return xyz, cells
        xyz, cells = halve_longest(xyz, cells, wanted)


def check(xyz, cells):
    """Ends the program unless the cells fill the block and no node hangs."""
    corners = xyz[cells]
    volume = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])) / 6
    assert volume.min() > 0 and abs(volume.sum() / LENGTHS.prod() - 1) < 1e-12
    faces = np.sort(np.concatenate([np.delete(cells, k, 1) for k in range(4)]), axis=1)
    faces, count = np.unique(faces, axis=0, return_counts=True)
    lonely = xyz[faces[count == 1]]
    on_side = ((lonely == 0).all(1) | (lonely == LENGTHS).all(1)).any(1)
    assert count.max() == 2 and on_side.all(), "a face inside has one cell"
    print(f"{len(cells)} cells, {len(xyz)} nodes, volumes {volume.min():.1e} to "
          f"{volume.max():.1e}")


def write_vtk(path, xyz, cells, values):
    with open(path, "wb") as file:
        file.write(b"# vtk DataFile Version 3.0\ndensity of two vortices\nBINARY\n"
                   b"DATASET UNSTRUCTURED_GRID\nPOINTS %d double\n" % len(xyz))
        file.write(xyz.astype(">f8").tobytes())
        file.write(b"\nCELLS %d %d\n" % (len(cells), 5 * len(cells)))
        file.write(np.insert(cells, 0, 4, axis=1).astype(">i4").tobytes())
        file.write(b"\nCELL_TYPES %d\n" % len(cells))
        file.write(np.full(len(cells), 10, ">i4").tobytes())
        file.write(b"\nPOINT_DATA %d\nSCALARS density double\nLOOKUP_TABLE default\n" % len(xyz))
        file.write(values.astype(">f8").tobytes() + b"\n")


def main():
    xyz, cells = refined_mesh()
    check(xyz, cells)
    write_vtk(sys.argv[1] if len(sys.argv) > 1 else "vortices.vtk", xyz, cells, density(xyz))


if __name__ == "__main__":
    main()
