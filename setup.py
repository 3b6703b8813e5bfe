"""pip install .: builds the Python package hiac by the CMake files (docs/python.md)."""
import pathlib
import re

from skbuild import setup

VERSION = re.search(r"project\(hiac VERSION ([\d.]+)", pathlib.Path("CMakeLists.txt").read_text())[1]

setup(
    name="hiac",
    version=VERSION,
    description="Reference volume renderer for unstructured finite-element data",
    license="BSD-3-Clause",
    python_requires=">=3.11",
    install_requires=["numpy"],
    extras_require={"notebook": ["ipywidgets"], "exchange": ["vtk", "meshio"]},
    packages=["hiac"],
    package_dir={"hiac": "python/hiac"},
    package_data={"hiac": ["py.typed", "*.pyi"]},
    include_package_data=False,
    cmake_install_dir="python",
    cmake_args=["-DHIAC_TESTS=OFF", "-DHIAC_BENCHMARKS=OFF", "-DHIAC_VIEW=OFF",
                "-DHIAC_TETRAHEDRALIZE=OFF"],
    # the package alone: not the tools' programs, headers and libraries
    cmake_install_target="install-python",
)
