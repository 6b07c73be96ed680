"""The classes themselves in Python, without proxies."""
from nurbstrim.NURBSTrimFilter import vtkTrimHexahedralGrid
from nurbstrim.NURBSTrimRead import vtkNURBSSurfaceSource
from vtkmodules.vtkFiltersSources import vtkCellTypeSource

from Checks import check, check_equal

cells = vtkCellTypeSource()
cells.SetCellType(12)
cells.SetBlocksDimensions(6, 4, 2)
source = vtkNURBSSurfaceSource()
trim = vtkTrimHexahedralGrid()
check_equal(trim.GetNumberOfInputPorts(), 2, "input ports")
check_equal(trim.GetNumberOfOutputPorts(), 2, "output ports")
for name, value in [("CorrectionType", 3), ("Optimization", 1), ("InvertSide", True),
                    ("UseKeepPoint", True), ("EliminationFraction", 0.25),
                    ("RenumberNodes", False), ("Tolerance", 1e-8),
                    ("QualityOfAllElements", True), ("KeepPoint", (1.0, 2.0, 3.0))]:
    getattr(trim, "Set" + name)(value)
    check_equal(getattr(trim, "Get" + name)(), value, name)
trim.SetCorrectionType(7)
check(1 <= trim.GetCorrectionType() <= 3, "CorrectionType is not kept in its range")
