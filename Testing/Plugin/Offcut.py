"""The third output: empty unless asked for; with it both parts are the whole; lancing."""
import os
import subprocess

from paraview.simple import OutputPort, SaveData, XMLUnstructuredGridReader
from vtkmodules.util.numpy_support import vtk_to_numpy

from Checks import (ELEMENT_COUNT, LENGTHS, OUTPUT_DIRECTORY, arrays_of, check, check_close,
                    check_equal, fetch, plane_at, same_grids, sheet, summary, trim, wave_at)

EXAMPLES = os.environ["NURBSTRIM_EXAMPLES"]


def volume(grid):
    return grid.GetFieldData().GetArray("Volume").GetValue(0)


def check_parts(surface, pentahedra):
    plain = trim(sheet(), surface)
    check_equal(fetch(plain, 2).GetNumberOfCells(), 0, "elements of an offcut not asked for")
    SaveData(os.path.join(OUTPUT_DIRECTORY, "nothing.vtu"), OutputPort(plain, 2), DataMode="Binary")
    both = trim(sheet(), surface, ProduceOffcut=1)
    kept, offcut = fetch(both), fetch(both, 2)
    same_grids(fetch(plain), kept, "trimmed grid without and with the offcut")
    check_close(volume(kept) + volume(offcut), LENGTHS[0] * LENGTHS[1] * LENGTHS[2], "volumes", 1e-12)
    found = {name: offcut.GetFieldData().GetArray(name).GetValue(0)
             for name in ("TouchedElements", "CertifiedElements", "MinimumScaledJacobian")}
    check(found["TouchedElements"] > 0, "no touched element")
    check_equal(found["CertifiedElements"], found["TouchedElements"], "certified elements")
    check(found["MinimumScaledJacobian"] >= 0.2, "below the floor")
    rests = offcut.GetNumberOfCells() + kept.GetNumberOfCells() - ELEMENT_COUNT
    check(rests >= summary(both)["Wedges"], "the rests of wedges")
    check_equal(summary(both)["Wedges"] > 0, pentahedra, "wedges")
    for name in ("Feasibility", "Shortfall", "ElementStatus", "vtkOriginalCellIds"):
        check(name in arrays_of(offcut.GetCellData()), "no %s on port 2" % name)


def check_lancing():
    example = os.path.join(EXAMPLES, "Lancing.py")
    subprocess.run(["pvpython", example, OUTPUT_DIRECTORY], check=True)
    reader = XMLUnstructuredGridReader(FileName=[os.path.join(OUTPUT_DIRECTORY, "lanced.vtu")])
    reader.UpdatePipeline()
    grid = fetch(reader)
    part = vtk_to_numpy(grid.GetCellData().GetArray("Part"))
    check(set(part) == {0, 1}, "parts: %s" % set(part))
    # Each node of the cut is there twice, at one place; no other is.
    origin = vtk_to_numpy(grid.GetPointData().GetArray("vtkOriginalPointIds"))
    places = vtk_to_numpy(grid.GetPoints().GetData())
    twice = {}
    for i, node in enumerate(origin):
        twice.setdefault(node, []).append(i)
    pairs = [pair for pair in twice.values() if len(pair) > 1]
    check(len(pairs) > 100 and all(len(pair) == 2 for pair in pairs), "nodes along the slit")
    for a, b in pairs:
        check((places[a] == places[b]).all(), "a node of the slit is at two places")


check_parts(plane_at(10.3), False)
check_parts(wave_at(10.3), True)
check_lancing()
