"""Trims a mesh of hexahedra with the surface in an IGES or STEP file.

    PV_PLUGIN_PATH=build/lib pvpython TrimWithSurface.py mesh.vtu surface.igs result.vtu
    PV_PLUGIN_PATH=build/lib pvpython TrimWithSurface.py mesh.vtu surface.igs result.vtu \\
        --keep 100 50 0 --type 3 --unit Inch

Writes the trimmed mesh and prints the summary. The exit status is 1, and standard error says why,
if a file cannot be read or the trim fails.
"""
import argparse
import math
import os
import re
import sys

from paraview.simple import CADSurfaceReader, OpenDataFile, TrimHexahedralGrid

import ResultFile


def arguments():
    parser = argparse.ArgumentParser(description="Trims a mesh with an IGES or STEP surface.")
    parser.add_argument("mesh", help="hexahedra, in any format that ParaView reads")
    parser.add_argument("surface", help="IGES or STEP file")
    parser.add_argument("result", help="the .vtu file to write")
    parser.add_argument("--type", type=int, choices=(1, 2, 3), default=2, help="correction type")
    parser.add_argument("--keep", type=float, nargs=3, metavar=("X", "Y", "Z"),
                        help="a point on the side that stays (default: the surface's normal says)")
    parser.add_argument("--unit", default="Millimetre", help="unit of the mesh",
                        choices=["Millimetre", "Centimetre", "Metre", "Inch", "Foot", "Micrometre"])
    # pvpython makes --100 of a -100, and warns of it. A blank, as -1e-5 would be an option.
    return parser.parse_args([re.sub(r"^--?(?=[.\d])", " -", word) for word in sys.argv[1:]])


def trim(options):
    for path in (options.mesh, options.surface):
        if not os.path.isfile(path):
            sys.exit("There is no file " + path)
    if not ResultFile.can_be(options.result):
        sys.exit("The result is a .vtu file in a directory that exists, not " + options.result)
    try:
        mesh = OpenDataFile(options.mesh)
    except RuntimeError as error:
        sys.exit(str(error))
    surface = CADSurfaceReader(FileName=options.surface, LengthUnit=options.unit)
    result = TrimHexahedralGrid(Input=mesh, TrimmingSurface=surface, CorrectionType=options.type)
    if options.keep:
        result.UseKeepPoint = 1
        result.KeepPoint = options.keep
    result.UpdatePipeline()
    # Errors are printed by the filter; a trim that failed has no output.
    if result.GetDataInformation().GetNumberOfCells() == 0:
        sys.exit("Nothing is left of " + options.mesh)
    return result


def main():
    options = arguments()
    result = trim(options)
    for name in result.FieldData.keys():
        low, high = result.FieldData[name].GetRange(0)
        # Upside down, that of NaN: no element was touched that could be measured.
        print("%-32s %.9g" % (name, low if low <= high else math.nan))
    ResultFile.save(result, options.result)


if __name__ == "__main__":
    main()
