"""Writes what the tests of the window open: a sheet of 20 x 12 x 2 elements, and the plane x = 8.3 as
an IGES file."""
import os
import sys

from paraview.simple import PassArrays, SaveData

from Checks import DATA_DIRECTORY, OUTPUT_DIRECTORY, sheet

sys.path.insert(0, DATA_DIRECTORY)
from IgesWriter import IgesFile, bspline_surface  # noqa: E402

SaveData(os.path.join(OUTPUT_DIRECTORY, "sheet.vtu"), PassArrays(Input=sheet()), DataMode="Binary")

rows = [[(8.3, y, z) for y in (-3.0, 15.0)] for z in (-2.0, 2.0)]
file = IgesFile("Plane")
file.add(128, bspline_surface(rows, [[1.0] * 2] * 2, [0.0, 0.0, 1.0, 1.0], [0.0, 0.0, 1.0, 1.0],
                              1, 1), label="PLANE")
file.write(os.path.join(OUTPUT_DIRECTORY, "plane.igs"))
