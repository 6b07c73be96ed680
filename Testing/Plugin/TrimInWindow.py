"""A trim by hand in the real window, with the numbers that come out.

Of the sheet's 20 rows of 24 elements the plane x = 8.3 leaves 8 on its near side, the ninth going
with the rest as only 30 % of it are there, and 12 beyond, where the keep point is. At the end the
state is saved for CheckWindow.py.
"""
import sys

from Window import MAIN, PANEL, Window

NOT_APPLIED = "Click Apply first: there are values that were not applied yet."
NO_ELEMENTS = ("There are no elements: none was left, or the filter failed, or it was not shown yet "
               "(the eye beside it).")
SUMMARY = MAIN + "/TrimSummary/Content/Table"

window = Window(size=(1400, 900))

# Both files, the filter with both inputs, Apply. A line can be drawn where there are elements.
window.expect_action("DrawTrimLine", False, "Select the mesh in the Pipeline Browser.")
window.expect(MAIN + "/NURBSTrim", "toolTipsVisible", "true")
window.open("sheet.vtu")
window.expect_action("DrawTrimLine", False)
window.apply()
window.expect_action("DrawTrimLine", True)
window.open("plane.igs")
window.apply()
window.select("0:0/0:0")
window.menu("menuFilters", "NURBSTrim", "TrimHexahedralGrid")
window.choose_inputs(TrimmingSurface="0:0/1:0")
window.expect_action("DrawTrimLine", False, "Click Apply first: there are no elements yet.")
for action in ("ShowStatuses", "CompareCorrectionTypes"):
    window.expect_action(action, False, NOT_APPLIED)
window.apply()
for action in ("DrawTrimLine", "ShowStatuses", "CompareCorrectionTypes"):
    window.expect_action(action, True)
window.python("found = summary(active())\n"
              "check_equal(found['Kept'], 8 * 24, 'Kept')\n"
              "check_close(found['Volume'], 8.3 * 12 * 0.5, 'Volume', 1e-6)\n"
              "check_first_view()")
window.picture("window-trimmed.png")

# What does not matter is not shown: the optimization and the layer with type I, the keep point unless
# used. Or it is greyed out: the layer with an offcut, mapped values with type I.
for widget in ("Optimization/ComboBox", "InsertLayer/CheckBox"):
    window.expect_visible(widget, True)
window.set_check("ProduceOffcut", True)
window.expect(PANEL + "InsertLayer/CheckBox", "enabled", "false")
window.set_check("ProduceOffcut", False)
window.expect(PANEL + "InsertLayer/CheckBox", "enabled", "true")
window.expect(PANEL + "MapValues/CheckBox", "enabled", "true")
window.set_choice("CorrectionType", "Type I: eliminate elements")
for widget in ("Optimization/ComboBox", "InsertLayer/CheckBox"):
    window.expect_visible(widget, False)
window.expect(PANEL + "MapValues/CheckBox", "enabled", "false")
window.expect_visible("InteractiveHandle/worldPositionX", False)
window.set_check("UseKeepPoint", True)
window.expect_visible("InteractiveHandle/worldPositionX", True)

# Properties by the panel, Apply. Until then nothing is shown that contradicts the panel.
for axis, value in zip("XYZ", ("19", "6", "0.5")):
    window.set_text("InteractiveHandle/worldPosition" + axis, value)
window.set_choice("CorrectionType", "Type III: slide along edges")
window.expect_action("DrawTrimLine", True)
for action in ("ShowStatuses", "CompareCorrectionTypes"):
    window.expect_action(action, False, NOT_APPLIED)
window.apply()
window.python("found = summary(active())\n"
              "check_equal(found['Kept'], 12 * 24, 'Kept')\n"
              "check_close(found['Volume'], 11.7 * 12 * 0.5, 'Volume', 1e-6)\n"
              "check_equal(active().CorrectionType, 'Type III: slide along edges', 'type')")

# The menu NURBSTrim: the statuses in place of the trimmed grid, and the table of the summary.
window.action("ShowStatuses")
window.python("check_equal(shown_elements(), 20 * 12 * 2, 'elements in the view')")
window.picture("window-statuses.png")

# Hovering tells why: a node that the trim moved from x = 8 to 8.3, and the element beside it.
window.hover("Points", 0.46, 0.5)
window.python("check_equal(hovered['NodeStatus'], '1', 'status of the node')\n"
              "check_equal(hovered['SignedDistance'], '0.3', 'its distance')\n"
              "check_equal(hovered['Displacement'], '(0.3, 0, 0)', 'its move')\n"
              "check_equal(hovered['CorrectionApplied'], '3', 'its correction')")
window.hover("Cells", 0.46, 0.5)
window.python("check_equal(hovered['ElementStatus'], '2', 'status of the element')\n"
              "check_equal(hovered['EliminatedFraction'], '0.3', 'its share beyond')\n"
              "check_equal(hovered['Rescue'], '0', 'its rescue')")
window.action("ShowStatuses")
window.python("check_equal(shown_elements(), 12 * 24, 'elements in the view')")
# In the trimmed grid, the node where that one lies now, and the same element.
window.hover("Points", 0.458, 0.5)
window.python("check_equal(hovered['NodeStatus'], '1', 'status of the node')\n"
              "check_equal(hovered['Coords'], '(8.3, 6, 0.5)', 'its place')\n"
              "check_equal(hovered['CorrectionApplied'], '3', 'its correction')")
window.hover("Cells", 0.47, 0.5, "window-hover.png")
window.python("check_equal(hovered['ElementStatus'], '2', 'status of the element')\n"
              "check_equal(hovered['EliminatedFraction'], '0.3', 'its share beyond')\n"
              "check_equal(hovered['ScaledJacobian'], '1', 'its quality')\n"
              "check_equal(hovered['Rescue'], '0', 'its rescue')")
window.action("ShowSummary")
window.expect(SUMMARY, "columnCount", "2")
window.expect(SUMMARY, "modelItemData", "0.0,288")
window.expect(SUMMARY, "modelItemData", "11.0,70.2")
window.picture("window-summary.png")
window.event(MAIN + "/TrimSummary/qt_dockwidget_closebutton", "activate")

# The state, before anything else is added to it.
window.menu("menu_File", "actionFileSaveServerState")
window.event(MAIN + "/FileSaveServerStateDialog", "filesSelected",
             "$PARAVIEW_TEST_ROOT/window.pvsm")

# Four linked views, of the mesh and the surface that were selected and with the trim's settings.
# They come all at once, and Undo, which would have ParaView's links clear the stack under its feet, has
# nothing to undo. (A command to the shell clears the stack as well.)
window.python("still = StillWindow(screen)")
window.action("CompareCorrectionTypes")
window.menu("menu_Edit", "actionEditUndo")
window.python("still.check()")
window.python("check_comparison(kept=12 * 24, volumes=(12 * 6, 11.7 * 6, 11.7 * 6))")

# The table has grown with the trims, and shows them all: of type I, which moves no node, without a
# quality.
window.action("ShowSummary")
window.expect(SUMMARY, "columnCount", "5")
window.expect(SUMMARY, "modelItemData", "8.1,-")
window.expect(SUMMARY + "/qt_scrollarea_hcontainer/1QScrollBar0", "maximum", "0")
window.event(MAIN + "/TrimSummary/qt_dockwidget_closebutton", "activate")

# The help button opens the page of the filter, with its pictures.
window.event(MAIN + "/propertiesDock/propertiesPanel/Help", "activate")
window.pause(1500)
window.picture("window-help.png")
window.python("check_color((157, 188, 210), 5000, 'kept elements of the help page\\'s picture')")

# A line that Undo has taken and Redo has brought back asks for Apply, as it did when it was made.
window.action("DrawTrimLine")
window.menu("menu_Edit", "actionEditUndo")
window.menu("menu_Edit", "actionEditRedo")
window.expect(MAIN + "/propertiesDock/propertiesPanel/Accept", "enabled", "true")
window.python("check_equal(active().GetXMLName(), 'TrimLineSource', 'the active source')")

# A mesh that has lost all its elements is none to draw on.
window.python("empty = Threshold(Input=FindSource('TrimHexahedralGrid1'), "
              "Scalars=['CELLS', 'ElementStatus'],\n"
              "                  ThresholdMethod='Above Upper Threshold', UpperThreshold=3)\n"
              "empty.UpdatePipeline()\n"
              "SetActiveSource(empty)")
window.expect_action("DrawTrimLine", False, NO_ELEMENTS)

# Of a large mesh the table has all digits, of counts to the last, of measures nine. (Of the 1003
# columns the last has 6 % on the near side.)
window.python("from Checks import plane_at, sheet, trim\n"
              "large = trim(sheet((1003, 1001, 1)), plane_at(19.98123))")
# A trim that Python has made needs no Apply.
for action in ("ShowStatuses", "CompareCorrectionTypes"):
    window.expect_action(action, True)
window.action("ShowSummary")
window.expect(SUMMARY, "columnCount", "6")
window.expect(SUMMARY, "modelItemData", "0.4,%d" % (1002 * 1001))
window.expect(SUMMARY, "modelItemData", "11.4,119.88738")
# What is deleted leaves the table.
window.python("Delete(large)")
window.pause(300)
window.expect(SUMMARY, "columnCount", "5")
window.event(MAIN + "/TrimSummary/qt_dockwidget_closebutton", "activate")

window.run("trim-in-window")

# A surface that misses the sheet leaves nothing; when something is left it is shown as always, in a
# trace as well.
window = Window(size=(1400, 900))
window.menu("menuTools", "actionToolsStartStopTrace")
window.event("TraceOptionsDialog/widget/OKButton", "activate")
window.open("sheet.vtu")
window.apply()
window.python("from Checks import plane_at\n[plane_at(x) for x in (8.3, 4.3, -3)]")
window.select("0:0/0:0")
window.menu("menuFilters", "NURBSTrim", "TrimHexahedralGrid")
window.choose_inputs(TrimmingSurface="0:0/3:0")
window.apply()
window.event(MAIN + "/outputWidgetDock/qt_dockwidget_closebutton", "activate")
window.set_check("InvertSide", True)
window.apply()
window.event(MAIN + "/outputWidgetDock/qt_dockwidget_closebutton", "activate")
window.python("check_first_view()\n"
              "trace = servermanager.vtkSMTrace.StopTrace()\n"
              "for line in (\"ColorBy(trimHexahedralGrid1Display, ('CELLS', 'ElementStatus'))\",\n"
              "             'trimHexahedralGrid1Display.SetScalarBarVisibility(renderView1, True)'):\n"
              "    check(line in trace, 'not in the trace: ' + line)")
window.event(MAIN + "/propertiesDock/propertiesPanel/Delete", "activate")

# Of trims in sequence the last one is shown, also where the statuses of the one before were; or that
# one, if its statuses are asked for.
window.select("0:0/0:0")
window.menu("menuFilters", "NURBSTrim", "TrimHexahedralGrid")
window.choose_inputs(TrimmingSurface="0:0/1:0")
window.apply()
window.action("ShowStatuses")
window.menu("menuFilters", "NURBSTrim", "TrimHexahedralGrid")
window.choose_inputs(TrimmingSurface="0:0/2:0")
window.apply()
window.python("check_equal(shown_elements(), 4 * 24, 'elements in the view')")
for name, left, before in (("TrimHexahedralGrid2", 4, 8), ("TrimHexahedralGrid1", 8, 20)):
    window.python("SetActiveSource(FindSource(%r))" % name)
    for rows in (before, left):
        window.action("ShowStatuses")
        window.python("check_equal(shown_elements(), %d * 24, 'elements in the view')" % rows)

# A line is drawn on a mesh in view: in place of its trims, which Undo brings back, or on the offcut,
# where that is selected. (The undone one comes first, as a command to the shell clears the stack.)
window.python("mesh, first = FindSource('sheet.vtu'), FindSource('TrimHexahedralGrid1')\n"
              "first.ProduceOffcut = 1\nfirst.UpdatePipeline()\nselect(mesh)")
window.action("DrawTrimLine")
window.menu("menu_Edit", "actionEditUndo")
window.python("check_equal(shown_elements(), 8 * 24, 'elements in the view after Undo')\n"
              "select(mesh)")
for selected, elements, sheet in (("mesh", 20, "mesh"), ("(first, 2)", 12, "first")):
    window.python("select(%s)" % selected)
    window.action("DrawTrimLine")
    window.python("check_equal(shown_elements(), %d * 24, 'elements in the view of a line')\n"
                  "check(active().Sheet.SMProxy == %s.SMProxy, 'the sheet of the line')" %
                  (elements, sheet))
window.python("check_equal(active().Sheet.Port, 2, 'the output that the line is drawn on')")

# With a file the widgets of the line that is drawn are gone, as it is not used; Closed is still there.
# So it is with the unit of the file, the other way round.
for widget, with_file in (("InteractiveSpline/PointsTable", False), ("Closed/CheckBox", True),
                          ("LengthUnit/ComboBox", True)):
    for name, visible in (("", not with_file), ("points.csv", with_file)):
        window.python("active().FileName = %r" % name)
        window.expect_visible(widget, visible)

# Of files that ParaView's dialog shows as one it opens the first, which is told of.
window.open("numbered_..igs")
window.python("check_equal(active().FileName[-15:], '/numbered_1.igs', 'the file that is opened')")
if "Only numbered_1.igs is opened, the first of 2 files" not in window.run("trims-in-sequence"):
    sys.exit("ERROR: nothing is told of a file that is not opened")
