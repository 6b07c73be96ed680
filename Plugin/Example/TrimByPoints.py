"""Trims a mesh of hexahedra along a line through a list of points.

    PV_PLUGIN_PATH=build/lib pvpython TrimByPoints.py mesh.vtu points.csv result.vtu [--open]

points.csv holds a point x, y, z in each line, parted by commas, semicolons or blanks, perhaps under a
header; the curves of an IGES or STEP file will do as well. The line is closed, and what it encloses
is cut out; with --open it runs from border to border, and what lies to its right is cut away. It is
swept along the normal that the mesh has there, through all of it. The exit status is 1, and standard
error says why, if that fails.
"""
import sys

from paraview.simple import OpenDataFile, SaveData, TrimHexahedralGrid, TrimLineSource


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


def main(mesh_file, points_file, result_file, option="--closed"):
    result = cut(mesh_file, points_file, option != "--open")
    information = result.GetDataInformation()
    if information.GetNumberOfCells() == 0:
        sys.exit("Nothing is left of " + mesh_file)
    volume = result.FieldData["Volume"].GetRange(0)[0]
    print("%d elements left, volume %.9g" % (information.GetNumberOfCells(), volume))
    # Not the default mode: Debian 12's ParaView cannot read back its own appended raw data.
    SaveData(result_file, proxy=result, DataMode="Binary")


if __name__ == "__main__":
    if len(sys.argv) not in (4, 5):
        sys.exit(__doc__)
    main(*sys.argv[1:])
