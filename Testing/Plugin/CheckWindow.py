"""Loads the state that TrimInWindow.py saved: what was set in the panel is there, with its
result and representation."""
import os

from paraview.simple import FindSource, GetActiveViewOrCreate, GetDisplayProperties, LoadState

from Checks import OUTPUT_DIRECTORY, check, check_close, check_equal, summary

check(os.path.getsize(os.path.join(OUTPUT_DIRECTORY, "window-trimmed.png")) > 10000, "no screenshot")
LoadState(os.path.join(OUTPUT_DIRECTORY, "window.pvsm"))
trim = FindSource("TrimHexahedralGrid1")
check(trim is not None, "no trim in the state")
check_equal(trim.CorrectionType, "Type III: slide along edges", "CorrectionType")
check_equal(trim.Optimization, "Degenerate to wedges", "Optimization")
check_equal(trim.UseKeepPoint, 1, "UseKeepPoint")
check_equal(list(trim.KeepPoint), [19, 6, 0.5], "KeepPoint")
check_equal(trim.Input.GetXMLName(), "XMLUnstructuredGridReader", "the first input")
check_equal(trim.TrimmingSurface.GetXMLName(), "CADSurfaceReader", "the second input")
found = summary(trim)
check_equal(found["Kept"], 288, "Kept")
check_close(found["Volume"], 11.7 * 12 * 0.5, "volume", 1e-6)
display = GetDisplayProperties(trim, GetActiveViewOrCreate("RenderView"))
check_equal(display.Representation, "Surface With Edges", "representation")
check_equal(list(display.ColorArrayName), ["CELLS", "ElementStatus"], "coloured by")
