#!/usr/bin/env python3
"""A measure of the tests: small defects, put into the code one at a time, and what notices them.

    tests/mutate.py --count 10 --seed 3                  # ten places anywhere
    tests/mutate.py --count 5 --files 'lib/hiac/order/*' # five places of a room
    tests/mutate.py --list --files formats/medit/*       # the places, and what is done to each

Works on a copy of the tree (--work, build/mutants), which it configures once: a defect is put in, the
test executables of its room are built and run (tests/ROOM for lib/hiac/ROOM, tests/formats,
tests/tools), and where none fails those of all other rooms, unless --room-only is given. A defect that
no test notices is printed as SURVIVED, but for the places in tests/mutate.equivalent, where the
program behaves as before. The same seed gives the same defects in the same sources.

Exit status: 0 nothing survived, 1 something did, 2 wrong usage, 4 the tests fail without a defect.
"""
import argparse
import collections
import fnmatch
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import time

SOURCE = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = ("lib/hiac", "formats", "tools")
SUFFIXES = (".cpp", ".hpp")

Place = collections.namedtuple("Place", "path line start end kind before after")

NUMBER = r"(?<![\w.])(?:0x[0-9a-f.]+p[+-]?\d+|\d+\.\d*(?:e[+-]?\d+)?|\d+e[+-]?\d+|\d+)(?![\w.])"
NAME = r"[A-Za-z_]\w*(?:\.\w+|->\w+|\[\w+\])*"


def swapped(first, second):
    return lambda found: second if found.group() == first else first


def scaled_number(found):
    text = found.group()
    if text in ("0", "1"):
        return None  # lengths and ends: other operators are for these
    if re.fullmatch(r"\d+", text):
        return str(int(text) * 2)
    return f"(2 * {text})"


# What is done, by name: a pattern in code without comments and strings, and what it becomes.
OPERATORS = [
    ("comparison", r"(?<= )(?:<=|<)(?= )", swapped("<", "<=")),
    ("comparison", r"(?<= )(?:>=|>)(?= )", swapped(">", ">=")),
    ("comparison", r"(?<= )(?:==|!=)(?= )", swapped("==", "!=")),
    ("comparison turned", r"(?<= )[<>](?= )", swapped("<", ">")),
    ("sign", r"(?<=[\w)\]] )[+-](?= )", swapped("+", "-")),
    ("sign", r"(?<= )(?:\+=|-=)(?= )", swapped("+=", "-=")),
    ("sign dropped", r"(?<=[(,=] )-(?=\w)|(?<=\()-(?=\w)|(?<=return )-(?=\w)", lambda found: ""),
    ("quotient", r"(?<=[\w)\]] )[*/](?= )", swapped("*", "/")),
    ("logic", r"(?<= )(?:&&|\|\|)(?= )", swapped("&&", "||")),
    ("not dropped", r"(?<=[( ])!(?=[\w(])", lambda found: ""),
    ("extreme", r"\bstd::(?:ranges::)?(?:min|max)\b(?=[({])",
     lambda f: f.group().replace("min", "MAX").replace("max", "min").replace("MAX", "max")),
    ("constant doubled", NUMBER, scaled_number),
    ("term dropped", rf"(?<=[\w)\]]) [+-] (?:{NAME}|{NUMBER})(?=[;,)])", lambda found: ""),
    ("factor dropped", rf"(?<=[\w)\]]) \* (?:{NAME}|{NUMBER})(?=[;,)])", lambda found: ""),
    ("check dropped", r"^ *if \(.*\) (?:return\b.*|throw .*|continue|break);$", lambda found: ";"),
    ("statement dropped", rf"^ *{NAME}(?:\(.*\)| [-+*/]?= .*);$", lambda found: ";"),
    ("arguments swapped", rf"(?<=\w\()({NAME}), ({NAME})(?=[,)])",
     lambda f: None if f[1] == f[2] else f"{f[2]}, {f[1]}"),
]
OPERATORS = [(kind, re.compile(pattern), change) for kind, pattern, change in OPERATORS]
SKIPPED_LINE = re.compile(r"^\s*(?:#|template\b|static_assert\b|using\b|namespace\b|\}|//)")


def blanked(text):
    """The code with comments, strings and characters as blanks, every place as it was."""
    pattern = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:[^"\\\n]|\\.)*"'
                         r"|'(?:[^'\\\n]|\\.)+'", re.S)
    return pattern.sub(lambda f: re.sub(r"[^\n]", " ", f.group()), text)


def places_of(path, text):
    """All places of a file, one a defect."""
    for number, (code, line) in enumerate(zip(blanked(text).split("\n"), text.split("\n")), 1):
        if SKIPPED_LINE.match(code) or not code.strip():
            continue
        for kind, pattern, change in OPERATORS:
            for found in pattern.finditer(code):
                after = change(found)
                if after is not None and after != found.group():
                    yield Place(path, number, found.start(), found.end(), kind, line,
                                line[:found.start()] + after + line[found.end():])


def all_places(globs):
    places = []
    for folder in FOLDERS:
        for file in sorted((SOURCE / folder).rglob("*")):
            path = file.relative_to(SOURCE).as_posix()
            if file.suffix in SUFFIXES and any(fnmatch.fnmatch(path, g) for g in globs):
                places += places_of(path, file.read_text())
    return places


def equivalents():
    """(path, operator, the line without blanks at its ends) of every place that is listed."""
    known = set()
    file = SOURCE / "tests/mutate.equivalent"
    for number, line in enumerate(file.read_text().splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        parts = [part.strip() for part in line.split(" | ")]
        if len(parts) != 4 or not all(parts):
            sys.exit(f"{file}:{number}: PATH | OPERATOR | LINE | REASON expected")
        known.add(tuple(parts[:3]))
    return known


def room_of(path):
    parts = pathlib.PurePath(path).parts
    return parts[2] if parts[0] == "lib" else parts[0]


class Copy:
    """The copy of the tree, its build and its test executables by room."""

    def __init__(self, work, jobs, configuration, with_data):
        self.source, self.build, self.jobs = work / "source", work / "build", jobs
        self.environment = dict(os.environ)
        if not with_data:  # what everybody's tests notice
            self.environment["HIAC_DATA_DIR"] = str(work / "no-data")
        self.seconds = {}  # that a test executable takes
        self.sound = set()  # rooms whose tests pass without a defect
        self.update()
        launcher = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
        self.run(["cmake", "-S", self.source, "-B", self.build, "-G", "Ninja",
                  "-DCMAKE_BUILD_TYPE=Release", "-DHIAC_BENCHMARKS=OFF",
                  "-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON", *launcher, *configuration], check=True)
        listed = self.run(["ninja", "-C", self.build, "-t", "targets", "all"], check=True).stdout
        self.tests = collections.defaultdict(list)
        for target in re.findall(r"^(tests/[\w/]+_test): CXX_EXECUTABLE_LINKER", listed, re.M):
            self.tests[target.split("/")[1]].append(target)

    def update(self):
        """Files that differ are written: others keep their times, and are not built again."""
        tracked = subprocess.run(["git", "-C", SOURCE, "ls-files", "-z", "--cached", "--others",
                                  "--exclude-standard"], capture_output=True, check=True).stdout
        for name in filter(None, tracked.decode().split("\0")):
            source, copy = SOURCE / name, self.source / name
            if not source.is_file():
                continue
            if not copy.exists() or copy.read_bytes() != source.read_bytes():
                copy.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(source, copy)

    def run(self, command, check=False, timeout=None):
        result = subprocess.run([str(part) for part in command], capture_output=True, text=True,
                                errors="replace", timeout=timeout, env=self.environment)
        if check and result.returncode != 0:
            sys.exit(f"failed: {' '.join(map(str, command))}\n{result.stdout}{result.stderr}")
        return result

    def make(self, targets):
        return self.run(["ninja", "-C", self.build, f"-j{self.jobs}", *targets])

    def first_failure(self, target):
        """The name of a test that fails, or None."""
        limit = 30 + 4 * self.seconds.get(target, 600)
        begin = time.monotonic()
        try:
            result = self.run([self.build / target, "--gtest_brief=1", "--gtest_fail_fast"],
                              timeout=limit)
        except subprocess.TimeoutExpired:
            return f"{target} (not done after {limit:.0f} s)"
        self.seconds.setdefault(target, time.monotonic() - begin)
        if result.returncode == 0:
            return None
        failed = re.search(r"\[  FAILED  \] (\S+)", result.stdout)
        return failed.group(1) if failed else f"{target} (exit status {result.returncode})"

    def noticed_by(self, rooms):
        """Builds and runs the tests of rooms. None where the code does not compile, else the name
        of a test that fails, or an empty one."""
        for room in rooms:
            for target in self.tests[room]:
                built = self.make([target])
                if built.returncode != 0:
                    return None
                failure = self.first_failure(target)
                if failure:
                    return failure
        return ""


def try_place(copy, place, rooms):
    """noticed_by, with the defect in the copy."""
    file = copy.source / place.path
    whole = file.read_text()
    lines = whole.split("\n")
    lines[place.line - 1] = place.after
    try:
        file.write_text("\n".join(lines))
        return copy.noticed_by(rooms)
    finally:
        file.write_text(whole)


def require_sound(copy, rooms):
    """Ends the program where tests of these rooms fail without any defect."""
    for room in rooms:
        if room in copy.sound:
            continue
        failure = copy.noticed_by([room])
        if failure != "":
            print(f"without any defect: {failure or 'the code does not compile'}", file=sys.stderr)
            sys.exit(4)
        copy.sound.add(room)


def verdict_on(copy, place, room_only):
    """noticed_by, of the tests of the place's room and then of all others."""
    own = room_of(place.path)
    require_sound(copy, [own])
    verdict = try_place(copy, place, [own])
    if verdict != "" or room_only:
        return verdict
    rest = [room for room in sorted(copy.tests) if room != own]
    require_sound(copy, rest)
    return try_place(copy, place, rest)


def shown(place):
    return (f"{place.path}:{place.line}: {place.kind}\n    - {place.before.strip()}\n"
            f"    + {place.after.strip()}")


def arguments():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0],
                                     epilog=__doc__.split("\n\n", 1)[1],
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=10, help="defects that compile (default 10)")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--files", action="append", metavar="GLOB", help="only in these files")
    parser.add_argument("--kind", action="append", help="only these operators")
    parser.add_argument("--room-only", action="store_true", help="run the tests of the room alone")
    parser.add_argument("--data", action="store_true", help="with the folder of real files")
    parser.add_argument("--list", action="store_true", help="print the places and do nothing")
    parser.add_argument("--work", type=pathlib.Path, default=SOURCE / "build/mutants")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--configure", action="append", default=[], metavar="-DNAME=VALUE",
                        help="further arguments of cmake")
    return parser.parse_args()


def main():
    wanted = arguments()
    places = all_places(wanted.files or ["*"])
    if wanted.kind:
        places = [place for place in places if place.kind in wanted.kind]
    known = equivalents()
    places = [p for p in places if (p.path, p.kind, p.before.strip()) not in known]
    if not places:
        print("no such place", file=sys.stderr)
        sys.exit(2)
    if wanted.list:
        for place in places:
            print(shown(place))
        print(f"{len(places)} places")
        return
    random.Random(wanted.seed).shuffle(places)
    copy = Copy(wanted.work.resolve(), wanted.jobs, wanted.configure, wanted.data)
    noticed, survived, broken = 0, [], 0
    for place in places:
        if noticed + len(survived) == wanted.count:
            break
        verdict = verdict_on(copy, place, wanted.room_only)
        if verdict is None:
            broken += 1
            continue
        if verdict:
            noticed += 1
        else:
            survived.append(place)
        print(f"{shown(place)}\n    {'noticed by ' + verdict if verdict else 'SURVIVED'}", flush=True)
    print(f"{noticed} noticed, {len(survived)} survived, {broken} did not compile")
    sys.exit(1 if survived else 0)


if __name__ == "__main__":
    main()
