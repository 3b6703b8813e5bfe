#!/usr/bin/env python3
"""The script behind docs/peers.md draws a scene with hiac and with VTK and judges VTK's pictures.

Usage: peers_test.py SOURCE_FOLDER BUILD_FOLDER SCRATCH_FOLDER. Exit status 77 (skipped), with the
reason, without a screen in memory, VTK for Python or numpy.
"""
import os
import pathlib
import shutil
import subprocess
import sys

SYSTEM_PYTHON = "/usr/bin/python3"  # the one that Debian's modules are for
MODULES = "numpy, vtkmodules.vtkRenderingVolumeOpenGL2"


def missing():
    """What is not there of what the script needs; empty if all is."""
    if shutil.which("xvfb-run") is None or shutil.which("xauth") is None:
        return "xvfb and xauth"
    found = subprocess.run([SYSTEM_PYTHON, "-c", f"import {MODULES}"], capture_output=True)
    return "" if found.returncode == 0 else f"Python's modules {MODULES}"


def figures(table):
    """Mapper: largest error, RMS error, PSNR, FLIP, the shift as text, the truth's bound."""
    rows = [line.strip("| ").split(" | ") for line in table.splitlines()[2:] if line]
    return {row[1]: (float(row[2]), float(row[3]), row[6], float(row[7])) for row in rows}


def faults(found):
    if sorted(found) != ["projected tetrahedra", "ray cast", "ray cast, tuned", "z-sweep"]:
        yield f"four mappers expected, {sorted(found)} found"
        return
    for mapper, (largest, rms, _, truth) in found.items():
        # 8 bits alone leave 1e-4; a picture of something else has an RMS error of more than 0.1
        if not 1e-4 < rms < 0.02 or not rms < largest:
            yield f"{mapper}: RMS error {rms}, largest {largest}"
        if not 0 < truth < 1e-9:
            yield f"{mapper}: the truth is exact to {truth}"
    right, down = (float(word) for word in found["ray cast"][2].split(", ")[:2])
    if abs(right - 0.5) > 0.2 or abs(down + 0.5) > 0.2:
        yield f"ray cast: half a pixel right and up expected, {right}, {down} found"
    if not found["ray cast, tuned"][1] < 0.7 * found["ray cast"][1]:
        yield "the tuned ray cast is not better than the ray cast"


def main():
    source, build, scratch = (pathlib.Path(argument) for argument in sys.argv[1:4])
    if lack := missing():
        print(f"peers_test: skipped, as there is no {lack}")
        return 77
    shutil.rmtree(scratch, ignore_errors=True)
    command = [SYSTEM_PYTHON, source / "samples/peers/make.py", "--only", "plain", scratch]
    subprocess.run(command, check=True, timeout=300,
                   env=os.environ | {"HIAC_BUILD_DIR": str(build)})
    picture = scratch / "plain.png"
    found = list(faults(figures((scratch / "figures.md").read_text())))
    if not picture.read_bytes().startswith(b"\x89PNG"):
        found.append("no montage")
    for fault in found:
        print(f"peers_test: {fault}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
