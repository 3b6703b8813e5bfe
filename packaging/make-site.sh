#!/usr/bin/env bash
# Makes a site of the documentation (mkdocs.yml): docs/ and, from the top, the README, the changelog, how to
# contribute, and the licences. Needs Debian's mkdocs and mkdocs-material, and no network; a page that is missing,
# in no navigation, or linked and not there ends the script.
#   packaging/make-site.sh     into build/site/html, whose index.html any browser opens
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
pages=$root/build/site/pages
command -v mkdocs >/dev/null || { echo "mkdocs is missing (Debian: mkdocs mkdocs-material)" >&2; exit 2; }

python3 "$root/tests/project/links_test.py" "$root"
rm -rf "$pages"
mkdir -p "$pages"
cp -r "$root"/docs/. "$pages"
# pages of the top move to where docs/ is the top: their links lose that folder, and samples come along
for page in README.md:index.md CHANGELOG.md:changelog.md CONTRIBUTING.md:contributing.md \
            LICENSES-OF-BINARIES.md:licences.md; do
  sed 's|](docs/|](|g; s|](CHANGELOG\.md|](changelog.md|g; s|](CONTRIBUTING\.md|](contributing.md|g
       s|](LICENSES-OF-BINARIES\.md|](licences.md|g' "$root/${page%:*}" >"$pages/${page#*:}"
done
mkdir -p "$pages/samples/reactor-pool"
cp "$root"/samples/reactor-pool/*.png "$pages/samples/reactor-pool/"
# pages of docs/ reach the top's files by ../, which the site's top does not have
find "$pages" -maxdepth 1 -name '*.md' -exec sed -i 's|](\.\./samples/|](samples/|g; s|](\.\./README.md|](index.md|g' {} +
find "$pages" -mindepth 2 -name '*.md' -exec sed -i 's|](\.\./\.\./samples/|](../samples/|g; s|](\.\./\.\./README.md|](../index.md|g' {} +
cd "$root"
mkdocs build --quiet --clean --strict
echo "made $root/build/site/html/index.html"
