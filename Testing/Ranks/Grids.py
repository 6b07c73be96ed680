"""What the MPI tests share: a grid in pieces, and its trim held against that of the whole."""
import os
import sys
import traceback

import numpy as np
from nurbstrim import vtkTrimHexahedralGrid
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_ID_TYPE, vtkIdList
from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid
from vtkmodules.vtkFiltersCore import vtkExtractCells
from vtkmodules.vtkFiltersSources import vtkCellTypeSource
from vtkmodules.vtkParallelCore import vtkMultiProcessController

from Checks import COUNTS, check, check_equal

controller = vtkMultiProcessController.GetGlobalController()
RANK = controller.GetLocalProcessId()
RANKS = controller.GetNumberOfProcesses()


def _end_all(*failure):
    """A rank that fails ends the others with it: they would wait for it for ever."""
    traceback.print_exception(*failure)
    sys.stderr.flush()
    os._exit(1)


sys.excepthook = _end_all


def _ids(name, count):
    array = numpy_to_vtk(np.arange(count), deep=1, array_type=VTK_ID_TYPE)
    array.SetName(name)
    return array


def whole_grid(counts=COUNTS):
    """Hexahedra of unit size in x and y, with the ids of their points and cells."""
    source = vtkCellTypeSource()
    source.SetCellType(12)
    source.SetBlocksDimensions(*counts)
    source.SetOutputPrecision(1)
    source.Update()
    grid = source.GetOutput()
    places = vtk_to_numpy(grid.GetPoints().GetData())
    places[:, 2] *= 0.25
    grid.GetPointData().AddArray(_ids("WholePoint", grid.GetNumberOfPoints()))
    grid.GetCellData().AddArray(_ids("WholeCell", grid.GetNumberOfCells()))
    return grid


def extract(grid, cells):
    ids = vtkIdList()
    for cell in cells:
        ids.InsertNextId(int(cell))
    if ids.GetNumberOfIds() == 0:
        return vtkUnstructuredGrid()
    extracted = vtkExtractCells()
    extracted.SetInputData(grid)
    extracted.SetCellList(ids)
    extracted.Update()
    return extracted.GetOutput()


def trim_with(grid, surface, on_all_ranks, correction=2, optimization=2):
    """Both outputs of the filter's class: of this rank's piece, or of a grid that it has alone."""
    trim = vtkTrimHexahedralGrid()
    if not on_all_ranks:
        trim.SetController(None)
    trim.SetInputDataObject(0, grid)
    trim.SetInputDataObject(1, surface)
    trim.SetCorrectionType(correction)
    trim.SetOptimization(optimization)
    trim.Update()
    return trim.GetOutputDataObject(0), trim.GetOutputDataObject(1)


def sum_over_ranks(value):
    total = numpy_to_vtk(np.zeros(1, dtype=np.int64), deep=1)
    controller.AllReduce(numpy_to_vtk(np.array([value], dtype=np.int64), deep=1), total, 2)
    return int(total.GetValue(0))


LOCAL = ("vtkOriginalPointIds", "vtkOriginalCellIds", "vtkGlobalCellIds", "vtkGhostType")


def _same_tuples(whole, places, piece, what):
    for i in range(whole.GetNumberOfArrays()):
        name = whole.GetArrayName(i)
        if name not in LOCAL:
            check(piece.HasArray(name), "%s: no %s" % (what, name))
            expected = vtk_to_numpy(whole.GetArray(name))[places]
            found = vtk_to_numpy(piece.GetArray(name))
            check(expected.tobytes() == found.tobytes(), "%s: %s differs" % (what, name))


def _places(whole_ids, ids):
    """Where each of the ids is found in the whole."""
    place = np.full(max(whole_ids.max(), ids.max()) + 1, -1)
    place[whole_ids] = np.arange(len(whole_ids))
    return place[ids]


def compare(whole, piece, what):
    """A piece of the result against the result of the whole, bit by bit; collective."""
    what = "%s, rank %d of %d" % (what, RANK, RANKS)
    if piece.GetNumberOfCells() > 0:
        ids = [[vtk_to_numpy(grid.GetPointData().GetArray("WholePoint")),
                vtk_to_numpy(grid.GetCellData().GetArray("WholeCell"))] for grid in (whole, piece)]
        points = _places(ids[0][0], ids[1][0])
        cells = _places(ids[0][1], ids[1][1])
        check((points >= 0).all() and (cells >= 0).all(), what + ": more than the whole has")
        expected = vtk_to_numpy(whole.GetPoints().GetData())[points]
        found = vtk_to_numpy(piece.GetPoints().GetData())
        check(expected.tobytes() == found.tobytes(), what + ": places differ")
        _same_tuples(whole.GetPointData(), points, piece.GetPointData(), what)
        _same_tuples(whole.GetCellData(), cells, piece.GetCellData(), what)
        for cell, at in enumerate(cells):
            nodes, expected = vtkIdList(), vtkIdList()
            piece.GetCellPoints(cell, nodes)
            whole.GetCellPoints(int(at), expected)
            found = [points[nodes.GetId(i)] for i in range(nodes.GetNumberOfIds())]
            check_equal(found, [expected.GetId(i) for i in range(expected.GetNumberOfIds())],
                        what + ": nodes of a cell")
    check_equal(sum_over_ranks(piece.GetNumberOfCells()), whole.GetNumberOfCells(),
                what + ": cells of all ranks")


def compare_summaries(whole, piece, what):
    for i in range(whole.GetFieldData().GetNumberOfArrays()):
        array = whole.GetFieldData().GetArray(i)
        if array.GetName() != "NodeBandwidth":
            found = piece.GetFieldData().GetArray(array.GetName())
            check(found, "%s: no %s on rank %d" % (what, array.GetName(), RANK))
            check_equal(repr(found.GetTuple1(0)), repr(array.GetTuple1(0)),
                        "%s: %s" % (what, array.GetName()))
