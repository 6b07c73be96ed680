"""What a polyline from left to right leaves of the sheet of Checks, reckoned by areas."""
from paraview.simple import FindSource

from Checks import COUNTS, check, check_equal, summary

STEPS = 500


def height(points, x):
    """The polyline's y at x; points are its (x, y)."""
    for (x1, y1), (x2, y2) in zip(points, points[1:]):
        if x1 <= x <= x2:
            return y1 + (y2 - y1) * (x - x1) / (x2 - x1)
    raise ValueError("the line does not pass x = %g" % x)


def kept_elements(points, above):
    """The elements of which more than half lies above (below) the line; both layers."""
    kept = 0
    for i in range(COUNTS[0]):
        heights = [height(points, i + (k + 0.5) / STEPS) for k in range(STEPS)]
        for j in range(COUNTS[1]):
            below = sum(min(1.0, max(0.0, h - j)) for h in heights) / STEPS
            kept += (1 - below if above else below) >= 0.5
    return kept * COUNTS[2]


def check_cut(middle, above):
    """The window's trim has what its line leaves, and the line's middle point has this y."""
    values = list(FindSource("TrimLineSource1").Points)
    points = list(zip(values[0::3], values[1::3]))
    check(abs(points[2][1] - middle) < 0.1, "the middle point is at %r" % (points[2],))
    check(abs(points[2][0] - 10) < 0.1, "the middle point is at %r" % (points[2],))
    found = summary(FindSource("TrimHexahedralGrid1"))
    check_equal(found["Kept"], kept_elements(points, above), "Kept with %r" % points)
