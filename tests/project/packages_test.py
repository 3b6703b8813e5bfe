#!/usr/bin/env python3
"""The list of Debian packages (.ci/packages) is complete, and what it lists is installed.

Looks up which package owns every foreign header that our sources include, every pkg-config module
and every CMake package that our CMake files ask for. Usage: packages_test.py SOURCE_FOLDER
BUILD_FOLDER. Exit status 77 (skipped) where there is no dpkg, 1 with a line for every fault.
"""
import pathlib
import re
import shutil
import subprocess
import sys

# g++ brings these; no line of the list names them
FROM_COMPILER = re.compile(r"^(libstdc\+\+-\d+-dev|libc6-dev|linux-libc-dev|libgcc-\d+-dev)$")
INCLUDE = re.compile(r"^\s*#\s*include\s*<([^>]+)>", re.M)
MODULES = re.compile(r"pkg_check_modules\(\s*\w+\s+([^)]*)\)")
PACKAGES = re.compile(r"find_package\(\s*(\w+)")
KEYWORDS = {"REQUIRED", "QUIET", "IMPORTED_TARGET", "GLOBAL"}


def listed_packages(source):
    lines = (source / ".ci" / "packages").read_text().splitlines()
    return {line.strip() for line in lines if line.strip() and not line.startswith("#")}


def is_installed(package):
    query = ["dpkg-query", "-W", "-f", "${db:Status-Status}", package]
    return subprocess.run(query, capture_output=True, text=True).stdout == "installed"


def owners(paths):
    """The package that each file came with, for those that came with one."""
    names = {name: path for path in paths for name in (str(path), str(path.resolve()))}
    answer = subprocess.run(["dpkg", "-S", *names], capture_output=True, text=True).stdout
    found = {}
    for line in answer.splitlines():
        packages, _, name = line.rpartition(": ")
        if name in names:
            found[names[name]] = packages.split(",")[0].split(":")[0]
    return found


def include_folders():
    root = pathlib.Path("/usr/include")
    multiarch = subprocess.run(["g++", "-print-multiarch"], capture_output=True, text=True)
    folders = [root, root / multiarch.stdout.strip()]
    return folders + sorted(folder for folder in root.iterdir() if folder.is_dir())


def used_headers(source):
    headers = {}
    for folder in ("include", "lib", "formats", "tools", "python", "tests"):
        for file in sorted((source / folder).rglob("*.[ch]pp")):
            for header in INCLUDE.findall(file.read_text()):
                headers.setdefault(header, file.relative_to(source))
    return headers


def used_by_sources(source):
    """(what includes it, the header as written, its file) of every foreign header."""
    folders = include_folders()
    for header, file in used_headers(source).items():
        if "." not in header and "/" not in header:
            continue  # the C++ standard library
        path = next((f / header for f in folders if (f / header).is_file()), None)
        if path is not None:  # else the compiler's own
            yield file, f"<{header}>", path


def cmake_texts(source):
    for file in sorted(source.rglob("CMakeLists.txt")):
        if not file.relative_to(source).parts[0].startswith(("build", ".")):
            yield file.relative_to(source), file.read_text()


def module_file(module):
    for folder in ("/usr/lib", "/usr/share"):
        for pattern in (f"*/pkgconfig/{module}.pc", f"pkgconfig/{module}.pc"):
            for file in pathlib.Path(folder).glob(pattern):
                return file
    return None


def used_by_build(source, build):
    """(what asks for it, its name, its file) of every pkg-config module and CMake package."""
    cache = (build / "CMakeCache.txt").read_text()
    for file, text in cmake_texts(source):
        for words in MODULES.findall(text):
            for module in set(words.split()) - KEYWORDS:
                yield file, module, module_file(module)
        for name in PACKAGES.findall(text):
            folder = re.search(rf"^{name}_DIR:PATH=(/.*)$", cache, re.M)
            if folder:  # found through a file of the package itself, not by one of CMake's modules
                yield file, name, next(pathlib.Path(folder[1]).glob("*[cC]onfig.cmake"), None)


def unlisted(uses, listed):
    found = owners({path for _, _, path in uses if path is not None})
    for file, name, path in uses:
        package = found.get(path)
        if package and package not in listed and not FROM_COMPILER.match(package):
            yield f"{file}: {name} is of {package}, which .ci/packages does not list"


def main():
    source, build = (pathlib.Path(argument).resolve() for argument in sys.argv[1:3])
    if shutil.which("dpkg-query") is None:
        print("SKIPPED: no dpkg here, so nothing tells which package a file is of")
        sys.exit(77)
    listed = listed_packages(source)
    faults = [f"{package} is listed and not installed (.ci/install does that)"
              for package in sorted(listed) if not is_installed(package)]
    uses = list(used_by_sources(source)) + list(used_by_build(source, build))
    faults += unlisted(uses, listed)
    print("\n".join(faults + [f"{len(listed)} packages listed, {len(uses)} uses, {len(faults)} faults"]))
    sys.exit(1 if faults else 0)


main()
