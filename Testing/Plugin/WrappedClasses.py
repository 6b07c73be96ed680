"""The classes themselves in Python, without proxies."""
import os

from nurbstrim import (vtkCADSurfaceReader, vtkNURBSSurfaceSource, vtkTrimHexahedralGrid,
                       vtkTrimLineSource)
from vtkmodules.vtkFiltersSources import vtkCellTypeSource

from Checks import DATA_DIRECTORY, check, check_equal

cells = vtkCellTypeSource()
cells.SetCellType(12)
cells.SetBlocksDimensions(20, 12, 2)
surface = vtkNURBSSurfaceSource()
surface.SetDegrees(1, 1)
surface.SetControlNetSize(2, 2)
surface.SetNumberOfControlPoints(4)
for i, (y, z) in enumerate([(-3, -2), (15, -2), (-3, 4), (15, 4)]):
    surface.SetControlPoint(i, 8.3, y, z, 1)
for set_number, set_knot in [(surface.SetNumberOfKnotsU, surface.SetKnotU),
                             (surface.SetNumberOfKnotsV, surface.SetKnotV)]:
    set_number(4)
    for i, knot in enumerate((0, 0, 1, 1)):
        set_knot(i, knot)

trim = vtkTrimHexahedralGrid()
trim.SetInputConnection(0, cells.GetOutputPort())
trim.SetInputConnection(1, surface.GetOutputPort())
trim.Update()
check_equal(trim.GetOutput().GetNumberOfCells(), 8 * 24, "elements left of the plane")
check_equal(trim.GetOutputDataObject(1).GetNumberOfCells(), 20 * 24, "elements of port 1")

check_equal(trim.GetNumberOfInputPorts(), 2, "input ports")
check_equal(trim.GetNumberOfOutputPorts(), 3, "output ports")
for name, value in [("CorrectionType", 3), ("Optimization", 1), ("InvertSide", True),
                    ("UseKeepPoint", True), ("EliminationFraction", 0.25),
                    ("RenumberNodes", False), ("Tolerance", 1e-8),
                    ("QualityOfAllElements", True), ("MapValues", True), ("InsertLayer", True),
                    ("KeepPoint", (1.0, 2.0, 3.0))]:
    getattr(trim, "Set" + name)(value)
    check_equal(getattr(trim, "Get" + name)(), value, name)
check_equal(vtkCADSurfaceReader.CanReadFile(os.path.join(DATA_DIRECTORY, "WheelArch.igs")), 1,
            "CanReadFile of an IGES file")
check_equal(vtkCADSurfaceReader.CanReadFile(__file__), 0, "CanReadFile of a script")

place = [0.0] * 4
surface.GetControlPoint(1, place)
check_equal(place, [8.3, 15, -2, 1], "a control point")
check_equal([surface.GetKnotU(i) + surface.GetKnotV(i) for i in range(4)], [0, 0, 2, 2], "knots")
line = vtkTrimLineSource()
line.SetNumberOfPoints(2)
line.SetPoint(1, 1, 2, 3)
place = [0.0] * 3
line.GetPoint(1, place)
check_equal(place, [1, 2, 3], "a point of a trim line")

# What an object says of itself has all that can be set, but for the members of lists.
for thing in (trim, surface, line, vtkCADSurfaceReader()):
    for name in vars(type(thing)):
        hidden = name.endswith(("MinValue", "MaxValue", "Type", "Base"))
        if name.startswith("Get") and not hidden and name not in (
                "GetControlPoint", "GetKnotU", "GetKnotV", "GetPoint"):
            check(name[3:] + ": " in str(thing), name[3:] + " of " + type(thing).__name__)
