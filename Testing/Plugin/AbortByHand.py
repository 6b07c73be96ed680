"""What a user does while a trim works, by the X server's own mouse and keys: he waits until the abort
button beside the progress bar is red, clicks what must do nothing now, and then the button, or Escape.

    AbortByHand.py button|Escape HEIGHT

HEIGHT: of the window, which stands in the screen's upper left corner. Writes what it has done.
"""
import subprocess
import sys
import time

import numpy

from Screen import screen

BROWSER_ROW = 85, 196  # the name of the mesh in the Pipeline Browser
END = time.time() + 60


def xdotool(*arguments):
    subprocess.run(["xdotool", *(str(argument) for argument in arguments)], check=True)


def find_red(top, bottom):
    """The middle of what is red in the window's status bar, None if nothing is."""
    pixels = screen()[top:bottom].astype(int)
    red = (pixels[..., 0] > 150) & (pixels[..., 1:].max(axis=2) < 80)
    rows, columns = numpy.nonzero(red)
    return None if len(rows) < 10 else (int(columns.mean()), top + int(rows.mean()))


how, height = sys.argv[1], int(sys.argv[2])
button = None
while not button:
    if time.time() > END:
        sys.exit("ERROR: the abort button was not enabled")
    button = find_red(height - 28, height)
    time.sleep(0.02)
xdotool("mousemove", *BROWSER_ROW, "click", 1)
if how == "button":
    xdotool("mousemove", *button, "click", 1)
else:
    xdotool("key", how)
print("Pressed: %s" % how, flush=True)
