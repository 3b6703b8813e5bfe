#!/usr/bin/python3
"""Compares hiac-preview's method M1 with VTK's projected tetrahedra, and makes the table in
docs/preview-methods.md again.

    samples/peers/projected.py [--only NAME,NAME] [--views "NAME;NAME"] [--side N] [MESH.vtu:FIELD ...]
    samples/peers/projected.py --docs [MESH.vtu:FIELD ...]      the table of the page

    HIAC_BUILD_DIR   where hiac is built (build/release): hiac-render, hiac-preview

Every mesh in every view: the meshes of scenes.py, or those of them that --only names (none: "-"), and
the files given, unit cubes of linear tetrahedra with a field from 0 to 1. Both draw in the order of
centroids and keep floats, so that no picture is worse by the bytes of a window. Errors are against the
accurate engine, over red, green, blue and alpha: the largest, and the root mean square over the pixels
that the mesh covers. Ends with 1 where one of M1's is larger than VTK's.

Needs python3-vtk9, python3-numpy, xvfb and xauth.
"""
import argparse
import os
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import meshes
import scenes

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
BUILD = Path(os.environ.get("HIAC_BUILD_DIR", ROOT / "build/release"))
PAGE = ROOT / "docs/preview-methods.md"
PATIENCE = 300  # seconds for a picture of VTK's

AT_AN_ANGLE = {"projection": "perspective", "eye": [3.1, 2.3, 2.7], "look_at": [0.5, 0.5, 0.5],
               "up": [0.0, 0.0, 1.0], "fov": 27.0}


def scaled(points, factor):
    return [[scalar, factor * extinction] for scalar, extinction in points]


# Name: camera, colours, extinction.
VIEWS = {
    "parallel": (scenes.ASLANT, scenes.COLORS, scenes.BUMPS),
    "perspective": (AT_AN_ANGLE, scenes.COLORS, scenes.BUMPS),
    "eye close": (scenes.CLOSE, scenes.COLORS, scenes.BUMPS),
    "along an axis": (scenes.ALONG_AXIS, scenes.COLORS, scenes.BUMPS),
    "dense": (scenes.ASLANT, scenes.COLORS, scaled(scenes.BUMPS, 15)),
    "dense, perspective": (AT_AN_ANGLE, scenes.COLORS, scaled(scenes.BUMPS, 15)),
    "constant": (scenes.ASLANT, scenes.COLORS, [[0.0, 2.0], [1.0, 2.0]]),
    "nearly constant": (scenes.ASLANT, scenes.COLORS, [[0.0, 2.0], [1.0, 2.01]]),
    "ramp": (scenes.ASLANT, scenes.TWO_COLORS, scenes.RAMP),
    "ramp, perspective": (AT_AN_ANGLE, scenes.TWO_COLORS, scenes.RAMP),
    "thin": (scenes.ASLANT, scenes.COLORS, [[0.0, 0.001], [1.0, 0.002]]),
}
MESHES = {
    "cubes in sixes": (meshes.tetrahedra, 8, 0.25),
    "finer": (meshes.tetrahedra, 24, 0.2),
    "lattice": (meshes.tetrahedra, 8, 0.0),
    "hollow": (meshes.hollow, 10, 0.25),
}


@dataclass(frozen=True)
class Drawn:
    """A mesh in a file, and what of it is drawn."""
    name: str
    path: Path
    field: str


def specification(view, field, side):
    camera, colors, extinction = VIEWS[view]
    return scenes.specification(camera, colors, extinction, field, side)


def run(command, what):
    result = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE,
                            stderr=subprocess.PIPE, text=True, timeout=PATIENCE, check=False)
    if result.returncode != 0:
        sys.exit(f"projected.py: {what}: {result.stderr.strip()}")


def picture(tool, mesh, view, scratch, *options):
    path = scratch / f"{tool}.npy"
    run([BUILD / f"tools/{tool}/hiac-{tool}", "-q", mesh.path, "--view", view, "-o", path, *options],
        f"{mesh.name}: hiac-{tool}")
    return np.load(path)[:, :, :4]


def picture_of_vtk(mesh, view, scratch):
    path = scratch / "vtk.npy"
    run(["xvfb-run", "-a", sys.executable, HERE / "draw.py", mesh.path, view, "projected", path,
         "--floats"], f"{mesh.name}: VTK")
    return np.load(path)


def errors(drawn, truth):
    """The largest, and the root mean square where there is something."""
    error = np.abs(drawn - truth)
    return error.max(), np.sqrt((error[truth[:, :, 3] > 0] ** 2).mean())


def compare(mesh, view, side, scratch):
    """Errors of VTK, M1 and `exact`."""
    toml = scratch / "view.toml"
    toml.write_text(specification(view, mesh.field, side))
    truth = picture("render", mesh, toml, scratch)
    found = [errors(picture_of_vtk(mesh, toml, scratch), truth)]
    for method, order in (("M1", "centroid"), ("exact", "exact")):
        drawn = picture("preview", mesh, toml, scratch, "--method", method, "--algorithm", order)
        found.append(errors(drawn, truth))
    return found


HEAD = "| view | mesh | VTK, projected | M1 | `exact` |\n|---|---|---|---|---|"


def row(view, mesh, found):
    cells = " | ".join(f"{largest:.1e} / {rms:.1e}" for largest, rms in found)
    return f"| {view} | {mesh.name} | {cells} |"


def chosen_meshes(arguments, scratch):
    names = list(MESHES) if arguments.only is None else arguments.only.split(",")
    for name in names:
        if name == "-":
            continue
        make, *sizes = MESHES[name]
        path = scratch / f"{name.replace(' ', '-')}.vtu"
        points, kind, cells = make(*sizes)
        meshes.write(path, points, kind, cells)
        yield Drawn(f"{name}, {len(cells):,}", path, "f")
    for given in arguments.files:
        path, _, field = given.rpartition(":")
        if not path:
            sys.exit(f"projected.py: {given}: MESH.vtu:FIELD expected")
        yield Drawn(Path(path).stem, Path(path).resolve(), field)


def renew_table(table):
    """Puts the table between the two marks of the page."""
    first, last = "<!-- errors: samples/peers/projected.py --docs -->\n", "<!-- end of errors -->\n"
    before, rest = PAGE.read_text().split(first)
    PAGE.write_text(before + first + "\n" + table + "\n" + last + rest.split(last)[1])


def parsed():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--docs", action="store_true")
    parser.add_argument("--only", metavar="NAMES")
    parser.add_argument("--views", metavar="NAMES", default=";".join(VIEWS))
    parser.add_argument("--side", type=int, default=400, help="pixels of the pictures")
    parser.add_argument("files", nargs="*", metavar="MESH.vtu:FIELD")
    return parser.parse_args()


def main():
    arguments = parsed()
    rows, worse = [HEAD], []
    with tempfile.TemporaryDirectory() as name:
        scratch = Path(name)
        drawn = list(chosen_meshes(arguments, scratch))
        for view in arguments.views.split(";"):
            for mesh in drawn:
                found = compare(mesh, view, arguments.side, scratch)
                rows.append(row(view, mesh, found))
                print(rows[-1], flush=True)
                if any(of_m1 > of_vtk for of_vtk, of_m1 in zip(*found[:2])):
                    worse.append(f"{view}, {mesh.name}")
    if arguments.docs:
        renew_table("\n".join(rows) + "\n")
    for which in worse:
        print(f"projected.py: M1's error is larger than VTK's: {which}", file=sys.stderr)
    return 1 if worse else 0


if __name__ == "__main__":
    sys.exit(main())
