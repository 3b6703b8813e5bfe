#!/usr/bin/env python3
"""Reads images that hiac wrote, by what their formats say and by nothing of hiac's.

Usage: read_images.py FOLDER. The folder holds truth.npy (linear, premultiplied R G B A ...) and the
same image in the other formats. Exit status 1 with a line for every format that is read otherwise.
"""
import pathlib
import struct
import sys
import zlib

import numpy


def read_sgi(data):
    magic, storage, size, axes, width, height, channels, low, high = struct.unpack(">HBBHHHHII", data[:20])
    assert magic == 474 and storage == 1 and (axes == 3 or channels == 1) and low == 0
    assert high == 256 ** size - 1 and struct.unpack(">I", data[104:108]) == (0,)
    rows = height * channels
    starts = struct.unpack(f">{rows}I", data[512:512 + 4 * rows])
    lengths = struct.unpack(f">{rows}I", data[512 + 4 * rows:512 + 8 * rows])
    image = numpy.zeros((height, width, channels), int)
    for index, (start, length) in enumerate(zip(starts, lengths)):
        units = numpy.frombuffer(data[start:start + length], f">u{size}").astype(int)
        row, at = [], 0
        while units[at] & 0x7F:
            count = units[at] & 0x7F
            if units[at] & 0x80:
                row += list(units[at + 1:at + 1 + count])
                at += 1 + count
            else:
                row += [units[at + 1]] * count
                at += 2
        assert at + 1 == len(units) and len(row) == width
        image[height - 1 - index % height, :, index // height] = row
    return image / high


def read_pfm(data):
    kind, sides, scale, numbers = data.split(b"\n", 3)
    width, height = map(int, sides.split())
    assert kind in (b"PF", b"Pf") and float(scale) < 0
    return numpy.frombuffer(numbers, "<f4").reshape(height, width, -1)[::-1]


def read_hdr(data):
    header, rest = data.split(b"\n\n", 1)
    assert header.startswith(b"#?RADIANCE\n") and b"FORMAT=32-bit_rle_rgbe" in header
    resolution, rest = rest.split(b"\n", 1)
    y, height, x, width = resolution.split()
    assert (y, x) == (b"-Y", b"+X")
    height, width = int(height), int(width)
    image, at = numpy.zeros((height, width, 4), int), 0
    for row in image:
        if not 8 <= width < 32768:
            row[:] = numpy.frombuffer(rest[at:at + 4 * width], "u1").reshape(width, 4)
            at += 4 * width
            continue
        assert rest[at:at + 2] == b"\2\2" and rest[at + 2] * 256 + rest[at + 3] == width
        at += 4
        for c in range(4):
            x = 0
            while x < width:
                count = rest[at]
                if count > 128:
                    count -= 128
                    row[x:x + count, c] = rest[at + 1]
                    at += 2
                else:
                    row[x:x + count, c] = list(rest[at + 1:at + 1 + count])
                    at += 1 + count
                x += count
    assert at == len(rest)
    return numpy.ldexp(image[..., :3].astype(float), image[..., 3:] - 136)


def read_tiff(data):
    assert data[:4] == b"II*\0"
    start, = struct.unpack("<I", data[4:8])
    count, = struct.unpack("<H", data[start:start + 2])
    tags = {}
    for i in range(count):
        tag, kind, number, value = struct.unpack("<HHI4s", data[start + 2 + 12 * i:start + 14 + 12 * i])
        if kind not in (3, 4):
            continue
        size = 2 if kind == 3 else 4
        if number * size > 4:
            offset, = struct.unpack("<I", value)
            value = data[offset:offset + number * size]
        tags[tag] = struct.unpack(f"<{number}{'H' if kind == 3 else 'I'}", value[:number * size])
    width, height, bits, channels = tags[256][0], tags[257][0], tags[258][0], tags[277][0]
    assert set(tags[258]) == {bits} and tags[259] == (8,) and tags[262] == (2 if channels > 2 else 1,)
    assert tags.get(284, (1,)) == (1,) and tags[339] == (3 if bits == 32 else 1,) * channels
    if channels % 2 == 0:
        assert tags[338] == (1 if bits == 32 else 2,)
    rows = []
    for offset, length in zip(tags[273], tags[279]):
        strip = zlib.decompress(data[offset:offset + length])
        if bits == 32:  # predictor 3: differences of bytes, the highest bytes of a row first
            assert tags[317] == (3,)
            strip = numpy.frombuffer(strip, "u1").reshape(-1, width * channels * 4)
            for row in strip:
                row = numpy.cumsum(row.reshape(-1, channels), axis=0, dtype="u1").reshape(4, -1)
                rows.append(row[::-1].T.copy().view("<f4").reshape(width, channels))
        else:  # predictor 2: differences of pixels
            assert tags[317] == (2,)
            strip = numpy.frombuffer(strip, f"<u{bits // 8}").reshape(-1, width, channels)
            rows += list(numpy.cumsum(strip, axis=1, dtype=strip.dtype) / (2 ** bits - 1))
    assert len(rows) == height
    return numpy.array(rows)


READERS = {".sgi": read_sgi, ".tiff": read_tiff, ".pfm": read_pfm, ".hdr": read_hdr}


def expected(truth, name):
    """What a file should hold, and how far its numbers may be from that."""
    color, alpha = truth[..., :3], truth[..., 3:4]
    if name == "float.tiff":
        return truth[..., :4].astype("f4"), 0
    if name.endswith(".pfm"):
        return color.astype("f4"), 0
    if name.endswith(".hdr"):  # half a step of 8 bits of the pixel's largest component
        return color, color.max(axis=2, keepdims=True) / 255
    straight = numpy.clip(color / alpha, 0, 1)
    if not name.startswith("linear"):
        straight = numpy.where(straight <= 0.0031308, 12.92 * straight,
                               1.055 * straight ** (1 / 2.4) - 0.055)
    steps = 65535 if "16" in name else 255
    return numpy.concatenate([straight, alpha], axis=2), 0.5 / steps + 1e-12


def main():
    folder = pathlib.Path(sys.argv[1])
    truth = numpy.load(folder / "truth.npy")
    files = [file for file in sorted(folder.iterdir()) if file.suffix in READERS]
    faults = 0
    for file in files:
        found = READERS[file.suffix](file.read_bytes())
        wanted, tolerance = expected(truth, file.name)
        if found.shape != wanted.shape or not numpy.all(numpy.abs(found - wanted) <= tolerance):
            print(f"{file.name}: read as something else")
            faults += 1
    print(f"{len(files)} files read, {faults} faults")
    sys.exit(1 if faults or not files else 0)


main()
