"""The filter on a sheet in pieces, one a rank: seconds on the clock until the last one is done.

Under MPI; the argument is the number of elements of the whole. A rank that waits for others is
busy waiting, so processor time would tell nothing; this wants as many idle cores as ranks.
"""
import math
import sys
import time

import numpy as np
from nurbstrim import vtkTrimHexahedralGrid
from paraview.simple import NURBSSurfaceSource
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkFiltersSources import vtkCellTypeSource
from vtkmodules.vtkParallelCore import vtkMultiProcessController

LAYERS, THICKNESS, ROUNDS = 2, 0.4, 5
controller = vtkMultiProcessController.GetGlobalController()
rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()
side = round(math.sqrt(int(sys.argv[1]) / LAYERS))


def make_piece():
    """Rows of elements across the cut, so that every rank has its share of it."""
    first, last = side * rank // ranks, side * (rank + 1) // ranks
    source = vtkCellTypeSource()
    source.SetCellType(12)
    source.SetBlocksDimensions(side, last - first, LAYERS)
    source.SetOutputPrecision(1)
    source.Update()
    places = vtk_to_numpy(source.GetOutput().GetPoints().GetData())
    places[:, 1] += first
    places[:, 2] *= THICKNESS
    return source.GetOutput()


def knots(count):
    return [0.0] * 4 + [i / (count - 3) for i in range(1, count - 3)] + [1.0] * 4


def greville(count):
    of = knots(count)
    return [sum(of[i + 1:i + 4]) / 3 for i in range(count)]


def make_wave(shift):
    """The wavy bicubic of 12 x 8 control points that BenchmarkTrim cuts with."""
    points = []
    for j, v in enumerate(greville(8)):
        for i, u in enumerate(greville(12)):
            x = side * (0.5 + shift + 0.04 * math.sin(2.1 * i)) + 0.02 * math.sin(1.7 * j)
            points += [x, side * (1.1 * u - 0.05), THICKNESS * LAYERS * (3 * v - 1), 1.0]
    source = NURBSSurfaceSource(Degrees=[3, 3], ControlNetSize=[12, 8], ControlPoints=points,
                                KnotsU=knots(12), KnotsV=knots(8)).GetClientSideObject()
    source.UpdatePiece(0, 1, 0)
    return source.GetOutputDataObject(0)


def slowest(seconds):
    """The largest of all ranks."""
    largest = numpy_to_vtk(np.zeros(1), deep=1)
    controller.AllReduce(numpy_to_vtk(np.array([seconds]), deep=1), largest, 0)
    return largest.GetValue(0)


def timed(action):
    controller.Barrier()
    start = time.perf_counter()
    action()
    return slowest(time.perf_counter() - start)


piece, waves = make_piece(), [make_wave(0.0), make_wave(0.01)]
first, again = [], []
for _ in range(ROUNDS):
    trim = vtkTrimHexahedralGrid()
    trim.SetRenumberNodes(False)
    trim.SetInputDataObject(0, piece)
    trim.SetInputDataObject(1, waves[0])
    first.append(timed(trim.Update))
    trim.SetInputDataObject(1, waves[1])
    again.append(timed(trim.Update))
if rank == 0:
    print("%d elements, %d rank%s: first run %.3f s, only the surface moved %.3f s" %
          (side * side * LAYERS, ranks, "s" if ranks > 1 else "", min(first), min(again)))
