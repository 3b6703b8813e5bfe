#!/bin/sh
# Runs every reader's target of libFuzzer, one after the other, and says what each did: inputs,
# edges of the program reached, findings. Ends with 1 when there was a finding.
#
#   tests/fuzz/run.sh SECONDS [READER ...]     (none given: all)
#
# Builds the preset `fuzz` (clang) first. What a target has learnt stays in
# build/fuzz/corpus/READER; what it has found lies in build/fuzz/findings. Small files of the folder
# HIAC_DATA_DIR are tried besides.
set -eu

seconds=${1:?SECONDS [READER ...]}
shift
cd "$(dirname "$0")/../.."
readers=${*:-abaqus ansys classic-netcdf d3plot ensight frd gambit gmsh medit mfem nastran netgen \
  obj off openfoam plot3d ply points poly pvd pvti pvtr pvts pvtu stl su2 tecplot tetgen ucd \
  ugrid unv vti vtk vtm vtp vtr vts vtu vtu-surface xdmf zoo zparts}

[ -f build/fuzz/build.ninja ] || cmake --preset fuzz > /dev/null
cmake --build build/fuzz --target fuzz_formats > /dev/null

# what VTK and glibc keep for good is not looked at: leaks are found by the sanitized tests
export ASAN_OPTIONS=detect_leaks=0:allocator_may_return_null=0 UBSAN_OPTIONS=print_stacktrace=1
findings=build/fuzz/findings
mkdir -p "$findings"
failed=0
for reader in $readers; do
  corpus=build/fuzz/corpus/$reader
  mkdir -p "$corpus"
  data=
  for folder in $(ls -d "${HIAC_DATA_DIR:-../shared/data}/$reader" 2> /dev/null); do
    mkdir -p "build/fuzz/data/$reader"
    find "$folder" -type f -size -5k -exec cp -f {} "build/fuzz/data/$reader" \;
    data=build/fuzz/data/$reader
  done
  log=build/fuzz/$reader.log
  # a file's size is what memory may depend on: none of these needs a third of a gigabyte
  status=ok
  HIAC_FUZZ_FORMAT=$reader build/fuzz/tests/fuzz/fuzz_formats -max_total_time="$seconds" \
    -max_len=4096 -timeout=20 -rss_limit_mb=3000 -malloc_limit_mb=300 \
    -print_final_stats=1 -artifact_prefix="$findings/$reader-" "$corpus" $data > "$log" 2>&1 ||
    status=FOUND
  [ "$status" = ok ] || failed=1
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  edges=$(grep -o 'cov: [0-9]*' "$log" | tail -1)
  printf '%-15s %-6s %9s inputs, %s edges\n' "$reader" "$status" "${runs:-?}" "${edges#cov: }"
done
exit $failed
