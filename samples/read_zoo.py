#!/usr/bin/env python3
"""Prints what MESH.zoo holds: read_zoo.py MESH.zoo (lib/hiac/mesh/zoo-container.md)."""
import struct
import sys
from collections import Counter

import numpy as np

SHAPES = {"tetrahedron": (4, 10, 20), "pyramid": (5, 13, 21), "prism": (6, 15, 24),
          "wedge": (7, 18, 29), "brick": (8, 20, 32)}
KINDS = [f"{shape}{nodes}" for shape, counts in SHAPES.items() for nodes in counts]


def read_chunks(data):
    """Yields (type, payload) of every chunk before the end chunk."""
    if data[:8] != b"\x89ZOO\r\n\x1a\n" or struct.unpack_from("<I", data, 8)[0] != 1:
        sys.exit("not a zoo container of version 1")
    position = 64
    while True:
        kind, size = struct.unpack_from("<8sQ", data, position)
        payload = data[position + 64:position + 64 + size]
        position += 64 + (size + 63) // 64 * 64
        if kind.rstrip(b"\0") == b"END":
            return
        yield kind.rstrip(b"\0").decode(), payload


chunks = list(read_chunks(open(sys.argv[1], "rb").read()))
arrays = dict(chunks)
kinds = np.frombuffer(arrays["KINDS"], "u1")
xyz = np.frombuffer(arrays["XYZ"], "<f8").reshape(-1, 3)
print(f"{len(kinds)} cells, {len(xyz)} nodes")
for kind, count in sorted(Counter(kinds.tolist()).items()):
    print(f"{KINDS[kind]} {count}")
for payload in (payload for kind, payload in chunks if kind == "FIELD"):
    where, components, name, unit = struct.unpack_from("<4I", payload)
    text = payload[16:16 + name].decode(), payload[16 + name:16 + name + unit].decode()
    values = np.frombuffer(payload, "<f8", offset=(16 + name + unit + 63) // 64 * 64)
    print(f"field {text[0]} [{text[1]}] on {('nodes', 'cells', 'corners')[where]},",
          f"{components} components, {np.nanmin(values):g} to {np.nanmax(values):g}")
