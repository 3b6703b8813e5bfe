#!/usr/bin/env python3
"""Man pages and completions hold every option of --help, and shells and groff can read them.

Usage: manual_test.py make_manual.py PROGRAM..., hiac, hiac-convert and hiac-render among them.
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile


def run(*words, **more):
    return subprocess.run(words, check=True, capture_output=True, text=True, **more).stdout


def options_of(program):
    """By another way than the generator's: whatever looks like an option where a line begins."""
    found = set()
    for line in run(program, "--help").splitlines():
        if head := re.match(r"  ((?:-\w,)?--[\w-]+(?:,--[\w-]+)*)", line):
            found.update(name for name in head[1].split(",") if name.startswith("--"))
    return found


def completed(completions, *words):
    """What bash offers for the last of the words."""
    script = ('. "$1/$2"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); '
              '"_${1//-/_}"; printf "%s\\n" "${COMPREPLY[@]}"')
    return run("bash", "-c", script, "bash", str(completions), *words).split()


def faults_of(share, programs):
    for program in programs:
        name = pathlib.Path(program).name
        page = (share / f"man/man1/{name}.1").read_text().replace("\\-", "-")
        bash = (share / f"bash-completion/completions/{name}").read_text()
        zsh = (share / f"zsh/site-functions/_{name}").read_text()
        fish = (share / f"fish/vendor_completions.d/{name}.fish").read_text()
        for option in options_of(program):
            for kind, text, form in (("man page", page, option + "\\fR"), ("bash", bash, option),
                                     ("zsh", zsh, f"*{option}["), ("fish", fish, f"-l {option[2:]} ")):
                if form not in text:
                    yield f"{name}: the {kind} does not hold {option}"
        if shutil.which("groff"):
            warnings = subprocess.run(["groff", "-man", "-ww", "-Tascii", "-z", share / f"man/man1/{name}.1"],
                                      capture_output=True, text=True, check=False).stderr
            if warnings:
                yield f"{name}: groff complains: {warnings}"
        run("bash", "-n", str(share / f"bash-completion/completions/{name}"))
    completions = share / "bash-completion/completions"
    for words, offered in ((("hiac-render", "--eng"), ["--engine"]),
                           (("hiac-render", "--engine", "p"), ["preview"]),
                           (("hiac", "conv"), ["convert"]),
                           (("hiac", "render", "--save"), ["--save-view"])):
        if completed(completions, *words) != offered:
            yield f"bash completes {words} to {completed(completions, *words)}, not to {offered}"


def main():
    generator, *programs = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        run(sys.executable, generator, folder, *programs)
        faults = list(faults_of(pathlib.Path(folder) / "share", programs))
    print(*faults, sep="\n")
    print(f"{sum(len(options_of(program)) for program in programs)} options, {len(faults)} faults")
    return 1 if faults else 0


sys.exit(main())
