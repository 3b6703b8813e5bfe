#!/usr/bin/env python3
"""No link in a Markdown page is dead: the file is there, and the heading, and mkdocs.yml names pages.

Looks at every page under version control: links and pictures of Markdown, their reference definitions,
and `src` and `href` of HTML. A target is a file beside the page, a `#heading` by the name that GitHub and
mkdocs give it, or both. Links with a scheme (https:) are counted, not followed: a test needs no network.
Files of ours that the text names in full (`docs/x.md`) have to be there, too. Also every
page of docs/ has to be in the navigation of mkdocs.yml, where there is one, once.

Usage: links_test.py SOURCE_FOLDER. Exit status 1 with a line for every dead link.
"""
import pathlib
import re
import sys
import unicodedata

FENCE = re.compile(r"^ {0,3}(```+|~~~+).*?^ {0,3}\1[^\n]*$", re.M | re.S)
CODE = re.compile(r"(`+)(?!`).*?(?<!`)\1(?!`)", re.S)
LINK = re.compile(r"!?\[(?:[^\[\]]|!?\[[^\[\]]*\](?:\([^()]*\))?)*\]\(\s*<?([^()\s>]+(?:\([^()\s]*\))?)>?(?:\s+\"[^\"]*\")?\s*\)")
DEFINITION = re.compile(r"^ {0,3}\[[^\]]+\]:\s*<?(\S+?)>?(?:\s+\"[^\"]*\")?\s*$", re.M)
HTML = re.compile(r"<(?:a|img)\b[^>]*?\b(?:href|src)=\"([^\"]+)\"")
ANCHOR = re.compile(r"<[^>]+\b(?:id|name)=\"([^\"]+)\"")
# a file of ours that a page names in its text, from the top folder
NAMED = re.compile(r"`((?:docs|samples|lib|include|tests|tools|formats|packaging|\.ci)/[\w./-]+\.\w+)`")
SCHEME = re.compile(r"^[a-z][a-z0-9+.-]*:", re.I)
SKIPPED = {"build", ".git", "node_modules", "__pycache__", "shared"}


def pages_of(source):
    for page in sorted(source.rglob("*.md")):
        if not SKIPPED & set(page.relative_to(source).parts):
            yield page


def blanked(match):
    """As many lines, without their text, so that the numbers of lines stay."""
    return "\n" * match[0].count("\n")


def without_code(text):
    return CODE.sub(blanked, FENCE.sub(blanked, text))


def slugs(heading):
    """The anchors of a heading on GitHub and in mkdocs: what it shows, in small letters, with hyphens."""
    shown = re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", heading)
    shown = re.sub(r"[*`]|<[^>]+>", "", shown).strip().lower()
    plain = unicodedata.normalize("NFKD", shown).encode("ascii", "ignore").decode()
    return (re.sub(r"\s", "-", re.sub(r"[^\w\s-]", "", shown)),
            re.sub(r"[-\s]+", "-", re.sub(r"[^\w\s-]", "", plain).strip()))


def anchors(page):
    """What a link can lead to on both: not the second heading of one name, which they number differently."""
    text = FENCE.sub(blanked, page.read_text())
    found = set(ANCHOR.findall(text))
    headings = re.findall(r"^ {0,3}#{1,6}\s+(.*?)\s*#*\s*$|^(\S[^\n]*)\n(?:=+|-{3,})\s*$", text, re.M)
    for heading in (one or other for one, other in headings):
        on_github, on_site = slugs(heading)
        if on_github == on_site:
            found.add(on_github)
    return found


def links(text):
    text = without_code(text)
    for pattern in (LINK, DEFINITION, HTML):
        for match in pattern.finditer(text):
            yield text.count("\n", 0, match.start()) + 1, match[1]


def named_files(text):
    text = FENCE.sub(blanked, text)
    for match in NAMED.finditer(text):
        yield text.count("\n", 0, match.start()) + 1, match[1]


def fault_of(source, page, target):
    path, _, anchor = target.partition("#")
    file = (page.parent / path).resolve() if path else page
    if not file.is_relative_to(source):
        return f"{target} leads out of the project"
    if not file.exists():
        return f"{target}: there is no {file.relative_to(source)}"
    if anchor and file.suffix == ".md" and anchor not in anchors(file):
        return f"{target}: {file.relative_to(source)} has no heading #{anchor}"
    return None


def navigation_faults(source):
    """Pages that mkdocs.yml names and that are not there, and pages that it does not name."""
    site = source / "mkdocs.yml"
    if not site.exists():
        return
    navigation = site.read_text().partition("\nnav:\n")[2]
    named = re.findall(r"^\s*-\s+(?:.*:\s+)?([\w./-]+\.md)\s*$", navigation, re.M)
    if len(named) < 10:
        yield f"mkdocs.yml: only {len(named)} pages in its navigation"
    docs = source / "docs"
    there = {page.relative_to(docs).as_posix() for page in pages_of(docs)}
    # written by packaging/make-site.sh from pages at the top
    there |= {"index.md", "changelog.md", "contributing.md", "licences.md"}
    for page in sorted({page for page in named if named.count(page) > 1}):
        yield f"mkdocs.yml: {page} is named more than once"
    yield from (f"mkdocs.yml: there is no {page}" for page in sorted(set(named) - there))
    yield from (f"mkdocs.yml: does not name docs/{page}" for page in sorted(there - set(named)))


def main():
    source = pathlib.Path(sys.argv[1]).resolve()
    faults, count, outside = [], 0, 0
    pages = list(pages_of(source))
    for page in pages:
        for line, target in links(page.read_text()):
            count += 1
            if SCHEME.match(target):
                outside += 1
            elif fault := fault_of(source, page, target):
                faults.append(f"{page.relative_to(source)}:{line}: {fault}")
        for line, name in named_files(page.read_text()):
            count += 1
            if not (source / name).exists():
                faults.append(f"{page.relative_to(source)}:{line}: there is no {name}")
    faults += navigation_faults(source)
    print(*faults, sep="\n")
    print(f"{len(pages)} pages, {count} links ({outside} to other sites), {len(faults)} faults")
    if count < 30:
        sys.exit("hardly any link found: is this the source folder?")
    sys.exit(1 if faults else 0)


main()
