#!/usr/bin/env python3
"""Every C++ file is as clang-format would write it.

Usage: format_test.py SOURCE_FOLDER. Exit status 77 (skipped) where there is no clang-format.
"""
import pathlib
import shutil
import subprocess
import sys


def main():
    source = pathlib.Path(sys.argv[1])
    formatter = shutil.which("clang-format")
    if formatter is None:
        print("SKIPPED: clang-format is not installed")
        sys.exit(77)
    files = [str(file) for folder in ("include", "lib", "formats", "tools", "python", "tests")
             for file in sorted((source / folder).rglob("*.[ch]pp"))]
    if not files:
        sys.exit("no file found: is this the source folder?")
    result = subprocess.run([formatter, "--dry-run", "-Werror", "--ferror-limit=1", *files])
    print(f"{len(files)} files looked at")
    sys.exit(1 if result.returncode else 0)


main()
