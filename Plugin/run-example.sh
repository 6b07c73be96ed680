#!/usr/bin/env bash
# Trims the automotive side panel of the paper's Fig. 9: installs what is missing (Debian 12),
# builds, and leaves the trimmed mesh and pictures in build/example. The summary table goes to
# standard output, everything else to standard error.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/setup.sh"

install_packages >&2
build_project -DBUILD_TESTING=OFF >&2

example="$build/example"
rm -rf "$example"
mkdir -p "$example"
PV_PLUGIN_PATH="$build/lib" sh "$project/Plugin/with-display.sh" \
  pvpython --dr "$project/Plugin/Example/SidePanel.py" "$project/Data" "$example"

echo "The trimmed mesh and the pictures are in $example" >&2
