# Runs a command with a display of its own; ends with 77 (skipped) where there is no xvfb-run.
if ! command -v xvfb-run >/dev/null; then
  echo "Skipped: no xvfb-run here; it is in Debian's package xvfb."
  exit 77
fi
exec xvfb-run -a -s "-screen 0 1600x1200x24" "$@"
