#!/usr/bin/env bash
# Installs what is missing (Debian 12), builds Release with the benchmarks, and runs them.
# Arguments: names of benchmarks (ClosestPoint, LineIntersection, Trim, Ranks, Window); none: all.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../Plugin/setup.sh"

install_packages "$project/Testing/Benchmarks/debian-packages.txt"
configure_project -DBUILD_TESTING=ON -DNURBSTRIM_BENCHMARKS=ON
cmake --build "$build" --target benchmarks
if [ $# -eq 0 ]; then
  set -- ClosestPoint LineIntersection Trim Ranks Window
fi
# The real window, with nothing of the user's own settings.
run_window() (
  export NURBSTRIM_DATA="$project/Data" NURBSTRIM_OUTPUT="$build/benchmark-window"
  export PYTHONPATH="$project/Testing/Plugin:$project/Testing/Benchmarks"
  export PV_PLUGIN_PATH="$build/lib" HOME="$NURBSTRIM_OUTPUT"
  mkdir -p "$NURBSTRIM_OUTPUT"
  sh "$project/Plugin/with-display.sh" python3 "$project/Testing/Benchmarks/BenchmarkWindow.py"
)
# One rank and two, under MPI.
run_ranks() (
  export PV_PLUGIN_PATH="$build/lib" PYTHONPATH="$build/lib/python" HOME="$build/benchmark-ranks"
  mkdir -p "$HOME"
  for ranks in 1 2; do
    mpiexec --allow-run-as-root --oversubscribe --bind-to none -n "$ranks" \
      pvbatch --sym "$project/Testing/Benchmarks/BenchmarkRanks.py" 1000000
  done
)
for benchmark in "$@"; do
  echo "=== $benchmark"
  case "$benchmark" in
    Window) run_window ;;
    Ranks) run_ranks ;;
    *) "$build/bin/Benchmark$benchmark" ;;
  esac
done
