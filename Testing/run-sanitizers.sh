#!/usr/bin/env bash
# The tests under sanitizers, in a build of their own (build-address, build-thread):
# run-sanitizers.sh address|thread [argument of ctest...]. Only what neither Python nor ParaView's
# window has a part in: they would have to be started with the sanitizer's library.
# address: all tests of kernel, reader, filter and fuzz; in a shorter form the random campaign, the
# fuzzed files and the matrix (Testing/CMakeLists.txt), and of the repeated runs with several threads
# only those on large grids.
# thread: what shares work out among threads, on grids large enough for every loop to be shared.
# Reports go to build-<name>/reports, one file a process, also those of forked readers, whose
# output is silenced; what is VTK's or OpenCASCADE's own is suppressed, with reasons, in
# Testing/Sanitizers.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../Plugin/setup.sh"

sanitizer=${1:?address or thread}
shift
build="$project/build-$sanitizer"
reports="$build/reports"
rules="$project/Testing/Sanitizers"
install_packages
cmake -S "$project" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_FLAGS=-O2 \
  -DPython3_EXECUTABLE=/usr/bin/python3 -DBUILD_TESTING=ON "-DNURBSTRIM_SANITIZER=$sanitizer"
targets=(Testing/Support/all Testing/Geometry/all Testing/Read/all Testing/Filters/all Testing/Fuzz/all)
tests=(-L 'kernel|reader|filter|fuzz' -E 'TrimDeterminism-small')
if [ "$sanitizer" = thread ]; then
  targets=(TestGeometryThreads TestSkin TestArrayRanges TestThreadTeam TestTreatmentParts
    TestTrimDeterminism)
  tests=(-R '^(GeometryThreads|Skin|TrimArrayRanges|TrimThreadTeam|TrimTreatmentParts|TrimDeterminism-large)$')
  export VTK_SMP_BACKEND_IN_USE=STDThread VTK_SMP_MAX_THREADS=4
fi
cmake --build "$build" --target "${targets[@]}"

rm -rf "$reports"
mkdir -p "$reports"
export ASAN_OPTIONS="log_path=$reports/address:detect_leaks=1"
export LSAN_OPTIONS="suppressions=$rules/leaks.txt:print_suppressions=0"
export UBSAN_OPTIONS="print_stacktrace=1"
export TSAN_OPTIONS="log_path=$reports/thread:suppressions=$rules/threads.txt"
cd "$build"
status=0
ctest --output-on-failure -j 2 --timeout 3600 "${tests[@]}" "$@" || status=$?
if [ -n "$(ls "$reports")" ]; then
  echo "Reports:"
  cat "$reports"/*
  status=1
fi
exit "$status"
