#!/usr/bin/env python3
"""Which tests execute which functions of the product, and which functions no test executes.

    tests/coverage.py            # builds, runs every test executable, prints what none of them executes
    tests/coverage.py --lines    # the lines of the other functions too, as gcov counts them

Builds the tree in --work (build/coverage) with counters (gcc's --coverage) and runs the test
executables, without the folder of real files, each with counts of its own. Those that have run are not
run again until the build changes. What is found is written to --work/functions.json, from which
tests/mutate.py --functions learns which tests could notice a defect.
"""
import argparse
import collections
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import shutil
import struct
import subprocess

SOURCE = pathlib.Path(__file__).resolve().parent.parent

# Linked to every executable, since counts would be lost of a process that ends by _exit, and of one that
# reads files for another and is killed when it has answered.
KEEPER = """#include <sys/socket.h>
#include <unistd.h>
void __gcov_dump(void);
void __gcov_reset(void);
void __real__exit(int) __attribute__((noreturn));
ssize_t __real_send(int, const void *, size_t, int);
static pid_t first;
__attribute__((constructor)) static void begin(void) { first = getpid(); }
void __wrap__exit(int code) {
  __gcov_dump();
  __real__exit(code);
}
ssize_t __wrap_send(int to, const void *data, size_t size, int flags) {
  if (getpid() != first) {
    __gcov_dump();
    __gcov_reset();
  }
  return __real_send(to, data, size, flags);
}
"""

# gcc's files of counters (gcc/gcov-io.h): words of 32 bits; a record is a tag, a length in bytes and data
FUNCTION, ARCS = 0x01000000, 0x01A10000
Function = collections.namedtuple("Function", "path first last name")


def records(data, start):
    """(tag, length, place of the data) of every record. A length below 0 stands for that many zeros,
    which are not in the file. The file of a process that was killed may end within a record."""
    place = start
    while place + 8 <= len(data):
        tag, length = struct.unpack_from("<Ii", data, place)
        if tag == 0 or place + 8 + length > len(data):
            return
        yield tag, length, place + 8
        place += 8 + max(length, 0)


def text_at(data, place):
    """A string and the place behind it."""
    (length,) = struct.unpack_from("<I", data, place)
    return data[place + 4:place + 4 + length].rstrip(b"\0").decode(), place + 4 + length


def functions_of(notes, source):
    """The functions of the tree in a .gcno file, by their numbers."""
    data = notes.read_bytes()
    folder, place = text_at(data, 16)
    found = {}
    for tag, _, place in records(data, place + 4):
        if tag != FUNCTION:
            continue
        (number,) = struct.unpack_from("<I", data, place)
        name, end = text_at(data, place + 12)
        path, end = text_at(data, end + 4)
        first, _, last, _ = struct.unpack_from("<4I", data, end)
        path = os.path.relpath(os.path.join(folder, path), source)
        if path.startswith(("lib/", "formats/", "tools/")):
            found[number] = Function(path, first, last, name)
    return found


def counts_of(counters):
    """The counts of each function of a .gcda file that has any but zeros, by its number."""
    data = counters.read_bytes()
    number, found = None, {}
    for tag, length, place in records(data, 16):
        if tag == FUNCTION:
            number = struct.unpack_from("<I", data, place)[0] if length else None
        elif tag == ARCS and length > 0:
            found[number] = struct.unpack_from(f"<{length // 8}Q", data, place)
    return found


def write_sums(parts, path):
    """Writes a .gcda file with the sums of the counts of others, all of one build."""
    sums = {}
    for part in parts:
        for number, counts in counts_of(part).items():
            known = sums.get(number)
            sums[number] = counts if known is None else [a + b for a, b in zip(known, counts)]
    data = parts[0].read_bytes()
    number, written = None, data[:16]
    for tag, length, place in records(data, 16):
        if tag == FUNCTION:
            number = struct.unpack_from("<I", data, place)[0] if length else None
        if tag == ARCS and number in sums:
            counts = sums[number]
            written += struct.pack(f"<Ii{len(counts)}Q", tag, 8 * len(counts), *counts)
        else:
            written += data[place - 8:place + max(length, 0)]
    path.write_bytes(written + bytes(4))


class CountingBuild:
    """The build with counters and what its test executables have counted."""

    def __init__(self, work, jobs, configuration):
        self.work, self.build, self.jobs = work, work / "build", jobs
        work.mkdir(parents=True, exist_ok=True)
        keeper = work / "keeper.c"
        keeper.write_text(KEEPER)
        self.run(["gcc", "-fPIC", "-c", keeper, "-o", work / "keeper.o"])
        launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
        self.run(["cmake", "-S", SOURCE, "-B", self.build, "-G", "Ninja",
                  "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG --coverage",
                  f"-DCMAKE_EXE_LINKER_FLAGS=--coverage {work / 'keeper.o'} -Wl,--wrap=_exit,--wrap=send",
                  "-DHIAC_UNITY=ON", "-DHIAC_BENCHMARKS=OFF", *launcher, *configuration])
        self.run(["cmake", "--build", self.build, "-j", jobs])
        listed = self.run(["ninja", "-C", self.build, "-t", "targets", "all"])
        self.tests = re.findall(r"^(tests/[\w/]+_test): CXX_EXECUTABLE_LINKER", listed, re.M)

    @staticmethod
    def run(command):
        result = subprocess.run([str(part) for part in command], capture_output=True, text=True)
        if result.returncode != 0:
            raise SystemExit(f"failed: {' '.join(map(str, command))}\n{result.stdout}{result.stderr}")
        return result.stdout

    def counters(self, test):
        """The .gcda files of a test executable, by the path of the object file without its end."""
        folder = self.work / "counts" / test
        return {str(file)[len(str(folder)):-len(".gcda")]: file for file in folder.rglob("*.gcda")}

    def count(self, test):
        folder, done = self.work / "counts" / test, self.work / "counts" / (test + ".done")
        program = self.build / test
        if done.exists() and done.stat().st_mtime > program.stat().st_mtime:
            return
        shutil.rmtree(folder, ignore_errors=True)
        environment = dict(os.environ, GCOV_PREFIX=str(folder), HIAC_DATA_DIR=str(self.work / "no-data"))
        ended = subprocess.run([program, "--gtest_brief=1"], env=environment, cwd=self.work,
                               capture_output=True)
        print(f"{test}: exit status {ended.returncode}", flush=True)
        folder.mkdir(parents=True, exist_ok=True)
        done.touch()

    def count_all(self):
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            list(pool.map(self.count, self.tests))


def executed_by(build):
    """The test executables that execute it, of every function of the product."""
    notes = {str(file)[:-len(".gcno")]: functions_of(file, SOURCE) for file in build.build.rglob("*.gcno")}
    tests = {function: set() for functions in notes.values() for function in functions.values()}
    for test in build.tests:
        for stem, file in build.counters(test).items():
            functions = notes.get(stem, {})
            for number, counts in counts_of(file).items():
                if number in functions and any(counts):
                    tests[functions[number]].add(test)
    return tests


def by_place(tests):
    """The same for each (path, first line, last line): instances of a template share theirs."""
    places = collections.defaultdict(set)
    for function, names in tests.items():
        places[function.path, function.first, function.last] |= names
    return places


def lines_not_executed(build):
    """(path, line) of each line of which no test executes anything."""
    parts = collections.defaultdict(list)
    for test in build.tests:
        for stem, file in build.counters(test).items():
            parts[stem].append(file)
    most = collections.Counter()
    for stem, files in parts.items():
        counters = pathlib.Path(stem + ".gcda")
        write_sums(files, counters)
        report = subprocess.run(["gcov", "--json-format", "--stdout", counters], cwd=counters.parent,
                                capture_output=True, text=True, check=True).stdout
        for file in json.loads(report)["files"]:
            path = os.path.relpath(os.path.join(build.build, file["file"]), SOURCE)
            if path.startswith(("lib/", "formats/", "tools/")):
                for line in file["lines"]:
                    place = path, line["line_number"]
                    most[place] = max(most[place], line["count"])
    return sorted(place for place, count in most.items() if count == 0)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0],
                                     epilog=__doc__.split("\n\n", 1)[1],
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--work", type=pathlib.Path, default=SOURCE / "build/coverage")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--lines", action="store_true", help="print lines, not functions alone")
    parser.add_argument("--configure", action="append", default=[], metavar="-DNAME=VALUE",
                        help="further arguments of cmake")
    wanted = parser.parse_args()
    build = CountingBuild(wanted.work.resolve(), wanted.jobs, wanted.configure)
    build.count_all()
    places = by_place(executed_by(build))
    hashes = {path: hashlib.sha256((SOURCE / path).read_bytes()).hexdigest()
              for path in sorted({place[0] for place in places})}
    (build.work / "functions.json").write_text(json.dumps({
        "sha256": hashes,
        "tests": build.tests,
        "functions": [[*place, sorted(tests)] for place, tests in sorted(places.items())]}))
    if wanted.lines:
        for path, line in lines_not_executed(build):
            print(f"{path}:{line}: {(SOURCE / path).read_text().splitlines()[line - 1].strip()}")
    else:
        for (path, first, last), tests in sorted(places.items()):
            if not tests:
                print(f"{path}:{first}-{last}")


if __name__ == "__main__":
    main()
