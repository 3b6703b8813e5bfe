#!/usr/bin/env python3
"""The shared library exports what the public headers declare, nothing else, and its interface changes
only on purpose.

lib/exported_symbols.map is the linker's list of what is exported, and lib/public_types.txt holds the size
of every public type. Both follow from the headers in include/hiac: a function that they declare and do not
define, and the type information of exceptions. Whoever changes the interface writes the lists again, sees in
the difference what changed, and raises HIAC_SOVERSION where something was removed or altered
(docs/versioning.md).

Usage: exported_symbols_test.py SOURCE_FOLDER FOLDER_OF_GENERATED_HEADERS STATIC_LIBRARY SHARED_LIBRARY
SOVERSION COMPILER [--write]
"""
import collections
import pathlib
import re
import subprocess
import sys
import tempfile

NOISE = re.compile(r'//[^\n]*|/\*.*?\*/|^[ \t]*#(?:[^\n]*\\\n)*[^\n]*|"(?:[^"\\\n]|\\.)*"|\'(?:[^\'\\\n]|\\.)\'',
                   re.S | re.M)
ATTRIBUTE = re.compile(r"\[\[.*?\]\]")
NAMESPACE = re.compile(r"\bnamespace\s+([\w:]+)$")
CLASS = re.compile(r"^(?:template\s*<.*>\s*)?(?:class|struct)\s+(\w+)\s*(?:final\s*)?(:.*)?$", re.S)


def run(*words):
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"failed: {' '.join(map(str, words))}\n{done.stderr}")
    return done.stdout


def outside_brackets(text):
    """The text without what stands between < and >, so that a parenthesis is one of a function."""
    while (shorter := re.sub(r"<[^<>]*>", "", text)) != text:
        text = shorter
    return text


def begins_function(plain):
    head, parenthesis, _ = plain.partition("(")
    return bool(parenthesis) and ("=" not in head or "operator" in head)


class Declarations:
    """The functions that headers declare without a body, and the classes with a base class."""

    def __init__(self):
        self.functions = collections.Counter()  # by qualified name; more than 1: overloads
        self.derived = set()
        self.has_body = False  # the statement that is read is a function whose body has begun

    def read(self, text):
        scopes, statement = [], ""  # a scope: its qualified name, or None inside a body or an initialiser
        for token in re.findall(r"[{};]|[^{};]+", NOISE.sub(" ", text)):
            inside = not scopes or scopes[-1] is not None
            if token == "{":
                scopes.append(self.scope_of(statement.strip(), scopes) if inside else None)
                if scopes[-1] is not None:
                    statement = ""
            elif token == "}":
                scopes.pop()
            elif token == ";":
                if inside:
                    self.take(statement.strip(), scopes)
                    statement = ""
            elif inside:
                # an access label begins no declaration; a body that ended begins the next statement
                statement = re.sub(r"\b(?:public|private|protected)\s*:(?!:)", "", statement + token)
                if self.has_body:
                    statement, self.has_body = token, False

    def scope_of(self, statement, scopes):
        outer = scopes[-1] if scopes else ""
        statement = ATTRIBUTE.sub("", statement).strip()
        if name := NAMESPACE.search(statement):
            return f"{outer}::{name[1]}".removeprefix("::")
        if name := CLASS.match(statement):
            if name[2]:
                self.derived.add(f"{outer}::{name[1]}")
            return f"{outer}::{name[1]}"
        # a function's body ends its statement; an initialiser or a default argument does not
        plain = outside_brackets(statement)
        self.has_body = begins_function(plain) and plain.count("(") == plain.count(")")
        return None

    def take(self, statement, scopes):
        plain = outside_brackets(ATTRIBUTE.sub("", statement))
        head, _, rest = plain.partition("(")
        if not begins_function(plain) or re.match(r"\s*(?:using|typedef|friend|static_assert|template)\b", head):
            return
        if re.search(r"\)\s*(?:const|noexcept|\s)*=\s*(?:default|delete|0)\s*$", "(" + rest):
            return
        name = re.search(r"(~?\w+)\s*$", head)
        if name and scopes:
            self.functions[f"{scopes[-1]}::{name[1]}"] += 1


class PublicHeaders:
    """The headers that are installed, in the folders of the source and of what the build generates."""

    def __init__(self, folders, compiler):
        self.names = sorted(header.relative_to(folder).as_posix()
                            for folder in folders for header in folder.rglob("hiac/**/*.hpp"))
        self.compile = [compiler, "-std=c++20", "-fsyntax-only", *(f"-I{folder}" for folder in folders)]
        self.declared = Declarations()
        for folder in folders:
            for header in sorted(folder.rglob("hiac/**/*.hpp")):
                self.declared.read(header.read_text())

    def compiled(self, program, *options):
        """Whether a program that includes all of them compiles, and what the compiler says."""
        with tempfile.TemporaryDirectory() as folder:
            source = pathlib.Path(folder) / "program.cpp"
            source.write_text("".join(f'#include "{name}"\n' for name in self.names) + program)
            return subprocess.run([*self.compile, *options, source], capture_output=True, text=True, check=False)

    def declared_among(self, signatures):
        """Those of the functions that they declare, and not another of the name: an address can be taken."""
        signatures = sorted(signatures)
        program = ["template <class... A> struct Taking { template <class R> static void take(R (*)(A...)); };"]
        for number, signature in enumerate(signatures, 1):
            name, _, arguments = re.sub(r"\[abi:\w+\]", "", signature).partition("(")
            program += [f'#line {number} "signature"',
                        f"void probe{number}() {{ Taking<{arguments.rpartition(')')[0]}>::take(&{name}); }}"]
        complaints = self.compiled("\n".join(program) + "\n").stderr
        refused = {int(number) for number in re.findall(r"^signature:(\d+):\d+: error", complaints, re.M)}
        return {signature for number, signature in enumerate(signatures, 1) if number not in refused}


def defined_symbols(library, *options):
    """Mangled names of what a library defines, by nm, each with its name as people write it."""
    lines = run("nm", "--defined-only", "--format=posix", *options, library).splitlines()
    names = sorted({line.split()[0].split("@")[0] for line in lines
                    if re.match(r"_Z\S+ [TDBRVW] ", line)})
    shown = subprocess.run(["c++filt"], input="\n".join(names), capture_output=True, text=True, check=True)
    return dict(zip(names, shown.stdout.splitlines()))


def qualified_name(shown):
    return re.sub(r"\[abi:\w+\]", "", outside_brackets(shown)).partition("(")[0]


def exported_by(headers, archive):
    """(mangled, shown) of every symbol that the headers make public, and what is wrong with them."""
    information, functions = [], collections.defaultdict(list)
    for mangled, shown in defined_symbols(archive).items():
        if match := re.match(r"typeinfo (?:name )?for (.*)", shown):
            if match[1] in headers.declared.derived:
                information.append((mangled, shown))
        elif qualified_name(shown) in headers.declared.functions:
            functions[qualified_name(shown)].append((mangled, shown))
    faults = []
    shown = {name: {symbol[1] for symbol in functions[name]} for name in headers.declared.functions}
    # where the library has overloads of its own
    declared = headers.declared_among(signature for name, count in headers.declared.functions.items()
                                      for signature in shown[name] if len(shown[name]) > count)
    for name, count in sorted(headers.declared.functions.items()):
        if len(shown[name]) > count:
            shown[name] &= declared
            functions[name] = [symbol for symbol in functions[name] if symbol[1] in declared]
        if len(shown[name]) != count:
            faults.append(f"{name}: the public headers declare {count} function(s), the library defines "
                          f"{len(shown[name])}: {'; '.join(sorted(shown[name]))}")
    public = information + [symbol for symbols in functions.values() for symbol in symbols]
    return sorted(public, key=lambda symbol: (symbol[1], symbol[0])), faults


def map_text(soversion, public):
    lines = [f"    {mangled};  # {shown}" for mangled, shown in public]
    return "\n".join([
        "# What libhiac.so exports: the functions of the public headers and the types of their exceptions.",
        "# Written by tests/project/exported_symbols_test.py --write; see docs/versioning.md.",
        f"HIAC_{soversion} {{", "  global:", *lines, "  local:", "    *;", "};", ""])


def types_text(headers):
    """Every public type with its size and alignment, as GCC lays it out."""
    done = headers.compiled("", "-fdump-lang-class=/dev/stdout")
    found = set(re.findall(r"^Class (hiac::[^\n<]*)\n   size=(\d+) align=(\d+)", done.stdout, re.M))
    return "".join(f"{name}: {size} bytes, aligned to {alignment}\n" for name, size, alignment in sorted(found))


def difference(file, expected, write):
    if write:
        file.write_text(expected)
    found = file.read_text().splitlines() if file.exists() else []
    wanted = expected.splitlines()
    return ([f"{file.name}: is no longer: {line.strip()}" for line in found if line not in set(wanted)] +
            [f"{file.name}: is new: {line.strip()}" for line in wanted if line not in set(found)])


def main():
    arguments = [argument for argument in sys.argv[1:] if argument != "--write"]
    write = "--write" in sys.argv
    source, generated, archive, shared, soversion, compiler = arguments
    lib = pathlib.Path(source) / "lib"
    headers = PublicHeaders([pathlib.Path(source) / "include", pathlib.Path(generated)], compiler)
    public, faults = exported_by(headers, archive)
    faults += difference(lib / "exported_symbols.map", map_text(soversion, public), write)

    exported = defined_symbols(shared, "--dynamic")
    faults += [f"{shared}: does not export {shown}" for name, shown in public if name not in exported]
    faults += [f"{shared}: exports {shown}" for name, shown in exported.items() if name not in dict(public)]

    is_gcc = "Free Software Foundation" in run(compiler, "--version")
    if is_gcc:
        faults += difference(lib / "public_types.txt", types_text(headers), write)
    print(*faults, sep="\n")
    print(f"{len(headers.names)} headers, {len(public)} symbols, {len(faults)} faults" +
          ("" if is_gcc else "; sizes of types are compared for GCC alone"))
    if faults:
        print("where this is meant: write the lists again with --write, and see docs/versioning.md")
    if len(public) < 40:
        sys.exit("hardly any symbol found: is this the source folder?")
    sys.exit(1 if faults else 0)


main()
