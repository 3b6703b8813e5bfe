#!/usr/bin/env python3
"""No message of the library or of the readers names an option of a command line: a program without
one shows them, too. The tools put their options' names in (tools/common/as_option.hpp,
tools/convert/option_names.hpp).
Usage: neutral_messages_test.py SOURCE_FOLDER. Exit status 1 with a line for every such message.
"""
import pathlib
import re
import sys

STRING = re.compile(r'"(?:[^"\\\n]|\\.)*"')
OPTION = re.compile(r"(?<![\w!<-])--[a-z]")


def main():
    source = pathlib.Path(sys.argv[1])
    faults, strings = [], 0
    for folder in ("include/hiac", "lib/hiac", "formats"):
        for file in sorted((source / folder).rglob("*.[ch]pp")):
            for number, line in enumerate(file.read_text().splitlines(), 1):
                if line.lstrip().startswith(("//", "#include")):
                    continue
                for text in STRING.findall(line):
                    strings += 1
                    if OPTION.search(text):
                        faults.append(f"{file.relative_to(source)}:{number}: {text}")
    for fault in faults:
        print(fault)
    print(f"{strings} strings, {len(faults)} with options")
    if strings == 0:
        sys.exit("no string found: is this the source folder?")
    sys.exit(1 if faults else 0)


main()
