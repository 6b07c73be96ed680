#!/usr/bin/env bash
# Installs what is missing (Debian 12), builds Release with the benchmarks, and runs them.
# Arguments: names of benchmarks, e.g. ClosestPoint; none: all.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../Plugin/setup.sh"

install_packages "$project/Testing/Benchmarks/debian-packages.txt"
configure_project -DBUILD_TESTING=ON -DNURBSTRIM_BENCHMARKS=ON
cmake --build "$build" --target benchmarks
if [ $# -eq 0 ]; then
  set -- "$build"/bin/Benchmark*
else
  set -- "${@/#/$build/bin/Benchmark}"
fi
for benchmark in "$@"; do
  echo "=== $(basename "$benchmark")"
  "$benchmark"
done
