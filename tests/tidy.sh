#!/usr/bin/env bash
# clang-tidy over the sources below the folders or files given (default: lib formats tools), with the
# flags of build/release (or HIAC_BUILD_DIR), which has to be configured. Exit status 1 when it finds
# anything.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
build=${HIAC_BUILD_DIR:-$root/build/release}
[ -e "$build/compile_commands.json" ] ||
  { echo "not configured: $build (cmake --preset release)" >&2; exit 2; }
cd "$root"
[ $# -gt 0 ] || set -- lib formats tools
find "$@" -name '*.cpp' -print0 | sort -z |
  xargs -0 -r -n 1 -P "$(nproc)" clang-tidy --quiet -p "$build"
