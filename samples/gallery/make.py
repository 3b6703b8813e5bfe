#!/usr/bin/python3
"""Makes the pictures and the table of docs/gallery.md again.

    samples/gallery/make.py [FOLDER]        pictures and errors.md into FOLDER (build/gallery)
    samples/gallery/make.py --docs          the pictures and the table of docs/gallery.md

    HIAC_BUILD_DIR   where hiac is built (build/release): hiac-convert, hiac-render, hiac-preview,
                     hiac-compare

Needs python3-numpy, for the mesh that vortices.py makes.
"""
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))
from programs import ROOT, compare, renew_table, run  # noqa: E402

DOCS = ROOT / "docs"
SMALL = "400x300"  # the size of the pictures in docs/gallery

EXACT, GAUSS5 = "exact", "gauss5"
APPROXIMATE, UNSLICED = "approximate", "approximate-unsliced"
SPLATTED = "render.splat_below=2"

BESIDE = "camera.eye=[-2.4, -3.2, 2.0]"
ANNOTATED = ['annotation.title.text="Coolant in a hot pool"', 'annotation.colorbar.label="speed (m/s)"',
             "annotation.axes.show=true", 'annotation.scale.unit="m"', "annotation.text_size=0.045",
             "annotation.title.size=0.06"]

# figure of the paper, or another picture: mesh, specification, settings that change the specification
FIGURES = {
    "figure-07": ("pool", "pool", [f"render.integration={EXACT}"]),
    "figure-08": ("pool-corners", "pool", [f"render.integration={EXACT}"]),
    "figure-09": ("pool-corners", "pool", [f"render.integration={APPROXIMATE}"]),
    "figure-10": ("pool-corners", "pool", [f"render.integration={UNSLICED}"]),
    "figure-12": ("pool", "pool-surfaces", [f"render.integration={EXACT}"]),
    "figure-13": ("pool", "pool-surfaces", [f"render.integration={EXACT}", BESIDE]),
    "figure-14": ("pool-corners", "pool-surfaces", [f"render.integration={EXACT}"]),
    "skin": ("pool", "pool-skin", []),
    "annotated": ("pool", "pool", [f"render.integration={EXACT}", *ANNOTATED]),
    "figure-15": ("vortices", "vortices", [f"render.integration={EXACT}", SPLATTED]),
    "figure-16": ("vortices", "vortices", [f"render.integration={APPROXIMATE}"]),
}
# the same by graphics hardware: mesh, specification, method
PREVIEWS = {"figure-11": ("pool-corners", "pool", "M3")}
# mesh: its specification
VIEWS = {"pool": "pool", "pool-corners": "pool", "vortices": "vortices"}


def make_meshes(folder):
    """Makes the meshes in the folder and returns their files by name."""
    flow = ROOT / "samples/reactor-pool/flow.vtu"
    vortices = folder / "vortices.vtk"
    subprocess.run([sys.executable, HERE / "vortices.py", vortices], check=True)
    meshes = {name: folder / f"{name}.zoo" for name in VIEWS}
    run("convert", flow, "-o", meshes["pool"])
    run("convert", flow, "--corners-only", "-o", meshes["pool-corners"])
    run("convert", vortices, "-o", meshes["vortices"])
    return meshes


def render(mesh, view, settings, output, *arguments):
    sets = [argument for setting in settings for argument in ("--set", setting)]
    run("render", mesh, "--view", HERE / f"{view}.toml", *sets, "-o", output, *arguments)


def preview(mesh, view, method, output, *arguments):
    run("preview", mesh, "--view", HERE / f"{view}.toml", "--method", method, "-o", output,
        *arguments)


def make_pictures(meshes, folder, size):
    folder.mkdir(parents=True, exist_ok=True)
    for name, (mesh, view, settings) in FIGURES.items():
        arguments = ["--size", size] if size else []
        render(meshes[mesh], view, settings, folder / f"{name}.png", *arguments)
        print(f"made {folder / name}.png")
    for name, (mesh, view, method) in PREVIEWS.items():
        arguments = ["--size", size] if size else []
        preview(meshes[mesh], view, method, folder / f"{name}.png", *arguments)
        print(f"made {folder / name}.png")


def difference(image, reference):
    """The table's columns for two images: errors over red, green, blue; PSNR, SSIM, mean FLIP."""
    facts, largest, rmse = compare(image, reference)
    return (f"{largest:.1e} | {rmse:.1e} | {facts['psnr']:.1f} | {facts['ssim']:.4f} | "
            f"{facts['flip']['mean']:.4f} |")


HEAD = ("| picture | compared with | largest error | RMS error | PSNR (dB) | SSIM | mean FLIP |\n"
        "|---|---|---|---|---|---|---|")


def node_rows(meshes, folder):
    """The paper's comparison of quadratic cells with linear cells between their corners."""
    for view in ("pool", "pool-surfaces"):
        quadratic, linear = folder / "quadratic.npy", folder / "linear.npy"
        render(meshes["pool"], view, [f"render.integration={EXACT}"], quadratic)
        render(meshes["pool-corners"], view, [f"render.integration={EXACT}"], linear)
        yield f"| {view}, corners only | quadratic cells | " + difference(linear, quadratic)


def integration_rows(meshes, folder):
    """The paper's comparison of methods: each with the exact integral along the same rays."""
    for name, view in VIEWS.items():
        exact = folder / f"{name}-exact.npy"
        render(meshes[name], view, [f"render.integration={EXACT}"], exact)
        for method in (GAUSS5, APPROXIMATE, UNSLICED):
            image = folder / f"{name}-{method}.npy"
            render(meshes[name], view, [f"render.integration={method}"], image)
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
    rows = [*node_rows(meshes, folder), *integration_rows(meshes, folder),
            *splatting_rows(meshes, folder)]
    return "\n".join([HEAD, *rows]) + "\n"


def main():
    for_docs = sys.argv[1:] == ["--docs"]
    with tempfile.TemporaryDirectory() as name:
        scratch = Path(name)
        meshes = make_meshes(scratch)
        if for_docs:
            folder = DOCS / "gallery"
        else:
            folder = Path(sys.argv[1]) if len(sys.argv) > 1 else ROOT / "build/gallery"
        make_pictures(meshes, folder, SMALL if for_docs else None)
        table = error_table(meshes, scratch)
        print(table)
        if for_docs:
            renew_table(DOCS / "gallery.md", "errors", "samples/gallery/make.py", table)
        else:
            (folder / "errors.md").write_text(table)


if __name__ == "__main__":
    main()
