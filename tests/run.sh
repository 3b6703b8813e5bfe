#!/usr/bin/env bash
# From nothing to tested: installs the Debian packages that are missing, builds everything and runs
# every test. Prints little unless something fails; the last line is 'N passed, N failed, N skipped',
# in test cases. The build is that of samples/run.sh: what one has compiled, the other does not
# compile again.
#   tests/run.sh [PRESET]    default: release; sanitize and debug are the others (CMakePresets.json)
#   HIAC_BUILD_DIR           where to build (default build/PRESET)
#   HIAC_STRICT=ON           makes warnings errors (default: as the build was configured before)
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
preset=${1:-release}
build=${HIAC_BUILD_DIR:-$root/build/$preset}

# Runs a command and shows its output only when it fails, which ends the script.
quietly() {
  local log=$1
  shift
  "$@" >"$log" 2>&1 && return
  cat "$log" >&2
  echo "failed: $*" >&2
  exit 1
}

"$root/.ci/install"
mkdir -p "$build"
began=$SECONDS
quietly "$build/configure.log" cmake -S "$root" --preset "$preset" -B "$build" -D HIAC_UNITY=ON \
  ${HIAC_STRICT:+-D HIAC_STRICT="$HIAC_STRICT"}
quietly "$build/build.log" cmake --build "$build" -j "$(nproc)"
built=$SECONDS

# Tests wait for windows, processes and clocks for a quarter of their time: half as many again as
# there are processors keep these busy.
jobs=$(($(nproc) + ($(nproc) + 1) / 2))
rm -f "$build/tests.xml"
# The exit status of ctest is ignored: the report, which is read next, holds the same and numbers.
ctest --test-dir "$build" -j "$jobs" --timeout 900 --no-tests=error --output-on-failure \
  --output-junit "$build/tests.xml" >"$build/tests.log" 2>&1 || true
read -r passed failed skipped < <(python3 "$root/tests/project/count_tests.py" "$build/tests.xml")
[ "$failed" = 0 ] || grep -v -e ' Passed ' -e '^ *Start ' "$build/tests.log" >&2
echo "$preset: build $((built - began)) s, tests $((SECONDS - built)) s"
echo "$passed passed, $failed failed, $skipped skipped"
[ "$failed" = 0 ] && [ "$passed" -gt 0 ]
