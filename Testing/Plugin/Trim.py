"""A trim through the pipeline: numbers known on paper, arrays and types of the contract."""
import os
import re

from paraview.simple import OutputPort, ProgrammableFilter
from vtkmodules.util.numpy_support import vtk_to_numpy

from Checks import (COUNTS, DATA_DIRECTORY, LENGTHS, arrays_of, check, check_close, check_equal, fetch, plane_at,
                    sheet, summary, trim, wave_at)

ELEMENTS = COUNTS[0] * COUNTS[1] * COUNTS[2]
PER_COLUMN = COUNTS[1] * COUNTS[2]
NODES_PER_COLUMN = (COUNTS[1] + 1) * (COUNTS[2] + 1)
SECTION = LENGTHS[1] * LENGTHS[2]

# Contract's arrays: name, VTK type name, components.
POINT_ARRAYS = [("NodeStatus", "unsigned char", 1), ("SignedDistance", "float", 1),
                ("Displacement", "float", 3), ("CorrectionApplied", "unsigned char", 1),
                ("DistanceLeft", "float", 1), ("NewBoundary", "unsigned char", 1),
                ("CornerLost", "unsigned char", 1)]
CELL_ARRAYS = [("ElementStatus", "unsigned char", 1), ("EliminatedFraction", "float", 1),
               ("Feasibility", "unsigned char", 1), ("Shortfall", "unsigned char", 1)]
SUMMARY = ["Kept", "Eliminated", "Treated", "MovedNodes", "Pentahedra", "Wedges",
           "CertifiedElements", "TouchedElements", "MinimumScaledJacobian",
           "MinimumIntegrationPointJacobian", "MaximumDistanceToSurface", "Volume",
           "NodeBandwidth"]


def check_plane(correction):
    """The plane x = 10.3 cuts 0.3 off the eleventh row, which goes; the tenth ends at 10.3."""
    found = summary(trim(sheet(), plane_at(10.3), CorrectionType=correction))
    for name in SUMMARY:
        check(name in found, "no %s in the field data" % name)
    check_equal(found["Kept"], 10 * PER_COLUMN, "Kept")
    check_equal(found["Eliminated"], ELEMENTS - 10 * PER_COLUMN, "Eliminated")
    check_equal(found["Treated"], PER_COLUMN, "Treated")
    if correction == 1:
        check_equal(found["MovedNodes"], 0, "MovedNodes of type I")
        check_close(found["Volume"], 10 * SECTION, "volume, type I", 1e-6)
        return
    check_equal(found["MovedNodes"], NODES_PER_COLUMN, "MovedNodes")
    check_equal(found["TouchedElements"], PER_COLUMN, "TouchedElements")
    check_equal(found["CertifiedElements"], PER_COLUMN, "CertifiedElements")
    check_close(found["Volume"], 10.3 * SECTION, "volume", 1e-6)
    check(found["MaximumDistanceToSurface"] <= 1e-9 * 24, "nodes off the surface")


def check_told():
    """Each entry of the summary has a line in the window's table and in the manual, each array one in
    the manual and on the help page."""
    project = os.path.dirname(DATA_DIRECTORY)
    with open(os.path.join(project, "Plugin", "Window", "TrimSummary.cxx")) as file:
        rows = re.findall(r"\{ names::(\w+),", file.read())  # as ArrayNames.h names them
    with open(os.path.join(project, "Plugin", "Documentation", "Manual.md")) as file:
        manual = file.read()
    entries = set(summary(trim(sheet(), plane_at(10.3))))
    check_equal(set(rows), entries, "rows of the window's table")
    for name in entries:
        check("`%s`" % name in manual, "the manual does not tell of " + name)
    with open(os.path.join(project, "Plugin", "Documentation",
                           "filters.TrimHexahedralGrid.html")) as file:
        page = file.read()
    grid = fetch(trim(sheet(), plane_at(10.3), InsertLayer=1))
    arrays = set(arrays_of(grid.GetPointData())) | set(arrays_of(grid.GetCellData()))
    check(arrays >= {name for name, *_ in POINT_ARRAYS + CELL_ARRAYS}, "arrays are missing")
    for name in arrays - {"DistanceToCenter", "Polynomial"}:
        check("`%s`" % name in manual, "the manual does not tell of " + name)
        check(name in page, "the help page does not tell of " + name)


def check_arrays():
    result = trim(sheet(), plane_at(10.3))
    for port in (0, 1):
        grid = fetch(result, port)
        for attributes, expected in [(grid.GetPointData(), POINT_ARRAYS),
                                     (grid.GetCellData(), CELL_ARRAYS)]:
            found = arrays_of(attributes)
            for name, kind, components in expected:
                check(name in found, "no %s on port %d" % (name, port))
                check_equal(found[name].GetDataTypeAsString(), kind, "type of " + name)
                check_equal(found[name].GetNumberOfComponents(), components, name)
        for name in ("DistanceToCenter", "Polynomial"):
            check(name in arrays_of(grid.GetPointData()), "the input's %s is lost" % name)
    trimmed = fetch(result)
    check("vtkOriginalPointIds" in arrays_of(trimmed.GetPointData()), "no vtkOriginalPointIds")
    for name in ("vtkOriginalCellIds", "ScaledJacobian"):
        check(name in arrays_of(trimmed.GetCellData()), "no " + name)


def check_statuses():
    grid = fetch(trim(sheet(), plane_at(10.3)), 1)
    check_equal(grid.GetNumberOfCells(), ELEMENTS, "elements of port 1")
    x = vtk_to_numpy(grid.GetPoints().GetData())[:, 0]
    status = vtk_to_numpy(grid.GetPointData().GetArray("NodeStatus"))
    check(((status == 1) == (x > 10.3)).all(), "NodeStatus differs from the side of the plane")
    fraction = vtk_to_numpy(grid.GetCellData().GetArray("EliminatedFraction"))
    statuses = vtk_to_numpy(grid.GetCellData().GetArray("ElementStatus"))
    check(abs(fraction[statuses == 2] - 0.7).max() < 1e-6, "V^e of the cut row")
    moved = vtk_to_numpy(grid.GetPointData().GetArray("Displacement"))
    cut = (x == 10)
    check(abs(moved[cut] - [0.3, 0, 0]).max() < 1e-6, "Displacement of the cut row")
    check((moved[~cut] == 0).all(), "Displacement of nodes that stay")
    # On the border of the model nodes slide along it, with type II too.
    y = vtk_to_numpy(grid.GetPoints().GetData())[:, 1]
    border = (y == 0) | (y == LENGTHS[1])
    correction = vtk_to_numpy(grid.GetPointData().GetArray("CorrectionApplied"))
    for place, value, what in ((cut & border, 3, "on the border"), (cut & ~border, 2, "within"),
                               (~cut, 0, "elsewhere")):
        check((correction[place] == value).all(), "CorrectionApplied " + what)


def check_empty_field_data():
    """Field data of the input without tuples, as of an Exodus file, does not hide the summary."""
    mesh = ProgrammableFilter(Input=sheet(), Script="""
from vtkmodules.vtkCommonCore import vtkStringArray
records = vtkStringArray()
records.SetName("Records")
self.GetOutputDataObject(0).ShallowCopy(self.GetInputDataObject(0, 0))
self.GetOutputDataObject(0).GetFieldData().AddArray(records)
""")
    result = trim(mesh, plane_at(10.3), ProduceOffcut=1)
    for name in SUMMARY:
        check(name in summary(result), "empty field data hides " + name)
    check("Volume" in OutputPort(result, 2).FieldData.keys(), "empty field data hides the offcut's")
    for port in (0, 2):
        check("Records" in arrays_of(fetch(result, port).GetFieldData()),
              "field data of the input is lost on port %d" % port)


def check_sides():
    kept = summary(trim(sheet(), plane_at(10.3)))["Kept"]
    inverted = summary(trim(sheet(), plane_at(10.3), InvertSide=1))
    check_equal(inverted["Kept"], ELEMENTS - kept, "Kept, inverted")
    check_close(inverted["Volume"], (LENGTHS[0] - 10.3) * SECTION, "volume of the offcut", 1e-6)
    right = summary(trim(sheet(), plane_at(10.3), UseKeepPoint=1, KeepPoint=[19, 5, 0.2]))
    check_equal(right["Kept"], inverted["Kept"], "Kept by the keep point")
    turned = summary(trim(sheet(), plane_at(10.3), UseKeepPoint=1, KeepPoint=[19, 5, 0.2],
                          InvertSide=1))
    check_equal(turned["Kept"], kept, "Kept by the inverted keep point")


def check_optimization():
    """The wave's cut has steps, so pentahedra: as wedges, or as hexahedra."""
    wedges = summary(trim(sheet(), wave_at(10.3), Optimization=2))
    check(wedges["Pentahedra"] > 0, "no pentahedra along the wave")
    check(wedges["Wedges"] > 0, "no wedges along the wave")
    untreated = summary(trim(sheet(), wave_at(10.3), CorrectionType=1))
    check_equal(untreated["Wedges"], 0, "wedges of type I")


def check_numbering():
    """What is left is 10 x 12 x 2: y outermost, then x, then z is the best sort, and next to the
    lower bound (nodes - 1) / diameter."""
    renumbered = summary(trim(sheet(), plane_at(10.3)))["NodeBandwidth"]
    per_section, per_line = 11 * 3, 3
    check(renumbered <= per_section + per_line + 1, "bandwidth %d" % renumbered)
    check(renumbered >= (13 * per_section - 1) / 12, "bandwidth %d, below the bound" % renumbered)
    as_it_came = summary(trim(sheet(), plane_at(10.3), RenumberNodes=0))["NodeBandwidth"]
    check(as_it_came > renumbered, "the bandwidth without renumbering is no larger")


def check_elimination_fraction():
    kept = summary(trim(sheet(), plane_at(10.3), EliminationFraction=0.8))
    check_equal(kept["Kept"], 11 * PER_COLUMN, "Kept with a fraction of 0.8")
    check_close(kept["Volume"], 10.3 * SECTION, "volume with a fraction of 0.8", 1e-6)


def check_sequence():
    """A trim of a trimmed grid: a strip is left, and its ids lead to the first trim's result."""
    first = trim(sheet(), wave_at(13.4))
    second = trim(first, plane_at(5.6), InvertSide=1)
    found = summary(second)
    check(0 < found["Kept"] < summary(first)["Kept"], "the second trim took nothing off")
    check(found["MinimumIntegrationPointJacobian"] > 0, "a negative Jacobian")
    for port in (1, 2):
        check("Kept" not in arrays_of(fetch(second, port).GetFieldData()),
              "the first trim's summary on port %d of the second" % port)


for correction_type in (1, 2, 3):
    check_plane(correction_type)
check_told()
check_arrays()
check_statuses()
check_empty_field_data()
check_sides()
check_optimization()
check_numbering()
check_elimination_fraction()
check_sequence()
