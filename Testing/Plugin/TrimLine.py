"""Trimming by a line of points: a hole, its offcut, an open line, a CSV file, and states."""
import math
import os

from paraview import smstate
from paraview.simple import (FindSource, LoadState, ResetSession, SaveState, TrimLineSource)

from Checks import (COUNTS, LENGTHS, OUTPUT_DIRECTORY, check, check_close, check_equal, sheet,
                    summary, trim)

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


def check_states():
    points = flat(circle())
    line = TrimLineSource(registrationName="TheLine", Points=points, Closed=1, Length=2,
                          Direction=[0.1, 0, 1], Resolution=33)
    expected = repr(summary(trim(sheet(), line, registrationName="TheTrim")))
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
                     restored.Resolution], [1, 2.0, [0.1, 0, 1], 33], "properties from " + what)
        check_equal(repr(summary(FindSource("TheTrim"))), expected, "summary from " + what)


check_hole()
check_open()
check_file()
check_states()
