#!/usr/bin/python3
"""Makes the guide's sheets of pictures again, with hiac-render beside hiac-convert in PATH.

    samples/guide/sheets.py told SHEET.png           the pictures of docs/guide/transfer-functions.md, by
                                                     the page's own commands
    samples/guide/sheets.py contact FOLDER SHEET.png [FACTS.json]
                                                     sixty of the files in a folder of meshes, each by one
                                                     command without options; with what became of all files

Needs python3-numpy.
"""
import json
import re
import shlex
import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent.parent
PAGE = ROOT / "docs/guide/transfer-functions.md"
SAMPLE = ROOT / "samples/reactor-pool/flow.vtu"

TOLD_SIZE = (400, 300)
TOLD_COLUMNS = 3

CELL_SIZE = (121, 91)  # a picture of the contact sheet
FINER = 3              # it is drawn so many times larger, and averaged
CONTACT_COLUMNS = 10
CONTACT_COUNT = 60
# A picture shows its model if more than this share of its pixels is covered ...
LEAST_COVERED = 0.15
# ... by at least half a step of eight bits, and if these percentiles of the display values of covered
# pixels differ from the background by more than a step.
PERCENTILES = (5, 95)
STEP = 1 / 255
SECONDS = 300          # for one file


def display_values(linear):
    """sRGB, from linear light."""
    linear = np.clip(linear, 0, 1)
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)


def write_png(path, values):
    """Writes display values from 0 to 1 as RGB of eight bits."""
    pixels = np.rint(np.clip(values, 0, 1) * 255).astype(np.uint8)
    height, width, _ = pixels.shape
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) +
                     chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b""))


def sheet(pictures, columns, line):
    """Pictures of one size in rows, on white, with lines of so many pixels between them."""
    height, width, _ = pictures[0].shape
    rows = -(-len(pictures) // columns)
    result = np.full((rows * (height + line), columns * (width + line), 3), 0.75 if line else 1.0)
    for k in range(rows * columns):
        y, x = k // columns * (height + line), k % columns * (width + line)
        result[y:y + height, x:x + width] = pictures[k] if k < len(pictures) else 1.0
    return result


def told():
    """The pictures of the page on transfer functions, in display values."""
    pictures = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "run.vtu").write_bytes(SAMPLE.read_bytes())
        for line in PAGE.read_text().splitlines():
            if not re.match(r" {4,}hiac-render .*-o told-\d\.png$", line):
                continue
            command = re.sub(r"told-(\d)\.png$", r"told-\1.npy", line.strip())
            size = "x".join(map(str, TOLD_SIZE))
            words = [*shlex.split(command), "-q", "--size", size]
            subprocess.run(words, cwd=folder, check=True)
            pictures.append(display_values(np.load(folder / words[words.index("-o") + 1])[..., :3]))
    return pictures


def is_shown(image):
    """Whether a picture, linear with alpha, shows its model, and the facts that decide it."""
    covered = image[..., 3] > STEP / 2
    share = float(covered.mean())
    facts = {"covered": share}
    if share == 0:
        return False, facts
    values = display_values(image[..., :3])
    outside = ~covered
    background = values[outside].mean(axis=0) if outside.any() else np.ones(3)
    grey = values[covered].mean(axis=1)
    darkest, brightest = (float(np.percentile(grey, p)) for p in PERCENTILES)
    facts.update(darkest=darkest, brightest=brightest, background=float(background.mean()))
    differ = all(abs(value - facts["background"]) > STEP for value in (darkest, brightest))
    return share > LEAST_COVERED and differ, facts


def draw(path, folder):
    """Draws one file without options: its facts, and the picture, linear, or None."""
    output = folder / "picture.npy"
    output.unlink(missing_ok=True)
    size = "x".join(str(FINER * side) for side in CELL_SIZE)
    command = ["hiac-render", path, "-o", output, "--size", size]
    try:
        done = subprocess.run(command, capture_output=True, errors="replace", timeout=SECONDS, check=False)
    except subprocess.TimeoutExpired:
        return {"file": str(path), "exit": None, "message": f"over {SECONDS} s"}, None
    lines = done.stderr.strip().splitlines()
    facts = {"file": str(path), "exit": done.returncode}
    if done.returncode != 0:
        return {**facts, "message": lines[-1] if lines else ""}, None
    image = np.load(output)
    shown, measured = is_shown(image)
    warnings = [line for line in lines if "warning" in line]
    return {**facts, "shown": shown, **measured, "warnings": warnings}, image


def small(image):
    """The picture for the sheet: means over squares, in display values."""
    width, height = CELL_SIZE
    means = image[..., :3].reshape(height, FINER, width, FINER, 3).mean(axis=(1, 3))
    return display_values(means)


def chosen(drawn):
    """Sixty pictures that show something and are not alike, format by format in turn."""
    by_format = {}
    for facts, picture in drawn:
        by_format.setdefault(Path(facts["file"]).parent, []).append(picture)
    result, queues = [], [pictures for _, pictures in sorted(by_format.items())]
    while len(result) < CONTACT_COUNT and any(queues):
        for queue in queues:
            while queue and len(result) < CONTACT_COUNT:
                picture = queue.pop(0)
                if all(np.abs(picture - other).mean() > 0.01 for other in result):
                    result.append(picture)
                    break
    return result


def contact(data):
    """The sheet's pictures, and the facts of all files."""
    all_facts, drawn = [], []
    with tempfile.TemporaryDirectory() as name:
        for path in sorted(path for path in data.rglob("*") if path.is_file()):
            facts, image = draw(path, Path(name))
            facts["file"] = str(path.relative_to(data))
            all_facts.append(facts)
            if facts.get("shown"):
                drawn.append((facts, small(image)))
            print(json.dumps(facts), flush=True)
    return chosen(drawn), all_facts


def main():
    if len(sys.argv) == 3 and sys.argv[1] == "told":
        write_png(Path(sys.argv[2]), sheet(told(), TOLD_COLUMNS, 0))
    elif len(sys.argv) in (4, 5) and sys.argv[1] == "contact":
        pictures, facts = contact(Path(sys.argv[2]))
        write_png(Path(sys.argv[3]), sheet(pictures, CONTACT_COLUMNS, 1))
        if len(sys.argv) == 5:
            Path(sys.argv[4]).write_text(json.dumps(facts, indent=1))
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main()
