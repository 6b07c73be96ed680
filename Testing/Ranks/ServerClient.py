"""The same trim here and on a server of several ranks: the same mesh. Argument: the server's port."""
import os
import sys

from paraview import servermanager
from paraview.simple import Connect, Disconnect, RedistributeDataSet, XMLUnstructuredGridReader
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdList
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

from Checks import OUTPUT_DIRECTORY, check, check_equal, summary, trim, wave_at
from Grids import whole_grid

ARRAYS = {"points": ("NodeStatus", "Displacement", "CorrectionApplied"),
          "cells": ("ElementStatus", "EliminatedFraction", "Rescue")}


def add_piece(grid, points, cells):
    """Points and cells by their ids in the input, each with all that has to be the same."""
    point_data, cell_data = grid.GetPointData(), grid.GetCellData()
    point_ids = vtk_to_numpy(point_data.GetArray("WholePoint"))
    places = vtk_to_numpy(grid.GetPoints().GetData())
    for i, point in enumerate(point_ids):
        values = [point_data.GetArray(name).GetTuple(i) for name in ARRAYS["points"]]
        found = (tuple(places[i]), values)
        check_equal(repr(points.setdefault(point, found)), repr(found), "a point of two pieces")
    before = len(cells)
    for i in range(grid.GetNumberOfCells()):
        nodes = vtkIdList()
        grid.GetCellPoints(i, nodes)
        cells[cell_data.GetArray("WholeCell").GetValue(i)] = (
            grid.GetCellType(i), [point_ids[nodes.GetId(k)] for k in range(nodes.GetNumberOfIds())],
            [cell_data.GetArray(name).GetTuple(i) for name in ARRAYS["cells"]])
    check_equal(len(cells) - before, grid.GetNumberOfCells(), "new cells of a piece")


def mesh_of(result, ranks):
    """Of all ranks: without a rank's number only the first one's piece is fetched."""
    points, cells = {}, {}
    for rank in range(ranks):
        piece = servermanager.Fetch(result, rank)
        check(piece.GetNumberOfCells() > 0, "nothing on rank %d" % rank)
        add_piece(piece, points, cells)
    return points, cells


def trimmed(path, ranks):
    pieces = RedistributeDataSet(Input=XMLUnstructuredGridReader(FileName=[path]))
    result = trim(pieces, wave_at(10.3))
    numbers = summary(result)
    numbers.pop("NodeBandwidth")
    return mesh_of(result, ranks), numbers


path = os.path.join(OUTPUT_DIRECTORY, "server-sheet.vtu")
writer = vtkXMLUnstructuredGridWriter()
writer.SetInputDataObject(whole_grid())
writer.SetFileName(path)
writer.SetDataModeToBinary()
check(writer.Write(), "could not write " + path)

(points, cells), numbers = trimmed(path, 1)
Disconnect()
Connect("localhost", int(sys.argv[1]))
check_equal(servermanager.ActiveConnection.GetNumberOfDataPartitions(), 2, "ranks of the server")
(server_points, server_cells), server_numbers = trimmed(path, 2)
check_equal(repr(sorted(server_numbers.items())), repr(sorted(numbers.items())), "summary")
check_equal(len(server_cells), len(cells), "cells")
check_equal(sorted(server_points), sorted(points), "points")
for point in points:
    check_equal(repr(server_points[point]), repr(points[point]), "point %d" % point)
for cell in cells:
    check_equal(repr(server_cells[cell]), repr(cells[cell]), "cell %d" % cell)
print("%d cells on the server as here" % len(cells))
