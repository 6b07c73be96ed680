"""Records a session in the real window, as a trace and as a state file, with everything that is
set by hand: a line moved by its widget, a keep point, the panel's settings, the four views
of the correction types. Replay.py brings it back in processes of its own.
"""
from Window import MAIN, PANEL, VIEWS, Window

VIEW = VIEWS + "Frame.0/CentralWidgetFrame/Viewport"
TRACE_DIALOG = "TraceOptionsDialog/widget/OKButton"

window = Window(size=(1200, 800))
window.menu("menuTools", "actionToolsStartStopTrace")
window.event(TRACE_DIALOG, "activate")

window.open("sheet.vtu")
window.apply()
window.action("DrawTrimLine")
window.set_choice("LineType", "Spline")
window.apply()
window.select("0:0/0:0")
window.menu("menuFilters", "NURBSTrim", "TrimHexahedralGrid")
window.choose_inputs(TrimmingSurface="0:0/0:0/0:0")
window.apply()

# The middle point of the line, (10, 6), which is in the middle of the view, is dragged upwards.
window.select("0:0/0:0/0:0")
window.event(PANEL + "InteractiveSpline/show3DWidget", "set_boolean", "true")
window.pause(500)
window.python("view = GetActiveView()\n"
              "view.CameraParallelProjection, view.CameraParallelScale = 1, 10\n"
              "view.CameraFocalPoint, view.CameraPosition = [10, 6, 0.5], [10, 6, 100]\n"
              "view.CameraViewUp = [0, 1, 0]\n"
              "view.StillRender()")
for event, y, button in (("mousePress", 0.5, 1), ("mouseMove", 0.45, 1), ("mouseMove", 0.4, 1),
                         ("mouseRelease", 0.4, 0)):
    window.event(VIEW, event, "(0.5,%g,1,%d,0)" % (y, button))
window.apply()
window.python("middle = active().Points[6:8]\n"
              "check(abs(middle[1] - 8) < 0.1, 'the middle point is at %r' % (middle,))")

window.select("0:0/1:0")
window.set_check("UseKeepPoint", True)
for axis, value in zip("XYZ", ("10", "1", "0.5")):
    window.set_text("InteractiveHandle/worldPosition" + axis, value)
window.set_choice("CorrectionType", "Type III: slide along edges")
window.set_choice("Optimization", "Distribute nodes")
window.set_check("RenumberNodes", False)
window.set_check("ProduceOffcut", True)
window.apply()
window.action("ShowStatuses")
window.action("CompareCorrectionTypes")
window.picture("window-comparison.png")

window.python("record('session')")
window.menu("menu_File", "actionFileSaveServerState")
window.event(MAIN + "/FileSaveServerStateDialog", "filesSelected",
             "$PARAVIEW_TEST_ROOT/session.pvsm")
window.run("record-in-window")
