"""Trims a mesh of hexahedra along a line through a list of points.

    PV_PLUGIN_PATH=build/lib pvpython TrimByPoints.py mesh.vtu points.csv result.vtu [--open]

points.csv holds a point x, y, z in each line; lines that are not three numbers, like a header, are
skipped. The line is closed, and what it encloses is cut out; with --open it runs from border to
border, and what lies to its right is cut away. It is swept along the normal that the mesh has there,
through all of it. The exit status is 1, and standard error says why, if that fails.
"""
import sys

from paraview.simple import OpenDataFile, SaveData, TrimHexahedralGrid, TrimLineSource


def read_points(path):
    points = []
    with open(path) as file:
        for line in file:
            try:
                x, y, z = (float(word) for word in line.split(","))
            except ValueError:
                continue
            points.append((x, y, z))
    return points


def cut(mesh_file, points, closed):
    try:
        mesh = OpenDataFile(mesh_file)
    except RuntimeError as error:
        sys.exit(str(error))
    flat = [coordinate for point in points for coordinate in point]
    line = TrimLineSource(Points=flat, Closed=closed, Sheet=mesh)
    result = TrimHexahedralGrid(Input=mesh, TrimmingSurface=line)
    result.UpdatePipeline()
    return result


def main(mesh_file, points_file, result_file, option="--closed"):
    points = read_points(points_file)
    closed = option != "--open"
    if len(points) < (3 if closed else 2):
        sys.exit("%s holds %d points, too few for a line" % (points_file, len(points)))
    result = cut(mesh_file, points, closed)
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
