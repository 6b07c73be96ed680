"""As a user does it, on several ranks: a file, Redistribute DataSet, ghost cells, the trim."""
import os

from paraview.simple import (CADSurfaceReader, GenerateGlobalIds, GhostCellsGenerator, RedistributeDataSet,
                             TrimHexahedralGrid, XMLMultiBlockDataReader, XMLPolyDataReader,
                             XMLUnstructuredGridReader)
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import (vtkXMLMultiBlockDataWriter, vtkXMLPolyDataWriter,
                                 vtkXMLUnstructuredGridWriter)

from Checks import DATA_DIRECTORY, OUTPUT_DIRECTORY, check, check_equal, wave_at
from Grids import (RANK, RANKS, compare, compare_summaries, controller, sum_over_ranks, trim_with,
                   whole_grid)


def output_of(proxy, port=0):
    proxy.UpdatePipeline()
    return proxy.GetClientSideObject().GetOutputDataObject(port)


def whole_output_of(source):
    """What a source gives to one rank alone; through the pipeline the others may get nothing."""
    algorithm = source.GetClientSideObject()
    algorithm.UpdatePiece(0, 1, 0)
    data = algorithm.GetOutputDataObject(0)
    copy = data.NewInstance()
    copy.DeepCopy(data)
    return copy


def write(writer, data, name):
    """By rank 0, in a mode that this ParaView can read; the others wait for it."""
    path = os.path.join(OUTPUT_DIRECTORY, "%d-%s" % (RANKS, name))
    if RANK == 0:
        writer.SetInputDataObject(data)
        writer.SetFileName(path)
        writer.SetDataModeToBinary()
        check(writer.Write(), "could not write " + path)
    controller.Barrier()
    return path


def check_trim(pieces, grid, surface, what):
    trim = TrimHexahedralGrid(Input=pieces, TrimmingSurface=surface)
    piece = [output_of(trim), output_of(trim, 1)]
    whole = trim_with(grid, whole_output_of(surface), False)
    check(0 < whole[0].GetNumberOfCells() < grid.GetNumberOfCells(), what + " cuts nothing")
    for port in (0, 1):
        compare(whole[port], piece[port], "%s, port %d" % (what, port))
        ghosts = piece[port].GetCellData().GetArray("vtkGhostType")
        check(not ghosts or not vtk_to_numpy(ghosts).any(), what + ": ghosts are left")
    compare_summaries(whole[0], piece[0], what)
    return piece[0]


def check_sheet():
    grid = whole_grid()
    path = write(vtkXMLUnstructuredGridWriter(), grid, "sheet.vtu")
    pieces = RedistributeDataSet(Input=XMLUnstructuredGridReader(FileName=[path]))
    counts = output_of(pieces).GetNumberOfCells()
    check(RANKS == 1 or counts < grid.GetNumberOfCells(), "the sheet is not distributed")
    check_equal(sum_over_ranks(counts), grid.GetNumberOfCells(), "cells of all ranks")
    wave = wave_at(10.3)
    check_trim(pieces, grid, wave, "pieces")

    ghosts = GhostCellsGenerator(Input=pieces, BuildIfRequired=0, MinimumNumberOfGhosts=2)
    with_ghosts = sum_over_ranks(output_of(ghosts).GetNumberOfCells())
    check(RANKS == 1 or with_ghosts > grid.GetNumberOfCells(), "there are no ghost cells")
    check_trim(ghosts, grid, wave, "pieces with ghost cells")

    # A surface from a file, which a reader would give to one rank alone.
    path = write(vtkXMLPolyDataWriter(), whole_output_of(wave), "wave.vtp")
    check_trim(pieces, grid, XMLPolyDataReader(FileName=[path]), "surface in a .vtp file")
    check_global_ids(pieces, wave)


def check_global_ids(pieces, surface):
    """Each node keeps the id that it has in the input."""
    ids = GenerateGlobalIds(Input=pieces)
    before = output_of(ids)
    after = output_of(TrimHexahedralGrid(Input=ids, TrimmingSurface=surface))
    if after.GetNumberOfPoints() > 0:
        check(after.GetPointData().GetGlobalIds(), "the global ids are lost")
        original = vtk_to_numpy(after.GetPointData().GetArray("vtkOriginalPointIds"))
        check((vtk_to_numpy(after.GetPointData().GetGlobalIds()) ==
               vtk_to_numpy(before.GetPointData().GetGlobalIds())[original]).all(),
              "the global ids are wrong")


def check_shell():
    """A CAD file of many faces, read on each rank; and the blocks of a .vtm file."""
    grid = whole_grid((80, 55, 1))
    points = vtk_to_numpy(grid.GetPoints().GetData())
    points[:, :2] *= 20
    path = write(vtkXMLUnstructuredGridWriter(), grid, "panel.vtu")
    pieces = RedistributeDataSet(Input=XMLUnstructuredGridReader(FileName=[path]))
    outside = CADSurfaceReader(FileName=os.path.join(DATA_DIRECTORY, "SidePanelOuter.igs"))
    check_trim(pieces, grid, outside, "CAD file")
    path = write(vtkXMLMultiBlockDataWriter(), whole_output_of(outside), "outside.vtm")
    check_trim(pieces, grid, XMLMultiBlockDataReader(FileName=[path]), "surface in a .vtm file")


check_sheet()
check_shell()
print("rank %d of %d: trimmed like the whole" % (RANK, RANKS))
