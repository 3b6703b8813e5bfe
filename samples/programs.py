"""What scripts that make a page of docs/ again have in common: hiac's programs, and the page's table."""
import json
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
BUILD = Path(os.environ.get("HIAC_BUILD_DIR", ROOT / "build/release"))


def run(tool, *arguments):
    """Runs hiac-TOOL and returns its output; ends the program when the tool fails."""
    command = [BUILD / "tools" / tool / f"hiac-{tool}", "-q", *map(str, arguments)]
    result = subprocess.run(command, stdout=subprocess.PIPE, check=False)
    if result.returncode != 0:
        sys.exit(f"{Path(sys.argv[0]).name}: hiac-{tool} failed")
    return result.stdout


def compare(picture, *arguments):
    """The facts of hiac-compare, the largest error and the root mean square one over R, G and B."""
    facts = json.loads(run("compare", picture, *arguments, "--json", "-"))
    colours = [c for c in facts["channels"] if c["name"] in "RGB"]
    largest = max(c["largest_error"] for c in colours)
    return facts, largest, (sum(c["rmse"] ** 2 for c in colours) / 3) ** 0.5


def renew_table(page, what, script, table):
    """Puts a table between the two marks of a page."""
    first, last = f"<!-- {what}: {script} --docs -->\n", f"<!-- end of {what} -->\n"
    before, rest = page.read_text().split(first)
    page.write_text(before + first + "\n" + table + "\n" + last + rest.split(last)[1])
