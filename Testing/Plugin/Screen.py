"""The pixels of the display that Plugin/with-display.sh has started."""
import os
import struct

import numpy


def screen():
    """The pixels of the screen, rows x columns x RGB, from the display's frame buffer file."""
    with open(os.environ["NURBSTRIM_FRAMEBUFFER"], "rb") as file:
        data = file.read()
    # The X window dump format: a header of big-endian 32 bit words, the colour map, the pixels.
    header = struct.unpack(">25I", data[:100])
    size, width, height, stride, colors = header[0], header[4], header[5], header[12], header[19]
    pixels = numpy.frombuffer(data, numpy.uint8, stride * height, size + 12 * colors)
    return pixels.reshape(height, stride // 4, 4)[:, :width, 2::-1]
