#!/usr/bin/env bash
# The long series of damaged input: run-fuzz.sh [files [surfaces [grids [seed]]]], one process a
# core. Files go through the CAD reader, surfaces and grids through the filter; a table of each
# part is printed, and the exit status is 0 only if all of it is as it should be.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../Plugin/setup.sh"

seed=${4:-1}
install_packages
build_project -DBUILD_TESTING=ON
cores=$(nproc)
failed=0
# run_series program count
run_series()
{
  local part pids=()
  for ((part = 0; part < cores; ++part)); do
    nice "$build/bin/$1" "$2" "$seed" "$part" "$cores" > "$build/$1-$part.txt" 2>&1 &
    pids+=($!)
  done
  for part in "${!pids[@]}"; do
    wait "${pids[$part]}" || failed=1
    echo "$1, part $((part + 1)) of $cores"
    cat "$build/$1-$part.txt"
  done
}
run_series FuzzFiles "${1:-100000}"
run_series FuzzSurfaces "${2:-20000}"
run_series FuzzGrids "${3:-20000}"
exit $failed
