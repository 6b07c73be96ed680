"""A trim line drawn in the real window: placed on the mesh from the menu, its points and the keep
point dragged in the view, with Apply and with Auto Apply.

The session is recorded, as a trace and as a state file, with everything that is set by hand, the
statuses and the four views of the correction types too. Replay.py brings it back in a process of
its own.

The camera looks down at the line's middle point, (10, 6), so that it is in the middle of the view
whatever the window's size, and the view is 20 high.
"""
import os
import sys

from Window import MAIN, OUTPUT_DIRECTORY, PANEL, VIEWS, Window

VIEW = VIEWS + "Frame.0/CentralWidgetFrame/Viewport"
AUTO_APPLY = MAIN + "/MainControlsToolbar/actionAutoApply"
MESH, LINE, TRIM = "0:0/0:0", "0:0/0:0/0:0", "0:0/1:0"


def drag(window, start, end):
    """Drags what is in the middle of the view at the height y = start to y = end."""
    where = [0.5 - (y - 6) / 20 for y in (start, end)]
    window.event(VIEW, "mousePress", "(0.5,%g,1,1,0)" % where[0])
    for step in (1, 2, 3):
        y = where[0] + (where[1] - where[0]) * step / 3
        window.event(VIEW, "mouseMove", "(0.5,%g,1,1,0)" % y)
    window.event(VIEW, "mouseRelease", "(0.5,%g,1,0,0)" % where[1])


def check_kept(window, middle, above=True):
    """The elements that are left are those that the line leaves, with its middle about there."""
    window.python("from LineCut import check_cut\ncheck_cut(%r, %r)" % (middle, above))


window = Window(size=(1400, 900))
window.menu("menuTools", "actionToolsStartStopTrace")
window.event("TraceOptionsDialog/widget/OKButton", "activate")
window.open("sheet.vtu")
window.apply()
window.action("DrawTrimLine")
window.python("line = active()\n"
              "check_equal(line.GetXMLName(), 'TrimLineSource', 'the active source')\n"
              "check_equal(line.Sheet.GetXMLName(), 'XMLUnstructuredGridReader', 'Sheet')\n"
              "check_equal([round(c, 9) for c in line.Points], [-1, 6, 0.5, 4.5, 6, 0.5, "
              "10, 6, 0.5, 15.5, 6, 0.5, 21, 6, 0.5], 'the points placed')")
window.expect_visible("InteractiveSpline/PointsTable", True)
window.expect_visible("InteractivePolyLine/PointsTable", False)
window.set_choice("LineType", "Polyline")
window.expect_visible("InteractiveSpline/PointsTable", False)
window.expect_visible("InteractivePolyLine/PointsTable", True)
window.apply()
# The mesh that the line was drawn on stays in view.
window.python("shown = GetActiveView().Representations\n"
              "inputs = [r.Input.GetXMLName() for r in shown if r.Visibility and hasattr(r, 'Input')]\n"
              "check_equal(sorted(inputs), ['TrimLineSource', 'XMLUnstructuredGridReader'], 'shown')")
window.python("values = {name: active().FieldData[name] for name in ('Direction', 'Length')}\n"
              "check_equal(values['Direction'].GetRange(2)[0], 1.0, 'direction of the sheet')\n"
              "check_close(values['Length'].GetRange(0)[0], 0.55, 'length through the sheet')")

window.select(MESH)
window.menu("menuFilters", "NURBSTrim", "TrimHexahedralGrid")
window.choose_inputs(TrimmingSurface=LINE)
window.apply()
check_kept(window, 6)

window.select(LINE)
window.event(PANEL + "InteractivePolyLine/show3DWidget", "set_boolean", "true")
window.pause(500)
window.python("view = GetActiveView()\n"
              "view.CameraParallelProjection, view.CameraParallelScale = 1, 10\n"
              "view.CameraFocalPoint, view.CameraPosition = [10, 6, 0.5], [10, 6, 100]\n"
              "view.CameraViewUp = [0, 1, 0]\n"
              "view.StillRender()")
drag(window, 6, 9)
window.picture("window-trim-line.png")
window.apply()
check_kept(window, 9)

window.event(AUTO_APPLY, "set_boolean", "true")
drag(window, 9, 3)
window.pause(2000)
check_kept(window, 3)
window.event(AUTO_APPLY, "set_boolean", "false")

# A keep point on the side that is kept changes nothing; dragged across the line it does. It is in the
# middle of the mesh at first.
window.select(TRIM)
window.set_check("UseKeepPoint", True)
for axis, value in zip("XYZ", ("10", "6", "0.25")):
    window.expect(PANEL + "InteractiveHandle/worldPosition" + axis, "text", value)
window.set_text("InteractiveHandle/worldPositionY", "10")
window.apply()
check_kept(window, 3)
window.event(PANEL + "InteractiveHandle/show3DWidget", "set_boolean", "true")
drag(window, 10, 1)
window.apply()
check_kept(window, 3, above=False)

# A spline through the same points, and what else can be set.
window.select(LINE)
window.set_choice("LineType", "Spline")
window.event(PANEL + "InteractiveSpline/show3DWidget", "set_boolean", "true")
window.pause(500)
drag(window, 3, 8)
window.apply()
window.python("middle = active().Points[6:8]\n"
              "check(abs(middle[1] - 8) < 0.1, 'the middle point is at %r' % (middle,))")
# A point added, which lies farther on, and taken off again.
for button, count in (("Add", 6), ("Remove", 5)):
    window.event(PANEL + "InteractiveSpline/" + button, "activate")
    window.apply()
    window.python("check_equal(len(active().Points), 3 * %d, 'coordinates of points')" % count)
window.select(TRIM)
window.set_choice("CorrectionType", "Type III: slide along edges")
window.set_choice("Optimization", "Distribute nodes")
window.set_check("RenumberNodes", False)
window.set_check("ProduceOffcut", True)
window.apply()
window.action("ShowStatuses")
window.action("CompareCorrectionTypes")
# The polyline's corner was worth a warning, which has opened the messages.
window.event(MAIN + "/outputWidgetDock/qt_dockwidget_closebutton", "activate")
window.picture("window-comparison.png")

window.python("record('session')")
window.menu("menu_File", "actionFileSaveServerState")
window.event(MAIN + "/FileSaveServerStateDialog", "filesSelected",
             "$PARAVIEW_TEST_ROOT/session.pvsm")
window.run("trim-line-in-window")

with open(os.path.join(OUTPUT_DIRECTORY, "session.py")) as file:
    if "KeepPoint = [10.0, 6.0, 0.25]" not in file.read():
        sys.exit("ERROR: the first keep point is not in the trace")
