# Runs a command with a display of its own, rendered in software; ends with 77 (which ctest takes
# for skipped) where there is no Xvfb. Not xvfb-run: two that start together race for one display
# number, while here the server itself takes a free one and tells it when it is ready.
if ! command -v Xvfb >/dev/null; then
  echo "Not run: no Xvfb here; it is in Debian's package xvfb." >&2
  exit 77
fi
directory=$(mktemp -d)
mkfifo "$directory/number"
# -noreset: ParaView opens a connection to probe OpenGL and closes it again; a server that resets
# itself after its last client may refuse the next one.
Xvfb -displayfd 3 -fbdir "$directory" -noreset -screen 0 1600x1200x24 -nolisten tcp \
  3>"$directory/number" >"$directory/log" 2>&1 &
server=$!
trap 'kill $server 2>/dev/null; rm -rf "$directory"' EXIT
trap 'exit 143' INT TERM
if ! read -r number <"$directory/number"; then
  echo "Xvfb did not start:" >&2
  cat "$directory/log" >&2
  exit 1
fi
DISPLAY=":$number" NURBSTRIM_FRAMEBUFFER="$directory/Xvfb_screen0" LIBGL_ALWAYS_SOFTWARE=1 "$@"
