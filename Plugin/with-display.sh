# Runs a command with a display of its own, rendered in software; ends with 77 (which ctest takes
# for skipped) where there is no xvfb-run.
if ! command -v xvfb-run >/dev/null; then
  echo "Not run: no xvfb-run here; it is in Debian's package xvfb." >&2
  exit 77
fi
# Starting from different numbers, commands that run at the same time do not race for one display.
LIBGL_ALWAYS_SOFTWARE=1 exec xvfb-run -a -n $((100 + $$ % 800)) -s "-screen 0 1600x1200x24" "$@"
