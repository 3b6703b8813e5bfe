#!/usr/bin/env python3
"""Tools that read no foreign format link no VTK, CGAL, METIS or OpenGL and start in under 50 ms.

Usage: start_up_test.py TOOL... Measures `TOOL --version`: the processor time of the fastest of some
runs, after one that brings the files into memory; nothing waits then but for other programs.
HIAC_START_UP_FACTOR (default 1) multiplies the limit.
"""
import os
import re
import resource
import subprocess
import sys

LIMIT_SECONDS = 0.050
RUNS = 15


def linked_libraries(tool):
    text = subprocess.run(["ldd", tool], check=True, capture_output=True, text=True).stdout
    return [line.split()[0] for line in text.splitlines() if line.split()]


def start_seconds(tool):
    times = []
    for _ in range(RUNS + 1):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([tool, "--version"], check=True, stdout=subprocess.DEVNULL)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        times.append(after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime)
    return min(times[1:])


def main():
    limit = LIMIT_SECONDS * float(os.environ.get("HIAC_START_UP_FACTOR", "1"))
    failed = False
    for tool in sys.argv[1:]:
        name = os.path.basename(tool)
        foreign = [lib for lib in linked_libraries(tool)
                   if re.search(r"vtk|cgal|metis|libepoxy|libE?GL|libmpi", lib, re.I)]
        seconds = start_seconds(tool)
        print(f"{name}: starts in {1000 * seconds:.1f} ms (limit {1000 * limit:.0f} ms)")
        if foreign:
            print(f"{name} links {', '.join(foreign)}")
        failed = failed or bool(foreign) or seconds >= limit
    sys.exit(1 if failed or len(sys.argv) < 2 else 0)


main()
