#!/usr/bin/env bash
# Makes hiac's Debian packages: configures and builds what is packed, without tests, and runs cpack and,
# where it is installed, lintian, whose complaints end the script with 1. The last lines name the packages.
#   packaging/make-packages.sh [FOLDER]    where the packages go (default: build/packages/packages)
#   HIAC_BUILD_DIR                         where to build (default build/packages)
#   DEBEMAIL, DEBFULLNAME                  who answers for the packages, as for Debian's own tools
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
build=${HIAC_BUILD_DIR:-$root/build/packages}
folder=$(realpath -m "${1:-$build/packages}")

"$root/.ci/install"
mkdir -p "$build" "$folder"
log=$build/make-packages.log
echo "building in $build (log: $log)"
if ! { cmake -S "$root" --preset release -B "$build" -D CMAKE_INSTALL_PREFIX=/usr \
         -D HIAC_TESTS=OFF -D HIAC_BENCHMARKS=OFF &&
       cmake --build "$build" -j "$(nproc)" &&
       rm -f "$folder"/*.deb &&
       cpack --config "$build/CPackConfig.cmake" -B "$folder" \
             -D CPACK_OUTPUT_FILE_PREFIX="$folder"; } >"$log" 2>&1
then
  tail -n 40 "$log" >&2
  exit 1
fi
rm -rf "$folder/_CPack_Packages"

if command -v lintian >/dev/null; then
  # a host without a full name cannot be anybody's address
  unnamed=()
  [ -n "${DEBEMAIL:-}" ] || unnamed=(--suppress-tags bogus-mail-host)
  lintian --allow-root --no-cfg --fail-on error,warning "${unnamed[@]}" \
    --suppress-tags-from-file "$root/packaging/debian/lintian-suppressed" "$folder"/*.deb
else
  echo "lintian is not installed: the packages are not judged" >&2
fi
ls "$folder"/*.deb
