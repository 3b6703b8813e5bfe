#!/usr/bin/python3
"""Makes the pictures and the table of docs/gallery.md again.

    samples/gallery/make.py [FOLDER]        pictures and errors.md into FOLDER (build/gallery)
    samples/gallery/make.py --docs          those of docs/gallery.md, and its table

    HIAC_BUILD_DIR   where hiac is built (build/release): hiac-convert, hiac-render, hiac-compare
    HIAC_DATA_DIR    the folder of real data with vtk_legacy/classic/spx.vtk (../shared/data);
                     without it the reactor's pictures and errors are skipped

Needs python3-numpy, for the mesh that vortices.py makes.
"""
import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent
BUILD = Path(os.environ.get("HIAC_BUILD_DIR", ROOT / "build/release"))
DATA = Path(os.environ.get("HIAC_DATA_DIR", ROOT.parent / "shared/data"))
DOCS = ROOT / "docs"
SMALL = "400x300"  # of docs/gallery

EXACT, GAUSS5 = "exact", "gauss5"
APPROXIMATE, UNSLICED = "approximate", "approximate-unsliced"
SPLATTED = "render.splat_below=2"

# figure of the paper: mesh, specification, and what is set besides
FIGURES = {
    "figure-08": ("reactor", "reactor", [f"render.integration={EXACT}"]),
    "figure-09": ("reactor", "reactor", [f"render.integration={APPROXIMATE}"]),
    "figure-10": ("reactor", "reactor", [f"render.integration={UNSLICED}"]),
    "figure-14": ("reactor", "reactor-surfaces", [f"render.integration={EXACT}"]),
    "figure-15": ("vortices", "vortices", [f"render.integration={EXACT}", SPLATTED]),
    "figure-16": ("vortices", "vortices", [f"render.integration={APPROXIMATE}"]),
}


def run(tool, *arguments):
    """Runs hiac-TOOL; ends the program where it fails, after the tool has said why."""
    command = [BUILD / "tools" / tool / f"hiac-{tool}", "-q", *map(str, arguments)]
    result = subprocess.run(command, stdout=subprocess.PIPE, check=False)
    if result.returncode != 0:
        sys.exit(f"make.py: hiac-{tool} failed")
    return result.stdout


def make_meshes(folder):
    """Mesh files by name; those that can be made."""
    meshes = {}
    spx = DATA / "vtk_legacy/classic/spx.vtk"
    if spx.is_file():
        meshes["reactor"] = folder / "reactor.zoo"
        run("convert", spx, "-o", meshes["reactor"])
    else:
        print(f"SKIPPED: figures 8, 9, 10 and 14 and their errors: {spx} is not there")
    subprocess.run([sys.executable, HERE / "vortices.py", folder / "vortices.vtk"], check=True)
    meshes["vortices"] = folder / "vortices.zoo"
    run("convert", folder / "vortices.vtk", "-o", meshes["vortices"])
    return meshes


def render(mesh, view, settings, output, *arguments):
    sets = [argument for setting in settings for argument in ("--set", setting)]
    run("render", mesh, "--view", HERE / f"{view}.toml", *sets, "-o", output, *arguments)


def make_pictures(meshes, folder, size):
    folder.mkdir(parents=True, exist_ok=True)
    for name, (mesh, view, settings) in FIGURES.items():
        if mesh in meshes:
            arguments = ["--size", size] if size else []
            render(meshes[mesh], view, settings, folder / f"{name}.png", *arguments)
            print(f"made {folder / name}.png")


def difference(image, reference):
    """What the table says of two images: errors over red, green, blue; PSNR, SSIM, mean FLIP."""
    facts = json.loads(run("compare", image, reference, "--json", "-"))
    colours = [c for c in facts["channels"] if c["name"] in "RGB"]
    largest = max(c["largest_error"] for c in colours)
    rmse = (sum(c["rmse"] ** 2 for c in colours) / 3) ** 0.5
    return (f"{largest:.1e} | {rmse:.1e} | {facts['psnr']:.1f} | {facts['ssim']:.4f} | "
            f"{facts['flip']['mean']:.4f} |")


HEAD = ("| picture | held against | largest error | RMS error | PSNR (dB) | SSIM | mean FLIP |\n"
        "|---|---|---|---|---|---|---|")


def integration_rows(meshes, folder):
    """The paper's comparison of methods: each against the exact integral, same rays."""
    for name in meshes:
        exact = folder / f"{name}-exact.npy"
        render(meshes[name], name, [f"render.integration={EXACT}"], exact)
        for method in (GAUSS5, APPROXIMATE, UNSLICED):
            image = folder / f"{name}-{method}.npy"
            render(meshes[name], name, [f"render.integration={method}"], image)
            yield f"| {name}, {method} | exact | " + difference(image, exact)


def splatting_rows(meshes, folder):
    """One ray a pixel, and the same with small cells splatted, against 64 filtered rays."""
    for size in ("400x300", "200x150", "100x75"):
        truth = folder / "truth.npy"
        render(meshes["vortices"], "vortices", [], truth, "--size", size, "--samples", 8,
               "--filter", "bspline")
        for text, settings in (("one ray a pixel", []), ("splatted", [SPLATTED])):
            image = folder / "image.npy"
            render(meshes["vortices"], "vortices", settings, image, "--size", size)
            yield (f"| vortices, {size}, {text} | 64 rays a pixel | " +
                   difference(image, truth))


def error_table(meshes, folder):
    rows = [*integration_rows(meshes, folder), *splatting_rows(meshes, folder)]
    return "\n".join([HEAD, *rows]) + "\n"


def renew_table(path, table):
    """Puts the table between the two marks of a document."""
    first, last = "<!-- errors: samples/gallery/make.py --docs -->\n", "<!-- end of errors -->\n"
    text = path.read_text()
    before, rest = text.split(first)
    path.write_text(before + first + "\n" + table + "\n" + last + rest.split(last)[1])


def main():
    for_docs = sys.argv[1:] == ["--docs"]
    with tempfile.TemporaryDirectory() as name:
        scratch = Path(name)
        meshes = make_meshes(scratch)
        if for_docs and len(meshes) < 2:
            sys.exit("make.py: --docs needs the reactor's mesh too")
        if for_docs:
            folder = DOCS / "gallery"
        else:
            folder = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build/gallery"
        make_pictures(meshes, folder, SMALL if for_docs else None)
        table = error_table(meshes, scratch)
        print(table)
        if for_docs:
            renew_table(DOCS / "gallery.md", table)
        else:
            (folder / "errors.md").write_text(table)


if __name__ == "__main__":
    main()
