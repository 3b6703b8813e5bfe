#!/usr/bin/env python3
"""Runs the commands of the guide, from its own text: indented lines that start with `hiac`.

A page's commands run one after the other in a folder of the page's own, where the sample's mesh is
run.vtu and ParaView's state of it state.pvsm; each has to end with exit code 0 and to leave the files that it names as outputs. So the guide
tells nothing that does not work. Usage: guide_test.py GUIDE SAMPLE PROGRAM...
"""
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

OUTPUTS = ("-o", "--output", "--save-view", "--colorbar", "--json")


def commands(page):
    return [line.strip() for line in page.read_text().splitlines() if re.match(r" {4,}hiac", line)]


def missing_outputs(command, folder):
    """The files that the command names as outputs and that are not there; of a pattern, the first."""
    words = shlex.split(command.split("|")[-1])
    wanted = [words[k + 1] for k, word in enumerate(words[:-1]) if word in OUTPUTS]
    missing = []
    for name in wanted:
        pattern = re.sub(r"%0?\d*d", "*", name)
        if "hiac picture" not in command and not list(folder.glob(pattern)):
            missing.append(name)
    return missing


def run_page(page, sample, path):
    faults = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "run.vtu").write_bytes(sample.read_bytes())
        (folder / "state.pvsm").write_bytes((sample.parent / "state.pvsm").read_bytes())
        for command in commands(page):
            done = subprocess.run(["bash", "-o", "pipefail", "-c", command], cwd=folder, capture_output=True,
                                  errors="replace", env={**os.environ, "PATH": path}, check=False)
            if done.returncode != 0:
                faults.append(f"{page.name}: {command}\n  ends with {done.returncode}: {done.stderr.strip()}")
            for output in missing_outputs(command, folder):
                faults.append(f"{page.name}: {command}\n  leaves no {output}")
    return faults


def main():
    guide, sample, *programs = map(pathlib.Path, sys.argv[1:])
    path = os.pathsep.join([*{str(program.resolve().parent) for program in programs}, os.environ["PATH"]])
    pages = sorted(guide.glob("*.md"))
    faults = [fault for page in pages for fault in run_page(page, sample, path)]
    count = sum(len(commands(page)) for page in pages)
    # pages that have lost their commands would pass too
    if count < 3 * (len(pages) - 1):
        faults.append(f"only {count} commands in {len(pages)} pages")
    print(*faults, sep="\n")
    print(f"{count} commands, {len(faults)} faults")
    return 1 if faults else 0


sys.exit(main())
