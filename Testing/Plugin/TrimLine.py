"""Trimming by lines: holes, offcuts, open lines, polylines, CSV and IGES files, the sheet that gives
direction and length, traces and states."""
import math
import os
import sys

from paraview import smstate, smtrace
from paraview.simple import (Delete, FindSource, LoadState, ReloadFiles, ResetSession, SaveState,
                             Transform, TrimLineSource)

from Checks import (COUNTS, LENGTHS, OUTPUT_DIRECTORY, check, check_close, check_equal, fetch, sheet,
                    summary, trim)

sys.path.insert(0, os.environ["NURBSTRIM_DATA"])
from IgesWriter import IgesFile  # noqa: E402

ELEMENTS = COUNTS[0] * COUNTS[1] * COUNTS[2]
VOLUME = LENGTHS[0] * LENGTHS[1] * LENGTHS[2]
CENTER, RADIUS, HANDLES = (10.2, 6.1), 3.3, 24


def circle(sense=1):
    """Points of a circle in the middle plane of the sheet, drawn in either sense."""
    angles = [sense * 2 * math.pi * i / HANDLES for i in range(HANDLES)]
    return [(CENTER[0] + RADIUS * math.cos(a), CENTER[1] + RADIUS * math.sin(a), 0.25)
            for a in angles]


def flat(points):
    return [c for point in points for c in point]


def check_hole():
    """The hole of a circle takes pi r^2 off; its offcut has the rest, whichever way drawn."""
    results = []
    for sense in (1, -1):
        line = TrimLineSource(Points=flat(circle(sense)), Closed=1, Length=2)
        results.append(summary(trim(sheet(), line)))
    hole, other = results
    offcut = summary(trim(sheet(), TrimLineSource(Points=flat(circle()), Closed=1, Length=2),
                          InvertSide=1))
    area = math.pi * RADIUS ** 2 * LENGTHS[2]
    # Straight edges instead of an arc: a few per cent of the hole.
    check(abs(VOLUME - hole["Volume"] - area) < 0.05 * area, "volume of the hole: %r" % hole)
    check(abs(offcut["Volume"] - area) < 0.05 * area, "volume of the offcut: %r" % offcut)
    check_equal(hole["Kept"] + offcut["Kept"], ELEMENTS, "elements of both parts")
    check_equal(hole["Kept"], other["Kept"], "Kept of the other sense")
    check_close(other["Volume"], hole["Volume"], "volume of the other sense", 1e-6)
    check(hole["MaximumDistanceToSurface"] <= 1e-9 * 24, "nodes off the surface")


def check_open():
    """A straight line along y at x = 10.3: what lies to its right, seen from above, goes."""
    points = [(10.3, -3, 0.25), (10.3, 15, 0.25)]
    found = summary(trim(sheet(), TrimLineSource(Points=flat(points), Length=2)))
    check_equal(found["Kept"], 10 * COUNTS[1] * COUNTS[2], "Kept")
    check_close(found["Volume"], 10.3 * LENGTHS[1] * LENGTHS[2], "volume", 1e-6)


def check_file():
    path = os.path.join(OUTPUT_DIRECTORY, "circle.csv")
    with open(path, "w") as file:
        file.write("x,y,z\n" + "".join("%r,%r,%r\n" % point for point in circle()))
    found = summary(trim(sheet(), TrimLineSource(FileName=path, Closed=1, Length=2)))
    drawn = summary(trim(sheet(), TrimLineSource(Points=flat(circle()), Closed=1, Length=2)))
    check_equal(repr(found), repr(drawn), "summary of the line from a file")
    # Written anew, with a mistake at first, it is read again on demand.
    line = TrimLineSource(FileName=path, Closed=1, Length=2)
    filtered = trim(sheet(), line)
    for factor in (0.5, 1):
        with open(path, "w") as file:
            for x, y, z in circle():
                file.write("%r,%r,%r\n" % (5 + factor * (x - 5), 5 + factor * (y - 5), z))
        check(ReloadFiles(line), "the file of a trim line is not reloaded")
        again = summary(filtered)
        check((repr(again) == repr(drawn)) == (factor == 1), "the file is not read again")


def check_polyline():
    """A rectangle along the edges of elements: 6 x 4 of them go, to the last corner."""
    corners = [(4, 3, 0.25), (10, 3, 0.25), (10, 7, 0.25), (4, 7, 0.25)]
    found = summary(trim(sheet(), TrimLineSource(Points=flat(corners), Closed=1,
                                                 LineType="Polyline")))
    check_equal(found["Kept"], ELEMENTS - 6 * 4 * COUNTS[2], "Kept round the rectangle")
    check_close(found["Volume"], VOLUME - 6 * 4 * LENGTHS[2], "volume round the rectangle", 1e-6)


def write_circles(name, circles):
    """An IGES file of circles x, y, radius, each of two half circles as trim curves often are."""
    file = IgesFile("Circles")
    for x, y, radius in circles:
        for sign in (1, -1):
            values = [0.25, x, y, x + sign * radius, y, x - sign * radius, y]
            file.add(100, [float(value) for value in values])
    path = os.path.join(OUTPUT_DIRECTORY, name)
    file.write(path)
    return path


def check_curves():
    """Circles from a file: two holes at once, and a disc with a hole that is kept as one part."""
    path = write_circles("holes.igs", [(5, 6, 2.4), (14, 6, 3.3)])
    line = TrimLineSource(FileName=path, Direction=[0, 0, 1], Length=2)
    found = summary(trim(sheet(), line))
    area = math.pi * (2.4 ** 2 + 3.3 ** 2) * LENGTHS[2]
    check(abs(VOLUME - found["Volume"] - area) < 0.06 * area, "volume of two holes: %r" % found)
    check(found["MaximumDistanceToSurface"] <= 1e-9 * 24, "nodes off the arcs")
    check_equal(fetch(line).GetClassName(), "vtkMultiBlockDataSet", "several lines")

    path = write_circles("ring.igs", [(10, 6, 5.2), (10, 6, 2.4)])
    found = summary(trim(sheet(), TrimLineSource(FileName=path), InvertSide=1))
    area = math.pi * (5.2 ** 2 - 2.4 ** 2) * LENGTHS[2]
    check(abs(found["Volume"] - area) < 0.06 * area, "volume of the ring: %r" % found)

    metres = TrimLineSource(FileName=path, LengthUnit="Metre")
    metres.UpdatePipeline()
    check_close(metres.GetDataInformation().GetBounds()[1], 0.0152, "bounds in metres")


def check_sheet():
    """Direction and length come from a sheet that stands askew, and follow it."""
    turned = Transform(Input=sheet())
    turned.Transform.Rotate = [30, 50, 70]
    turned.UpdatePipeline()
    grid = fetch(turned)
    origin, x, y = (grid.GetPoint(i) for i in (0, COUNTS[0], (COUNTS[0] + 1) * COUNTS[1]))
    along = [[(b - a) / length for a, b in zip(origin, end)]
             for end, length in ((x, LENGTHS[0]), (y, LENGTHS[1]))]
    points = [origin[i] + p[0] * along[0][i] + p[1] * along[1][i]
              for p in circle() for i in range(3)]
    line = TrimLineSource(Points=points, Closed=1)
    check(line.Sheet is None, "a sheet that nobody chose")
    line.Sheet = turned
    found = summary(trim(turned, line))
    straight = summary(trim(sheet(), TrimLineSource(Points=flat(circle()), Closed=1, Length=2)))
    check_equal(found["Kept"], straight["Kept"], "Kept of the sheet askew")
    check_close(found["Volume"], straight["Volume"], "volume of the sheet askew", 1e-4)
    turned.Transform.Rotate = [0, 0, 0]
    line.Points = flat(circle())
    line.UpdatePipeline()
    check_close(line.FieldData["Direction"].GetRange(2)[0], 1, "direction of the sheet put straight")


def check_trace():
    """What is traced runs again, with the sheet that was chosen, or without one."""
    mesh = sheet()
    for chosen in (True, False):
        smtrace.start_trace()
        options = {"Sheet": mesh} if chosen else {}
        line = TrimLineSource(registrationName="Traced", Points=flat(circle()), Closed=1, **options)
        trace = smtrace.stop_trace()
        check(("Sheet=None" in trace) != chosen, "the trace says:\n" + trace)
        line.UpdatePipeline()
        length = line.FieldData["Length"].GetRange(0)
        Delete(line)
        del line
        sheet()  # another active source
        exec(compile(trace, "trace", "exec"), {"__name__": "trace"})
        again = FindSource("Traced")
        again.UpdatePipeline()
        check_equal(again.FieldData["Length"].GetRange(0), length, "length from the trace")
        Delete(again)
        del again


def check_states():
    points = flat(circle())
    base = sheet()
    line = TrimLineSource(registrationName="TheLine", Points=points, Closed=1, Length=2,
                          Direction=[0.1, 0, 1], Resolution=33, LineType=1, Sheet=base)
    expected = repr(summary(trim(base, line, registrationName="TheTrim")))
    state = os.path.join(OUTPUT_DIRECTORY, "trim-line.pvsm")
    SaveState(state)
    script = smstate.get_state()
    for what in ("the .pvsm file", "the Python state"):
        ResetSession()
        if what == "the .pvsm file":
            LoadState(state)
        else:
            exec(compile(script, "state", "exec"), {"__name__": "state"})
        restored = FindSource("TheLine")
        check_equal(list(restored.Points), points, "points from " + what)
        check_equal([restored.Closed, restored.Length, list(restored.Direction),
                     restored.Resolution, restored.LineType],
                    [1, 2.0, [0.1, 0, 1], 33, "Polyline"], "properties from " + what)
        check_equal(restored.Sheet, FindSource("TheTrim").Input, "sheet from " + what)
        check_equal(repr(summary(FindSource("TheTrim"))), expected, "summary from " + what)


check_hole()
check_open()
check_file()
check_polyline()
check_curves()
check_sheet()
check_trace()
check_states()
