#!/usr/bin/env python3
"""A room includes its own files and those of rooms on floors below, nothing else.

The floors are those of the house: a number a room; two rooms of one floor do not know each other,
but that cluster draws with render.
Usage: room_order_test.py SOURCE_FOLDER. Exit status 1 with a line for every wrong include.
"""
import pathlib
import re
import sys

FLOORS = {
    "base": 0, "mesh": 1, "geometry": 2, "derive": 2, "partition": 2,
    "optics": 3, "scene": 3, "image": 3,
    "element": 4, "order": 4, "tetrahedralize": 4,
    "check": 5, "frame": 5,
    "render": 6, "preview": 6, "annotate": 6,
    "formats": 7, "session": 7, "cluster": 8, "tools": 9, "python": 10,
}
INCLUDE = re.compile(r'^\s*#\s*include\s*["<]((?:hiac|formats|tools|python|tests)/[^">]+)[">]')


def room_of(path):
    """The room of a file or of an included name: "mesh" of hiac/mesh/zoo_mesh.hpp."""
    parts = pathlib.PurePath(path).parts
    if parts[0] in ("include", "lib"):
        parts = parts[1:]
    return parts[1] if parts[0] == "hiac" and len(parts) > 2 else parts[0]


def allowed(path, included):
    own, other = room_of(path), room_of(included)
    if own == other == "tools":  # executables share tools/common alone
        folder = pathlib.PurePath(included).parts[1]
        return folder in ("common", pathlib.PurePath(path).parts[1])
    return own == other or (other in FLOORS and FLOORS[other] < FLOORS[own])


def main():
    source = pathlib.Path(sys.argv[1])
    faults, includes = [], 0
    for folder in ("include/hiac", "lib/hiac", "formats", "tools", "python"):
        for file in sorted((source / folder).rglob("*.[ch]pp")):
            path = file.relative_to(source).as_posix()
            if room_of(path) not in FLOORS:
                faults.append(f"{path}: a room that no floor names ({room_of(path)})")
                continue
            for number, line in enumerate(file.read_text().splitlines(), 1):
                match = INCLUDE.match(line)
                if match is None:
                    continue
                includes += 1
                if not allowed(path, match[1]):
                    faults.append(f"{path}:{number}: {room_of(path)} must not include {match[1]}")
    for fault in faults:
        print(fault)
    print(f"{includes} includes, {len(faults)} wrong")
    if includes == 0:
        sys.exit("no include found: is this the source folder?")
    sys.exit(1 if faults else 0)


main()
