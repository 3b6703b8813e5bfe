#!/usr/bin/env python3
"""No class of product code is longer than 300 lines, no file longer than 500, and no folder holds more
than 30 files of it.

A class is measured from the line of its head to that of its closing brace, its comments included.
Usage: sizes_test.py SOURCE_FOLDER. Exit status 1 with a line for everything that is too large.
"""
import pathlib
import re
import sys
import tempfile

MOST_CLASS_LINES, MOST_FILE_LINES, MOST_FOLDER_FILES = 300, 500, 30
ROOTS = ("include", "lib", "formats", "tools", "python")
SOURCES = {".cpp", ".hpp", ".S", ".py"}  # what CMake and documentation hold is no product code

# a quote between digits separates them and begins no character
NOISE = re.compile(r'//[^\n]*|/\*.*?\*/|R"([^(\s]*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"'
                   r"|(?<![0-9A-Fa-f])'(?:\\.|[^'\\\n])+'", re.S)
HEAD = re.compile(r"^[ \t]*(?:template\s*<[^;{}]*>\s*)?(?:class|struct|union)\b([^;{}()=]*)\{", re.M)


def without_noise(text):
    """The text with blanks instead of comments and literals; lines stay where they are."""
    return NOISE.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)


def classes(text):
    """The name, first line and number of lines of every class, of nested ones as well."""
    text = without_noise(text)
    for head in HEAD.finditer(text):
        end, depth = head.end(), 1
        while depth > 0 and end < len(text):
            depth += {"{": 1, "}": -1}.get(text[end], 0)
            end += 1
        words = head[1].split(":")[0].split()
        # blank lines before the head are no part of it
        begin = head.start() + len(head[0]) - len(head[0].lstrip())
        yield (words[-1] if words else "(no name)", text.count("\n", 0, begin) + 1,
               text.count("\n", begin, end) + 1)


def faults_in(source):
    """What is too large, a line each, and how many classes were measured."""
    faults, measured = [], 0
    for root in ROOTS:
        for folder in (source / root, *(p for p in sorted((source / root).rglob("*")) if p.is_dir())):
            if folder.name == "__pycache__" or not folder.is_dir():
                continue
            files = [file for file in sorted(folder.iterdir()) if file.suffix in SOURCES]
            if len(files) > MOST_FOLDER_FILES:
                faults.append(f"{folder.relative_to(source)}: {len(files)} files")
            for file in files:
                text, name = file.read_text(), file.relative_to(source)
                lines = len(text.splitlines())
                if lines > MOST_FILE_LINES:
                    faults.append(f"{name}: {lines} lines")
                if file.suffix not in {".cpp", ".hpp"}:
                    continue
                for class_name, first, count in classes(text):
                    measured += 1
                    if count > MOST_CLASS_LINES:
                        faults.append(f"{name}:{first}: class {class_name} of {count} lines")
    return faults, measured


def class_text(lines):
    """A class of so many lines, with braces that are none."""
    body = ['  const char* text = "}";  // }', "  char brace = '}';", "  int number = 1'000;",
            "  /* }", "  } */", '  const char* raw = R"(', '})";', "  void run() {", "  }"]
    body += ["  int member;"] * (lines - len(body) - 3)
    return "\n".join(["template <class T>", "class Long : public Base {", *body, "};", ""])


def check_itself():
    """What is as large as it may be is let through; what is larger by one is found, and nothing else."""
    with tempfile.TemporaryDirectory() as name:
        source = pathlib.Path(name)
        (source / "lib" / "full").mkdir(parents=True)
        (source / "lib" / "crowded").mkdir()
        (source / "lib" / "fits.hpp").write_text("\n" + class_text(300) + "int other;\n" * 199)
        (source / "lib" / "long_class.hpp").write_text("\n" + class_text(301))
        (source / "lib" / "long_file.cpp").write_text("int other;\n" * 501)
        for number in range(31):
            (source / "lib" / "crowded" / f"{number}.cpp").write_text("")
            if number < 30:
                (source / "lib" / "full" / f"{number}.cpp").write_text("")
        found, measured = faults_in(source)
        expected = ["lib/long_class.hpp:2: class Long of 301 lines", "lib/long_file.cpp: 501 lines",
                    "lib/crowded: 31 files"]
        if found != expected or measured != 2:
            sys.exit(f"the measure is wrong: {measured} classes, found {found}")


def main():
    check_itself()
    faults, measured = faults_in(pathlib.Path(sys.argv[1]))
    for fault in faults:
        print(fault)
    print(f"{measured} classes measured, {len(faults)} things too large")
    if measured < 100:
        sys.exit("hardly any class found: is this the source folder?")
    sys.exit(1 if faults else 0)


main()
