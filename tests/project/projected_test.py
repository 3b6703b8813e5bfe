#!/usr/bin/env python3
"""The script behind a table of docs/preview-methods.md: M1's errors are no larger than those of VTK's
projected tetrahedra, which it draws as they are.

Usage: projected_test.py SOURCE_FOLDER BUILD_FOLDER. Exit status 77 (skipped), with the reason, without
a screen in memory, VTK for Python, numpy or an OpenGL driver.
"""
import os
import pathlib
import subprocess
import sys

from peers_test import SYSTEM_PYTHON, missing

VIEWS = ["parallel", "perspective", "eye close", "along an axis", "ramp", "thin"]


def faults(lines):
    rows = [line.strip("| ").split(" | ") for line in lines]
    if [row[0] for row in rows] != VIEWS:
        yield f"{VIEWS} expected, {lines} found"
        return
    for view, _, *cells in rows:
        vtk, m1, exact = (tuple(map(float, cell.split(" / "))) for cell in cells)
        # of something else the error is larger, and the bytes of a window leave more than 1e-4
        if not 1e-6 < vtk[1] < 0.08 or (view == "thin" and vtk[1] > 1e-4):
            yield f"{view}: VTK's RMS error is {vtk[1]}"
        if not (m1[0] <= vtk[0] and m1[1] <= vtk[1]):
            yield f"{view}: errors of M1 {m1}, of VTK {vtk}"
        if not (exact[0] < 2e-5 and exact[1] < 1e-6):
            yield f"{view}: errors of exact {exact}"


def main():
    source, build = (pathlib.Path(argument) for argument in sys.argv[1:3])
    if lack := missing():
        print(f"projected_test: skipped, as there is no {lack}")
        return 77
    if subprocess.run([build / "tools/preview/hiac-preview", "--list-devices"],
                      capture_output=True).returncode == 4:
        print("projected_test: skipped, as there is no OpenGL driver")
        return 77
    command = [SYSTEM_PYTHON, source / "samples/peers/projected.py", "--side", "120",
               "--only", "cubes in sixes", "--views", ";".join(VIEWS)]
    done = subprocess.run(command, stdout=subprocess.PIPE, text=True, timeout=300,
                          env=os.environ | {"HIAC_BUILD_DIR": str(build)})
    found = list(faults(done.stdout.splitlines()))
    if done.returncode != 0:
        found.append(f"the script ended with {done.returncode}")
    for fault in found:
        print(f"projected_test: {fault}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
