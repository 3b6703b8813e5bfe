#!/usr/bin/env python3
"""What is installed belongs to exactly one component, and so to exactly one Debian package.

Installs everything, and every component by itself, and compares; asks of CPack's configuration that it
makes a package of every component, with a name, a section, a summary and a description as Debian wants
them; and of the files that name the version that they name that of the build.
Usage: components_test.py SOURCE_FOLDER BUILD_FOLDER WORK_FOLDER. Exit status 1 with a line for every fault.
"""
import pathlib
import re
import shutil
import subprocess
import sys

SECTIONS = {"science", "libs", "libdevel", "python"}
# where a file has to be, by its component
FOLDERS = {
    "development": r"^(include/hiac/|lib/([^/]+/)?(libhiac\.(a|so)$|cmake/hiac/)|share/doc/hiac/samples/program/)",
    "formats": r"^(include/hiac-formats/|lib/([^/]+/)?(libhiac_formats\.a$|cmake/hiac/hiacFormats))",
    "shared": r"^lib/([^/]+/)?libhiac\.so\.",
}


def install(build, prefix, *component):
    done = subprocess.run(["cmake", "--install", build, "--prefix", prefix, *component],
                          capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"cannot be installed: {done.stderr}")
    return {file.relative_to(prefix).as_posix() for file in prefix.rglob("*")
            if file.is_symlink() or not file.is_dir()} if prefix.exists() else set()


def cpack_variables(build):
    text = (build / "CPackConfig.cmake").read_text()
    return {name: value.replace("\\", "") for name, value in
            re.findall(r'^set\((CPACK_\w+) "((?:[^"\\]|\\.)*)"\)$', text, re.M)}


def component_faults(build, work, components):
    shutil.rmtree(work, ignore_errors=True)
    everything = install(build, work / "all")
    owners = {}
    for component in components:
        for file in install(build, work / component, "--component", component):
            owners.setdefault(file, []).append(component)
            if not re.search(FOLDERS.get(component, ""), file):
                yield f"{file}: is not where the component {component} puts its files"
    if len(everything) < 40:
        yield f"only {len(everything)} files are installed: is everything built?"
    for file in sorted(everything | owners.keys()):
        if len(owners.get(file, [])) != 1:
            yield f"{file}: one component expected, found {', '.join(owners.get(file, [])) or 'none'}"
    for program in sorted(file for file in everything if file.startswith("bin/")):
        page = f"share/man/man1/{program[4:]}.1"
        if owners.get(page) != owners.get(program):
            yield f"{page}: the component of {program} expected, found {owners.get(page, ['no such file'])}"


def package_faults(variables, components):
    names = {}
    for component in components:
        upper = component.upper()
        name = variables.get(f"CPACK_DEBIAN_{upper}_PACKAGE_NAME")
        if name is None:
            yield f"{component}: packaging/debian/packages.cmake has no package of this component"
            continue
        if name in names:
            yield f"{name}: is the package of {component} and of {names[name]}"
        names[name] = component
        if not re.fullmatch(r"[a-z0-9][a-z0-9+.-]+", name):
            yield f"{name}: is no name of a Debian package"
        section = variables.get(f"CPACK_DEBIAN_{upper}_PACKAGE_SECTION", variables["CPACK_DEBIAN_PACKAGE_SECTION"])
        if section not in SECTIONS or (section == "libdevel") != name.endswith("-dev"):
            yield f"{name}: is not in a section of its kind ({section})"
        summary, *text = variables[f"CPACK_DEBIAN_{upper}_DESCRIPTION"].split("\n")
        if not 10 < len(summary) <= 80 or re.match(r"(?i)(an?|the) ", summary) or summary.endswith("."):
            yield f"{name}: is no summary of a Debian package: {summary}"
        if "." not in text or any(len(line) > 79 for line in text):
            yield f"{name}: two paragraphs in lines of 79 characters expected as a description"
        for relation in ("DEPENDS", "RECOMMENDS", "SUGGESTS"):
            for item in filter(None, variables.get(f"CPACK_DEBIAN_{upper}_PACKAGE_{relation}", "").split(", ")):
                if not re.fullmatch(r"[a-z0-9][a-z0-9+.-]+( \((=|>=|<<) [\w.+-]+\))?", item):
                    yield f"{name}: {relation}: is no package with a version: {item}"


def version_faults(source, version):
    patterns = {"CHANGELOG.md": r"^## \[([\d.]+)\]", "CITATION.cff": r"^version: ([\d.]+)$",
                "docs/versioning.md": r"version is ([\d.]+\d)",
                # where the module of Python names a number of its own
                "pyproject.toml": r'^version = "([^"]+)"'}
    for name, pattern in patterns.items():
        file = source / name
        found = re.search(pattern, file.read_text(), re.M) if file.exists() else None
        if found and found[1] != version:
            yield f"{name}: version {version} expected, {found[1]} found"
        elif not found and name != "pyproject.toml":
            yield f"{name}: names no version"


def main():
    source, build, work = map(pathlib.Path, sys.argv[1:])
    variables = cpack_variables(build)
    components = variables["CPACK_COMPONENTS_ALL"].split(";")
    faults = [*component_faults(build, work, components), *package_faults(variables, components),
              *version_faults(source, variables["CPACK_PACKAGE_VERSION"])]
    print(*faults, sep="\n")
    print(f"{len(components)} components, {len(faults)} faults")
    sys.exit(1 if faults else 0)


main()
