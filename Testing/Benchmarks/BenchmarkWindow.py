"""Moving a trim line and pressing Apply in ParaView's real window, on a sheet of 250 000 elements;
for comparison ParaView's own Clip and Transform on the same sheet.

run-benchmarks.sh Window runs it under a display of its own, drawn by software.
Arguments: elements along a side of the sheet (354; there are two layers), rounds (5).
"""
import os
import subprocess
import sys

from Window import PANEL, VIEWS, Window

SIDE = int(sys.argv[1]) if len(sys.argv) > 1 else 354
ROUNDS = int(sys.argv[2]) if len(sys.argv) > 2 else 5
VIEW = VIEWS + "Frame.0/CentralWidgetFrame/Viewport"
MESH, LINE = "0:0/0:0", "0:0/0:0/0:0"
SCALE = 550.0  # half the height of the view

SHEET = """
from paraview.simple import *
blocks = UnstructuredCellTypes(CellType=12, BlocksDimensions=[%d, %d, 2], OutputPrecision=1)
sheet = Transform(Input=blocks)
sheet.Transform.Scale = [1000 / %d, 1000 / %d, 0.5]
SaveData("sheet.vtu", sheet, DataMode="Binary")
""" % (SIDE, SIDE, SIDE, SIDE)

COMPARISONS = """
mesh = line.Sheet
def at(clip, k):
    clip.ClipType.Origin = [500.0, 480.0 + 20 * k, 0.5]
clip = Clip(Input=mesh)
clip.ClipType.Normal = [0, 1, 0]
tell(time_changes("ParaView's Clip, its plane moved", clip,
                  [lambda k=k: at(clip, k) for k in range(%d)]))
def shift(moved, k):
    moved.Transform.Translate = [0.0, 0.0, 0.1 * k]
moved = Transform(Input=mesh)
tell(time_changes("ParaView's Transform, changed", moved,
                  [lambda k=k: shift(moved, k) for k in range(1, %d + 1)]))
""" % (ROUNDS, ROUNDS)


def drag(window, start, end):
    """Drags the line's middle point, which is in the middle of the view, along y."""
    first, last = [0.5 - (y - 500) / (2 * SCALE) for y in (start, end)]
    window.event(VIEW, "mousePress", "(0.5,%g,1,1,0)" % first)
    for step in (1, 2, 3):
        window.event(VIEW, "mouseMove", "(0.5,%g,1,1,0)" % (first + (last - first) * step / 3))
    window.event(VIEW, "mouseRelease", "(0.5,%g,1,0,0)" % last)


subprocess.run(["pvpython", "--dr", "-c", SHEET], cwd=os.environ["NURBSTRIM_OUTPUT"], check=True)
window = Window(size=(1400, 900))
window.open("sheet.vtu")
window.apply()
window.action("DrawTrimLine")
window.apply()
window.select(MESH)
window.menu("menuFilters", "NURBSTrim", "TrimHexahedralGrid")
window.choose_inputs(TrimmingSurface=LINE)
window.apply()
window.python("from WindowTiming import *\n"
              "trim, line = active(), active().TrimmingSurface\n"
              "timing = Timing('Apply after the trim line moved', [line, trim])\n"
              "tell('%d elements' % trim.Input.GetDataInformation().GetNumberOfCells())")
window.select(LINE)
window.event(PANEL + "InteractiveSpline/show3DWidget", "set_boolean", "true")
window.pause(500)
window.python("view = GetActiveView()\n"
              "view.CameraParallelProjection, view.CameraParallelScale = 1, %g\n"
              "view.CameraFocalPoint, view.CameraPosition = [500, 500, 0.5], [500, 500, 3000]\n"
              "view.CameraViewUp = [0, 1, 0]\n"
              "view.StillRender()" % SCALE)
# Apply with nothing to be done: what playing the step takes by itself.
for _ in range(ROUNDS):
    window.python("timing.begin()")
    window.apply()
    window.python("timing.end_of_nothing()")
place = 500
for _ in range(ROUNDS + 1):
    drag(window, place, place + 30)
    place += 30
    window.pause(300)
    window.python("timing.begin()")
    window.apply()
    window.python("timing.end()")
window.python("timing.rounds.pop(0)\ntell(timing.table())")
window.python(COMPARISONS)
window.run("benchmark-window")
