#!/usr/bin/env bash
# Draws the pictures of the window and of the help pages anew: those of the window come from the
# tests that drive it. Wants a build with tests in build/. (side-panel.png and correction-types.png
# are trimmed.png and correction-types.png of Plugin/run-example.sh, made smaller.)
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../setup.sh"

images="$project/Plugin/Documentation/Images"
output="$build/Testing/Plugin/Output"
ctest --test-dir "$build" -L gui
cp "$output/window-statuses.png" "$images/window.png"
cp "$output/window-comparison.png" "$images/comparison.png"
PV_PLUGIN_PATH="$build/lib" sh "$project/Plugin/with-display.sh" \
  pvpython --dr "$project/Plugin/Documentation/HelpPictures.py"
