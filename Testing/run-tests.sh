#!/usr/bin/env bash
# Installs what is missing (Debian 12), builds with the tests, and runs them. Arguments go to
# ctest, e.g. -L kernel (labels: kernel, reader, filter, fuzz, plugin, ranks, gui) or -R <name>.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../Plugin/setup.sh"

install_packages
build_project -DBUILD_TESTING=ON
cd "$build"
ctest --output-on-failure -j 2 "$@"
