#!/usr/bin/env python3
"""A measure of the tests: small defects, put into the code one at a time, and what notices them.

    tests/mutate.py --count 10 --seed 3                  # ten places anywhere
    tests/mutate.py --count 5 --files 'lib/hiac/order/*' # five places of a room
    tests/mutate.py --list --files formats/medit/*       # the places, and what is done to each

A line is drawn from all lines of code on which there is something to change (no comment, no string),
each with the same chance, and then one of the changes to it. So the share of the defects that the
tests notice is one of lines of code.

Works on a copy of the tree (--work, build/mutants), which it configures once, with the compiler cache
if there is one: a defect is put in, the test executables of its room are built and run (tests/ROOM for
lib/hiac/ROOM, tests/formats, tests/tools), and where none fails those of all other rooms, the quickest
first and --jobs of them at a time, unless --room-only is given; the first failure ends it. A test that
fails is run without the defect too, once; if it fails then as well, it says nothing from then on. A
test that takes more than four times its usual processor time, or does not end, has noticed the defect.
A defect that no test notices is printed as SURVIVED, but for the places in tests/mutate.equivalent,
where the program behaves as before: these are printed as such and do not count.

With --functions, a file that tests/coverage.py writes, those tests of other rooms are not run that do not
execute the function around the defect: they cannot notice it. Where the file does not know (a constant,
a constexpr function, a template that no test executes, a source that has changed) all are, and so are
tests that were not counted.

The same seed gives the same defects in the same sources. Every verdict is kept in a journal
(--work/journal-SEED): started again, the program goes on where it was ended.

Exit status: 0 nothing survived, 1 something did, 2 wrong usage.
"""
import argparse
import collections
import fnmatch
import hashlib
import json
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parent.parent
FOLDERS = ("lib/hiac", "formats", "tools")
SUFFIXES = (".cpp", ".hpp")

Place = collections.namedtuple("Place", "path line start end kind before after")

NUMBER = r"(?<![\w.])(?:0x[0-9a-f.]+p[+-]?\d+|\d+\.\d*(?:e[+-]?\d+)?|\d+e[+-]?\d+|\d+)(?![\w.])"
NAME = r"[A-Za-z_]\w*(?:\.\w+|->\w+|\[\w+\])*"

# The result of these does not depend on which of two arguments is the first.
UNORDERED = ("max", "min", "Max", "Min", "Mul", "Add", "swap", "dot")
NOT_UNORDERED = "".join(rf"(?<!\b{name}\()" for name in UNORDERED)


def swapped(first, second):
    return lambda found: second if found.group() == first else first


def scaled_number(found):
    text = found.group()
    if text in ("0", "1") or re.fullmatch(r"0\.0*", text):
        return None  # lengths and ends: other operators are for these; twice zero is zero
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
    ("arguments swapped", rf"(?<=\w\(){NOT_UNORDERED}({NAME}), ({NAME})(?=[,)])",
     lambda f: None if f[1] == f[2] else f"{f[2]}, {f[1]}"),
]
OPERATORS = [(kind, re.compile(pattern), change) for kind, pattern, change in OPERATORS]
# Also what is reserved, which changes nothing but time.
SKIPPED_LINE = re.compile(r"^\s*(?:#|template\b|static_assert\b|using\b|namespace\b|\}|//"
                          r"|(?:if \(.*\) )?\S*\breserve(?:_large)?\(.*;$)")


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


class Executions:
    """Which test executables execute which function, as tests/coverage.py has counted."""

    def __init__(self, path):
        known = json.loads(path.read_text()) if path else {"sha256": {}, "tests": [], "functions": []}
        self.functions = collections.defaultdict(list)
        for name, first, last, tests in known["functions"]:
            self.functions[name].append((first, last, set(tests)))
        self.hashes, self.counted = known["sha256"], set(known["tests"])
        self.lines = {}

    def is_known(self, path):
        if path not in self.lines:
            data = (SOURCE / path).read_bytes()
            same = self.hashes.get(path) == hashlib.sha256(data).hexdigest()
            self.lines[path] = data.decode().split("\n") if same else None
        return self.lines[path] is not None

    def may_notice(self, place):
        """A predicate of test executables."""
        around = []
        if self.is_known(place.path):
            around = [f for f in self.functions[place.path] if f[0] <= place.line <= f[1]]
        if not around:
            return lambda target: True
        first = max(f[0] for f in around)  # of the innermost
        tests = set().union(*(f[2] for f in around if f[0] == first))
        head = " ".join(self.lines[place.path][max(first - 3, 0):first + 2])
        # the compiler itself evaluates the first, and counts nothing of a template that it never makes
        unseen = r"\b(?:constexpr|consteval)\b" if tests else r"\b(?:constexpr|consteval|template)\b"
        if re.search(unseen, head):
            return lambda target: True
        return lambda target: target in tests or target not in self.counted


class Journal:
    """What is known already, a JSON object a line: verdicts by place, seconds and soundness of tests."""

    def __init__(self, path):
        self.path = path
        self.verdicts, self.seconds, self.sound = {}, {}, {}
        for line in path.read_text().splitlines() if path.exists() else []:
            entry = json.loads(line)
            if "verdict" in entry:
                self.verdicts[entry["place"]] = entry["verdict"]
            elif "seconds" in entry:
                self.seconds[entry["test"]] = entry["seconds"]
            else:
                self.sound[entry["test"]] = entry["sound"]

    def note(self, **entry):
        with open(self.path, "a", encoding="utf-8") as file:
            file.write(json.dumps(entry) + "\n")

    def note_verdict(self, place, verdict):
        self.verdicts[place] = verdict
        self.note(place=place, verdict=verdict)

    def note_seconds(self, test, seconds):
        if seconds > self.seconds.get(test, 0):
            self.seconds[test] = seconds
            self.note(test=test, seconds=round(seconds, 2))

    def note_soundness(self, test, sound):
        self.sound[test] = sound
        self.note(test=test, sound=sound)


class Copy:
    """The copy of the tree, its build and its test executables by room."""

    def __init__(self, work, jobs, configuration, with_data, journal):
        # where a checkout has its own: the compiler cache then knows what was compiled there
        self.source, self.build, self.jobs = work / "source", work / "source/build/release", jobs
        self.journal = journal
        self.environment = dict(os.environ)
        if not with_data:  # what everybody's tests notice
            self.environment["HIAC_DATA_DIR"] = str(work / "no-data")
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

    def run(self, command, check=False):
        result = subprocess.run([str(part) for part in command], capture_output=True, text=True,
                                errors="replace", env=self.environment)
        if check and result.returncode != 0:
            sys.exit(f"failed: {' '.join(map(str, command))}\n{result.stdout}{result.stderr}")
        return result

    def make(self, targets):
        return self.run(["ninja", "-C", self.build, f"-j{self.jobs}", *targets]).returncode == 0

    def start(self, target):
        """Starts the tests of an executable, within limits of processor time and of time: with a defect
        a test may wait and not end. Returns the process and the file that has its output."""
        limit = 30 + int(4 * self.journal.seconds.get(target, 300))
        output = tempfile.TemporaryFile(mode="w+", errors="replace")
        command = ["timeout", "--kill-after=5", str(4 * limit),
                   "prlimit", f"--cpu={limit}:{limit + 5}",
                   self.build / target, "--gtest_brief=1", "--gtest_fail_fast"]
        return subprocess.Popen(command, stdout=output, stderr=output, env=self.environment,
                                start_new_session=True), output

    def first_failure(self, targets):
        """(test executable, name of a test of it that fails), or None. `jobs` run at a time; the first
        that is seen to fail ends the others."""
        waiting, running = list(targets), {}
        try:
            while waiting or running:
                while waiting and len(running) < self.jobs:
                    process, output = self.start(waiting[0])
                    running[process.pid] = waiting.pop(0), process, output
                pid, status, used = os.wait4(-1, 0)
                target, process, output = running.pop(pid)
                process.returncode = code = os.waitstatus_to_exitcode(status)
                if code == 0:
                    self.journal.note_seconds(target, used.ru_utime + used.ru_stime)
                    continue
                output.seek(0)
                failed = re.search(r"\[  FAILED  \] (\S+)", output.read())
                return target, failed.group(1) if failed else f"{target} (exit status {code})"
            return None
        finally:
            for _, process, _ in running.values():
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()

    def in_order(self, targets):
        """Of those that pass without a defect, the quickest first."""
        sound = [target for target in targets if self.journal.sound.get(target, True)]
        return sorted(sound, key=lambda target: self.journal.seconds.get(target, 1e9))


def is_sound(copy, target):
    """Whether the tests of an executable pass in the copy as it is."""
    if target not in copy.journal.sound:
        if not copy.make([target]):
            sys.exit(f"without any defect: {target} is not built")
        failure = copy.first_failure([target])
        if failure:
            print(f"without any defect: {failure[1]}", file=sys.stderr)
        copy.journal.note_soundness(target, failure is None)
    return copy.journal.sound[target]


def noticed_by(copy, place, targets):
    """Builds and runs tests with the defect in the copy, some at a time, the quickest first. None where
    the code does not compile, else the name of a test that fails, or an empty one."""
    file = copy.source / place.path
    whole = file.read_text()
    lines = whole.split("\n")
    lines[place.line - 1] = place.after
    defective = "\n".join(lines)
    waiting = copy.in_order(targets)
    try:
        while waiting:
            together = waiting[:4 * copy.jobs]
            file.write_text(defective)
            if not copy.make(together):
                return None
            failure = copy.first_failure(together)
            if not failure:
                waiting = waiting[len(together):]
                continue
            target, test = failure
            file.write_text(whole)
            if is_sound(copy, target):
                return test
            waiting.remove(target)
        return ""
    finally:
        file.write_text(whole)


def verdict_on(copy, place, room_only, may_notice):
    """noticed_by, of the tests of the place's room and then of all others."""
    own = copy.tests[room_of(place.path)]
    rest = [target for targets in copy.tests.values() for target in targets if target not in own]
    verdict = noticed_by(copy, place, own)
    if verdict == "" and not room_only:
        verdict = noticed_by(copy, place, filter(may_notice, rest))
    return verdict


def drawn(places, seed):
    """The places in the order in which they are tried: a change of every line, the lines shuffled."""
    lines = collections.defaultdict(list)
    for place in places:
        lines[place.path, place.line].append(place)
    random_numbers = random.Random(seed)
    order = sorted(lines)
    random_numbers.shuffle(order)
    return [random_numbers.choice(lines[line]) for line in order]


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
    parser.add_argument("--functions", type=pathlib.Path, metavar="FILE",
                        help="the tests that execute each function, of tests/coverage.py")
    parser.add_argument("--nice", type=int, default=10, help="how far to give way (default 10)")
    parser.add_argument("--list", action="store_true", help="print the places and do nothing")
    parser.add_argument("--work", type=pathlib.Path, default=SOURCE / "build/mutants")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--configure", action="append", default=[], metavar="-DNAME=VALUE",
                        help="further arguments of cmake")
    wanted = parser.parse_args()
    if wanted.data and wanted.functions:
        parser.error("--functions: the tests were counted without real files, so not with --data")
    return wanted


def main():
    wanted = arguments()
    places = all_places(wanted.files or ["*"])
    if wanted.kind:
        places = [place for place in places if place.kind in wanted.kind]
    if not places:
        print("no such place", file=sys.stderr)
        sys.exit(2)
    if wanted.list:
        for place in places:
            print(shown(place))
        print(f"{len(places)} places")
        return
    os.nice(wanted.nice)
    work = wanted.work.resolve()
    work.mkdir(parents=True, exist_ok=True)
    journal = Journal(work / f"journal-{wanted.seed}")
    copy = Copy(work, wanted.jobs, wanted.configure, wanted.data, journal)
    known, executions = equivalents(), Executions(wanted.functions)
    noticed, survived, broken = 0, [], 0
    for place in drawn(places, wanted.seed):
        if noticed + len(survived) == wanted.count:
            break
        if (place.path, place.kind, place.before.strip()) in known:
            print(f"{shown(place)}\n    changes nothing", flush=True)
            continue
        if shown(place) not in journal.verdicts:
            may_notice = executions.may_notice(place)
            journal.note_verdict(shown(place),
                                 verdict_on(copy, place, wanted.room_only, may_notice))
        verdict = journal.verdicts[shown(place)]
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
