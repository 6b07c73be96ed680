"""Every way to bring a surface to the second port gives the same trim: a source, a .vtp or .vtm file,
a series of them in time, a composite data set of one, and a shell of faces."""
import os

from paraview.simple import (GroupDatasets, NURBSSurfaceSource, OpenDataFile, SaveData,
                             XMLPolyDataReader)
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline

from Checks import (OUTPUT_DIRECTORY, check, check_equal, fetch, plane_at, same_grids, sheet,
                    summary, trim, wave_at)


def half_plane(y_from, y_to):
    """A part of the plane x = 10.3 as a face of its own."""
    corners = [(10.3, y_from, -2), (10.3, y_to, -2), (10.3, y_from, 2), (10.3, y_to, 2)]
    return NURBSSurfaceSource(Degrees=[1, 1], ControlNetSize=[2, 2],
                              ControlPoints=[c for corner in corners for c in corner + (1.0,)],
                              KnotsU=[0, 0, 1, 1], KnotsV=[0, 0, 1, 1])


def check_files(expected):
    surface = wave_at(10.3)
    group = GroupDatasets(Input=[surface])
    same_grids(fetch(trim(sheet(), group)), expected, "composite of one")
    for name, written in (("wave.vtp", surface), ("wave.vtm", group)):
        path = os.path.join(OUTPUT_DIRECTORY, name)
        SaveData(path, written, DataMode="Binary")
        same_grids(fetch(trim(sheet(), OpenDataFile(path))), expected, name)


def check_composite_output():
    """A composite on the second port must not make the outputs composite."""
    result = trim(sheet(), GroupDatasets(Input=[wave_at(10.3)]))
    for port in (0, 1):
        check_equal(fetch(result, port).GetClassName(), "vtkUnstructuredGrid", "port %d" % port)


def check_shell():
    """Two faces that meet at an edge are one surface."""
    whole = summary(trim(sheet(), plane_at(10.3)))
    shell = summary(trim(sheet(), GroupDatasets(Input=[half_plane(-3, 5.2), half_plane(5.2, 15)])))
    for name in ("Kept", "Eliminated", "Treated", "MovedNodes"):
        check_equal(shell[name], whole[name], name + " by two faces")
    check(shell["MaximumDistanceToSurface"] < 1e-8, "nodes off the shell")


def check_times():
    """A surface that moves in time trims a mesh that does not, anew at each of its times."""
    places = (8.3, 10.3, 12.3)
    paths = [os.path.join(OUTPUT_DIRECTORY, "plane%d.vtp" % i) for i in range(len(places))]
    for path, place in zip(paths, places):
        SaveData(path, plane_at(place), DataMode="Binary")
    result = trim(sheet(), XMLPolyDataReader(FileName=paths))
    trimmed = result.GetClientSideObject()
    times = trimmed.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS())
    check_equal(times, (0.0, 1.0, 2.0), "times of the result")
    for time, place in enumerate(places):
        result.UpdatePipeline(time)
        grid = trimmed.GetOutputDataObject(0)
        same_grids(grid, fetch(trim(sheet(), plane_at(place))), "time %d" % time)
        check_equal(grid.GetInformation().Get(vtkDataObject.DATA_TIME_STEP()), float(time),
                    "time that the result is of")


check_files(fetch(trim(sheet(), wave_at(10.3))))
check_composite_output()
check_shell()
check_times()
