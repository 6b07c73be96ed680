"""Trims a mesh of hexahedra along a line through a list of points.

    PV_PLUGIN_PATH=build/lib pvpython TrimByPoints.py mesh.vtu points.csv result.vtu [--open]

points.csv holds a point x, y, z in each line, parted by commas, semicolons or blanks, perhaps under a
header; the curves of an IGES or STEP file will do as well. The line is closed, and what it encloses
is cut out; with --open it runs from border to border, and what lies to its right is cut away. It is
swept along the normal that the mesh has there, through all of it. The exit status is 1, and standard
error says why, if that fails.
"""
import argparse
import sys

from paraview.simple import OpenDataFile, TrimHexahedralGrid, TrimLineSource

import ResultFile


def arguments():
    parser = argparse.ArgumentParser(description="Trims a mesh along a line through points.")
    parser.add_argument("mesh", help="hexahedra, in any format that ParaView reads")
    parser.add_argument("points", help="a CSV file of points, or an IGES or STEP file of curves")
    parser.add_argument("result", help="the .vtu file to write")
    parser.add_argument("--open", action="store_true",
                        help="the line runs from border to border; what lies to its right goes")
    return parser.parse_args()


def cut(mesh_file, points_file, closed):
    try:
        mesh = OpenDataFile(mesh_file)
    except RuntimeError as error:
        sys.exit(str(error))
    line = TrimLineSource(FileName=points_file, Closed=closed, Sheet=mesh)
    line.UpdatePipeline()
    if line.GetDataInformation().GetNumberOfPoints() == 0:
        sys.exit("There is no line in " + points_file)
    result = TrimHexahedralGrid(Input=mesh, TrimmingSurface=line)
    result.UpdatePipeline()
    return result


def main():
    options = arguments()
    if not ResultFile.can_be(options.result):
        sys.exit("The result is a .vtu file in a directory that exists, not " + options.result)
    result = cut(options.mesh, options.points, not options.open)
    information = result.GetDataInformation()
    if information.GetNumberOfCells() == 0:
        sys.exit("Nothing is left of " + options.mesh)
    volume = result.FieldData["Volume"].GetRange(0)[0]
    print("%d elements left, volume %.9g" % (information.GetNumberOfCells(), volume))
    ResultFile.save(result, options.result)


if __name__ == "__main__":
    main()
