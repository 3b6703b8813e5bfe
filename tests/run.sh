#!/usr/bin/env bash
# Builds everything with warnings as errors and runs every test; then builds the sanitized preset
# and runs the tests that it has. Installs the Debian packages that are missing. Says little unless
# something fails; the last line is 'N passed, N failed, N skipped', test cases of both together.
#   HIAC_BUILD_DIR   where to build (default build/release; the sanitized build: beside it)
#   HIAC_SANITIZE=0  leaves the sanitized half out
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
build=${HIAC_BUILD_DIR:-$root/build/release}
sanitized=${HIAC_BUILD_DIR:+$HIAC_BUILD_DIR-}sanitize
[ -n "${HIAC_BUILD_DIR:-}" ] || sanitized=$root/build/sanitize
passed=0 failed=0 skipped=0

# Runs a command whose output is shown only when it fails, and then ends everything.
quietly() {
  local log=$1
  shift
  "$@" >"$log" 2>&1 && return
  cat "$log" >&2
  echo "failed: $*" >&2
  exit 1
}

# Configures and builds the preset $1 in folder $2; $3: whether warnings are errors.
build_preset() {
  mkdir -p "$2"
  quietly "$2/configure.log" cmake -S "$root" --preset "$1" -B "$2" -D HIAC_STRICT="$3"
  quietly "$2/build.log" cmake --build "$2" -j "$(nproc)"
}

# Runs the tests of preset $1 in folder $2 and adds them up.
run_tests() {
  local began=$SECONDS p f s
  rm -f "$2/tests.xml"
  # the exit status is that of the tests; the report, read next, tells the same with numbers
  ctest --test-dir "$2" -j "$(nproc)" --timeout 900 --no-tests=error --output-on-failure \
    --output-junit "$2/tests.xml" >"$2/tests.log" 2>&1 || true
  read -r p f s < <(python3 "$root/tests/project/count_tests.py" "$2/tests.xml")
  [ "$f" = 0 ] || grep -v -e ' Passed ' -e '^ *Start ' "$2/tests.log" >&2
  echo "$1: $p passed, $f failed, $s skipped (tests $((SECONDS - began)) s)"
  passed=$((passed + p)) failed=$((failed + f)) skipped=$((skipped + s))
}

"$root/.ci/install"
build_preset release "$build" ON
run_tests release "$build"
if [ "${HIAC_SANITIZE:-1}" != 0 ]; then
  # instrumented code draws false warnings from the compiler
  build_preset sanitize "$sanitized" OFF
  run_tests sanitize "$sanitized"
fi
echo "$passed passed, $failed failed, $skipped skipped"
[ "$failed" = 0 ] && [ "$passed" -gt 0 ]
