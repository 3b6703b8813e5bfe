#!/usr/bin/python3
"""Makes the pictures and the table of docs/peers.md again.

    samples/peers/make.py [FOLDER]        pictures and figures.md into FOLDER (build/peers)
    samples/peers/make.py --docs          the pictures and the table of docs/peers.md
    samples/peers/make.py --only plain,lattice [FOLDER]

    HIAC_BUILD_DIR   where hiac is built (build/release): hiac-convert, hiac-render, hiac-compare

Draws every scene of scenes.py with hiac and with VTK's three mappers, one of them twice, each in a process of its own,
on a screen that only exists in memory. Needs python3-vtk9, python3-numpy, xvfb and xauth.
"""
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter

from scenes import SCENES, SIDE

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))
from programs import ROOT, compare, renew_table, run  # noqa: E402

PAGE = ROOT / "docs/peers.md"
MAPPERS = {"projected": "projected tetrahedra", "raycast": "ray cast", "tuned": "ray cast, tuned",
           "zsweep": "z-sweep"}
PATIENCE = 120  # seconds for a picture of VTK's, which takes a few
LARGEST_SHOWN = 0.1  # error that the last colour of error maps means
VIRIDIS = np.array([[0x44, 0x01, 0x54], [0x44, 0x39, 0x83], [0x31, 0x68, 0x8e], [0x21, 0x91, 0x8c],
                    [0x35, 0xb7, 0x79], [0x90, 0xd7, 0x43], [0xfd, 0xe7, 0x25]])


def draw_with_vtk(scene, mesh, view, mapper, picture):
    command = ["xvfb-run", "-a", sys.executable, HERE / "draw.py", mesh, view, mapper, picture]
    if scene.first_frame:
        command.append("--first-frame")
    result = subprocess.run(command, stderr=subprocess.PIPE, text=True, timeout=PATIENCE,
                            check=False)
    if result.returncode != 0 or not picture.exists():
        sys.exit(f"make.py: {scene.name}: VTK drew nothing with {mapper}: {result.stderr.strip()}")


def figures(picture, mesh, view):
    """What hiac-compare says of a picture: errors over R, G and B, metrics, and what it suspects."""
    facts, largest, rmse = compare(picture, "--truth", mesh, "--view", view)
    place = facts["misfit"].get("place")
    return {"largest": largest, "rmse": rmse,
            "psnr": facts["psnr"], "flip": facts["flip"]["mean"],
            "truth": facts["truth_error"],
            "shift": place and place["shift"], "scale": place and place["scale"]}


# Pictures ----------------------------------------------------------------------------------------


def displayed(linear):
    """Linear values as bytes of sRGB."""
    v = np.clip(linear, 0, 1)
    encoded = np.where(v <= 0.0031308, 12.92 * v, 1.055 * v ** (1 / 2.4) - 0.055)
    return np.floor(255 * encoded + 0.5).astype(np.uint8)


def error_map(picture, truth):
    """The largest error of a pixel's R, G and B in colours of viridis, from 0 to LARGEST_SHOWN."""
    error = np.abs(picture - truth).max(axis=2) / LARGEST_SHOWN
    at = np.clip(error, 0, 1) * (len(VIRIDIS) - 1)
    return np.stack([np.interp(at, np.arange(len(VIRIDIS)), VIRIDIS[:, c]) for c in range(3)],
                    axis=2).astype(np.uint8)


def write_png(path, pixels):
    image = vtkImageData()
    image.SetDimensions(pixels.shape[1], pixels.shape[0], 1)
    rows = np.ascontiguousarray(pixels[::-1]).reshape(-1, 3)
    image.GetPointData().SetScalars(numpy_to_vtk(rows, deep=1))
    writer = vtkPNGWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(image)
    writer.SetCompressionLevel(9)
    writer.Write()


def montage(truth, pictures):
    """The truth and the pictures in a row, and their error maps below."""
    gap = np.full((SIDE, 4, 3), 255, np.uint8)
    empty = np.full((SIDE, SIDE, 3), 255, np.uint8)
    upper, lower = [displayed(truth)], [empty]
    for picture in pictures:
        upper += [gap, displayed(picture)]
        lower += [gap, error_map(picture, truth)]
    above, below = np.concatenate(upper, axis=1), np.concatenate(lower, axis=1)
    between = np.full((4, above.shape[1], 3), 255, np.uint8)
    return np.concatenate([above, between, below])


def make_scene(scene, scratch, folder):
    """Draws a scene, writes its montage, and returns the figures of each mapper."""
    mesh, view = scratch / f"{scene.name}.vtu", scratch / f"{scene.name}.toml"
    scene.write_mesh(mesh)
    view.write_text(scene.specification())
    exact = scratch / f"{scene.name}.npy"
    run("render", mesh, "--view", view, "-o", exact)
    truth, pictures, found = np.load(exact)[:, :, :3], [], {}
    for mapper in MAPPERS:
        picture = scratch / f"{scene.name}-{mapper}.npy"
        draw_with_vtk(scene, mesh, view, mapper, picture)
        pictures.append(np.load(picture))
        found[mapper] = figures(picture, mesh, view)
    write_png(folder / f"{scene.name}.png", montage(truth, pictures))
    return found


# The table ---------------------------------------------------------------------------------------

HEAD = ("| scene | mapper | largest error | RMS error | PSNR (dB) | mean FLIP | shift found (pixels) | "
        "truth exact to |\n|---|---|---|---|---|---|---|---|")


def rows_of(scene, found):
    for mapper, name in MAPPERS.items():
        f = found[mapper]
        shift = "-" if f["shift"] is None else f"{f['shift'][0]:.2f}, {f['shift'][1]:.2f}"
        if f["scale"] is not None and abs(f["scale"] - 1) >= 5e-4:
            shift += f", {f['scale']:.3f} times as large"
        yield (f"| {scene.name} | {name} | {f['largest']:.1e} | {f['rmse']:.1e} | {f['psnr']:.1f} | "
               f"{f['flip']:.4f} | {shift} | {f['truth']:.0e} |")


def main():
    arguments = sys.argv[1:]
    chosen = {s.name for s in SCENES}
    if arguments[:1] == ["--only"]:
        chosen, arguments = set(arguments[1].split(",")), arguments[2:]
        if unknown := chosen - {s.name for s in SCENES}:
            sys.exit(f"make.py: no such scene: {', '.join(sorted(unknown))}")
    for_docs = arguments == ["--docs"]
    folder = ROOT / "docs/peers" if for_docs else Path(*(arguments or [ROOT / "build/peers"]))
    folder.mkdir(parents=True, exist_ok=True)
    rows = [HEAD]
    with tempfile.TemporaryDirectory() as name:
        for scene in SCENES:
            if scene.name not in chosen:
                continue
            found = make_scene(scene, Path(name), folder)
            rows += rows_of(scene, found)
            print("\n".join(rows_of(scene, found)), flush=True)
    table = "\n".join(rows) + "\n"
    if for_docs:
        renew_table(PAGE, "figures", "samples/peers/make.py", table)
    else:
        (folder / "figures.md").write_text(table)


if __name__ == "__main__":
    main()
