#!/usr/bin/env python3
"""Writes man pages and shell completions from what the programs' own --help says.

    make_manual.py FOLDER PROGRAM...

FOLDER then holds share/man/man1, share/bash-completion/completions, share/zsh/site-functions and
share/fish/vendor_completions.d, as they are installed. An option thus stands in one place, the program.
"""
import dataclasses
import pathlib
import re
import subprocess
import sys


@dataclasses.dataclass
class Option:
    names: list  # "-o", "--output"
    value: str  # how the value is called; empty: a flag
    text: str

    def choices(self):
        """The words that the value may be, where --help lists them: {a,b} or a|b|c."""
        braces = re.search(r"\{([^}]*)\}", self.value)
        if braces:
            return braces[1].split(",")
        return self.value.split("|") if re.fullmatch(r"[a-z]+(\|[a-z]+)+", self.value) else []


@dataclasses.dataclass
class Program:
    name: str
    summary: str
    usage: str
    paragraphs: list  # of text, each a list of lines, before the options
    options: list
    examples: list
    rest: list  # lines behind the examples


def option_of(head):
    """An option from the left column of --help: names, the value, and what it needs or excludes."""
    names_text, _, value = head.partition(" ")
    value, *relation = re.split(r" ?\b(?=(?:Excludes|Needs):)", value)
    names = [re.sub(r"\{.*", "", name) for name in names_text.split(",") if name.startswith("-")]
    # the range or default that CLI11 adds is in the text where it matters
    value = re.sub(r"^(\w+):(?!\{).*", r"\1", value.strip()).removesuffix(" ...")
    note = " ".join(part.strip() for part in relation)
    return Option(names, value, f"({note}) " if note else "")


def parse(path):
    lines = subprocess.run([path, "--help"], check=True, capture_output=True, text=True).stdout.splitlines()
    name = pathlib.Path(path).name
    # the umbrella program begins with how it is called
    summary = re.sub(r"^\S+ [A-Z]+ \[options\] ", "", lines[0]).split(". ")[0].rstrip(".")
    program = Program(name, summary, "", [], [], [], [])
    part = "text"
    for line in lines[1:]:
        if line.startswith("Usage: "):
            program.usage = line.removeprefix("Usage: ")
        elif line in ("Options:", "Positionals:", "Examples:") or line.endswith(" options:"):
            part = line.rstrip(":")
        elif line.startswith("Exit codes:"):
            part = "rest"
            program.rest.append(line.removeprefix("Exit codes: "))
        elif part == "Examples" and line:
            program.examples.append(line.strip())
        elif part == "rest" and line:
            program.rest.append(line)
        elif part == "text":
            program.paragraphs.append(line)
        elif line.startswith("  ") and not line.startswith("   "):
            head, _, text = line[2:].partition("  ")
            option = option_of(head) if head.startswith("-") else Option([head.split()[0]], "", "")
            option.text += text.strip()
            program.options.append(option)
        elif line.strip() and program.options:
            program.options[-1].text = f"{program.options[-1].text} {line.strip()}".strip()
    return program


def roff(text):
    text = text.replace("\\", "\\e").replace("-", "\\-")
    return "\\&" + text if text[:1] in (".", "'") else text


def man_page(program, version, others):
    usage = program.usage.removeprefix(program.name).strip() or "COMMAND [OPTIONS]"
    out = [f'.TH {program.name.upper()} 1 "" "hiac {version}"', ".SH NAME",
           roff(f"{program.name} - {program.summary}"), ".SH SYNOPSIS", f".B {roff(program.name)}", roff(usage)]
    if any(program.paragraphs):
        out += [".SH DESCRIPTION", ".nf", *map(roff, program.paragraphs), ".fi"]
    if program.options:
        out.append(".SH OPTIONS")
    for option in program.options:
        names = ", ".join(f"\\fB{roff(name)}\\fR" for name in option.names)
        value = f" \\fI{roff(option.value)}\\fR" if option.value else ""
        out += [".TP", names + value, roff(option.text)]
    if program.examples:
        out += [".SH EXAMPLES", ".nf", *map(roff, program.examples), ".fi"]
    if program.rest:
        out += [".SH EXIT STATUS", *map(roff, program.rest)]
    out += [".SH SEE ALSO", roff(", ".join(f"{name}(1)" for name in others if name != program.name))]
    return "\n".join(out) + "\n"


def flags(program):
    return [option for option in program.options if option.names[0].startswith("-")]


def commands(program):
    """The commands of the umbrella program, from its text."""
    return [line.split()[0] for line in program.paragraphs if re.match(r"  \w+  +\w", line)]


# The words behind a command of the umbrella program are those of the program that it runs.
DELEGATION = [
    "  if ((COMP_CWORD > 1)); then",
    "    local program=hiac-${COMP_WORDS[1]} function=_hiac_${COMP_WORDS[1]}",
    '    declare -F "$function" > /dev/null || . "${BASH_SOURCE[0]%/*}/$program" 2> /dev/null',
    '    if declare -F "$function" > /dev/null; then "$function"; else COMPREPLY=($(compgen -f -- "$word")); fi',
    "    return",
    "  fi"]


def bash_completion(program):
    function = "_" + program.name.replace("-", "_")
    cases = [f"    {'|'.join(option.names)}) COMPREPLY=($(compgen -W '{' '.join(option.choices())}' -- \"$word\")); return ;;"
             for option in flags(program) if option.choices()]
    words = " ".join(name for option in flags(program) for name in option.names)
    plain = f"compgen -W '{' '.join(commands(program))}'" if commands(program) else "compgen -f"
    return "\n".join([
        f"# completion of {program.name}, for bash",
        f"{function}() {{",
        "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}",
        *(["  case $before in", *cases, "  esac"] if cases else []),
        *(DELEGATION if commands(program) else []),
        "  if [[ $word == -* ]]; then",
        f"    COMPREPLY=($(compgen -W '{words}' -- \"$word\"))",
        "  else",
        f'    COMPREPLY=($({plain} -- "$word"))',
        "  fi",
        "}",
        f"complete -o filenames -F {function} {program.name}", ""])


def quoted(text):
    return text.replace("\\", "\\\\").replace("'", r"'\''")


def zsh_completion(program):
    out = [f"#compdef {program.name}"]
    if commands(program):
        return "\n".join(out + [f"_arguments '1:command:({' '.join(commands(program))})' '*:file:_files'", ""])
    out.append("_arguments \\")
    for option in flags(program):
        text = quoted(re.sub(r"([\[\]:])", r"\\\1", option.text))
        does = f"({' '.join(option.choices())})" if option.choices() else "_files"
        value = f":value:{does}" if option.value else ""
        out += [f"  '*{name}[{text}]{value}' \\" for name in option.names]
    return "\n".join(out + ["  '*:file:_files'", ""])


def fish_completion(program):
    out = []
    if commands(program):
        out.append(f"complete -c {program.name} -n __fish_use_subcommand -xa '{' '.join(commands(program))}'")
    for option in flags(program):
        names = " ".join(f"-l {name[2:]}" if name.startswith("--") else f"-s {name[1:]}" for name in option.names)
        value = f" -xa '{' '.join(option.choices())}'" if option.choices() else (" -r" if option.value else "")
        text = quoted(option.text)
        out.append(f"complete -c {program.name} {names}{value} -d '{text}'")
    return "\n".join(out) + "\n"


def main():
    folder, *paths = sys.argv[1:]
    programs = [parse(path) for path in paths]
    version = subprocess.run([paths[0], "--version"], check=True, capture_output=True, text=True).stdout.split()[1]
    others = sorted(program.name for program in programs)
    share = pathlib.Path(folder) / "share"
    for program in programs:
        name = program.name
        for path, text in (("man/man1/" + name + ".1", man_page(program, version, others)),
                           ("bash-completion/completions/" + name, bash_completion(program)),
                           ("zsh/site-functions/_" + name, zsh_completion(program)),
                           ("fish/vendor_completions.d/" + name + ".fish", fish_completion(program))):
            (share / path).parent.mkdir(parents=True, exist_ok=True)
            (share / path).write_text(text)


if __name__ == "__main__":
    main()
