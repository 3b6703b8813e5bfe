#!/usr/bin/env bash
# From nothing to a picture: installs what is missing, builds hiac, and renders a real finite-element
# result, the flow in a reactor's hot pool (samples/reactor-pool), step by step as a user would.
#   samples/run.sh [PICTURE]     default: flow.png in the current folder
#   HIAC_BUILD_DIR               where to build (default build/release)
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
build=${HIAC_BUILD_DIR:-$root/build/release}
picture=${1:-flow.png}
sample=$root/samples/reactor-pool

"$root/.ci/install" sample
mkdir -p "$build"
log=$build/samples-build.log
echo "building hiac in $build (log: $log)"
# a build that is there already, of tests/run.sh for one, keeps its options
configure=(cmake "$build")
[ -f "$build/CMakeCache.txt" ] || configure=(cmake -S "$root" --preset sample -B "$build" -D HIAC_UNITY=ON)
if ! { "${configure[@]}" &&
       cmake --build "$build" -j "$(nproc)" --target hiac-convert hiac-sort hiac-render; } >"$log" 2>&1
then
  tail -n 40 "$log" >&2
  exit 1
fi
PATH=$build/tools/convert:$build/tools/sort:$build/tools/render:$PATH

hiac-convert "$sample/flow.vtu" |
  hiac-sort --view "$sample/view.toml" |
  hiac-render --view "$sample/view.toml" -o "$picture"
echo "made $picture"
