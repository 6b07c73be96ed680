"""Writes what the tests of the window open: a sheet of 20 x 12 x 2 elements, and the plane x = 8.3 as
an IGES file; two whose names differ in a number. A block of 36 x 36 x 36 elements, and a plane aslant to
them: with Insert Layer that takes some seconds."""
import os
import sys

from paraview.simple import PassArrays, SaveData, UnstructuredCellTypes

from Checks import DATA_DIRECTORY, OUTPUT_DIRECTORY, sheet

sys.path.insert(0, DATA_DIRECTORY)
from IgesWriter import IgesFile, bspline_surface  # noqa: E402

SaveData(os.path.join(OUTPUT_DIRECTORY, "sheet.vtu"), PassArrays(Input=sheet()), DataMode="Binary")

block = UnstructuredCellTypes(CellType=12, BlocksDimensions=[36] * 3, OutputPrecision=1)
SaveData(os.path.join(OUTPUT_DIRECTORY, "block.vtu"), PassArrays(Input=block), DataMode="Binary")


def write_plane(name, corners):
    file = IgesFile("Plane")
    file.add(128, bspline_surface(corners, [[1.0] * 2] * 2, [0.0, 0.0, 1.0, 1.0],
                                  [0.0, 0.0, 1.0, 1.0], 1, 1), label="PLANE")
    file.write(os.path.join(OUTPUT_DIRECTORY, name))


write_plane("plane.igs", [[(8.3, y, z) for y in (-3.0, 15.0)] for z in (-2.0, 2.0)])
for number in (1, 2):
    write_plane("numbered_%d.igs" % number, [[(number, y, z) for y in (-3.0, 15.0)] for z in (-2.0, 2.0)])
# Through the block's middle, at right angles to (1, 0.6, 0.4).
write_plane("aslant.igs", [[(18.1 - 0.6 * (y - 18.0) - 0.4 * (z - 18.0), y, z) for y in (-90.0, 150.0)]
                           for z in (-90.0, 150.0)])
