#!/usr/bin/env python3
"""Draws the trimming surfaces of the side panel and writes them as IGES files.

    python3 DrawSidePanel.py [directory]

Needs nothing but Python. Lengths in millimetres; the car's front is to the left. The contours
are drawn in the plane of the sheet, z = 0, and swept from z = -30 to z = 30. The outside contour
runs counter-clockwise and the openings clockwise: with u along the contour and v along z the
normal S_u x S_v then points to what is cut away. Prints the smallest radius of each contour and
the smallest width of sheet between any two of them.
"""
import math
import os
import sys

from IgesWriter import IgesFile, bspline_curve, bspline_surface

HALF_HEIGHT = 30.0

# Corners x, y, radius; then how far the side that follows bulges outwards, and by how many
# control points it is drawn.
OUTER_CONTOUR = [
    (70, 60, 75, 0, 4),        # sill, front
    (1495, 75, 80, 4, 3),      # sill, rear
    (1545, 585, 95, 0, 0),     # tail lamp
    (1385, 690, 160, 0, 1),    # foot of the C pillar
    (1215, 985, 140, 0, 0),    # roof, rear
    (905, 1046, 900, 0, 0),    # roof, highest point
    (580, 1014, 190, 6, 2),    # roof, front
    (245, 640, 150, 0, 0),     # foot of the A pillar
    (62, 560, 80, 0, 2),       # hinge pillar
]
FRONT_DOOR = [
    (168, 150, 70, 0, 3),
    (668, 150, 70, 6, 4),
    (730, 922, 66, 0, 0),
    (590, 918, 92, 3, 2),
    (318, 590, 170, 0, 0),
    (160, 495, 75, 0, 2),
]
# Lines joined by arcs: corner and radius of the arc.
REAR_DOOR = [
    (752, 150, 60),
    (928, 150, 60),
    (1085, 425, 220),
    (1135, 610, 110),
    (1070, 925, 70),
    (806, 938, 60),
]
# The side along the roof is a quartic spline instead, with this rise.
BULGED_PIECE, BULGE, BULGED_KNOTS = 10, 4.0, [0.0] * 5 + [1.0] * 5
WHEEL_CENTRE, WHEEL_RADIUS, WHEEL_BOTTOM, WHEEL_CORNER = (1250.0, 215.0), 180.0, 145.0, 45.0


def add(a, b, scale=1.0):
    return (a[0] + scale * b[0], a[1] + scale * b[1])


def direction(a, b):
    length = math.dist(a, b)
    return ((b[0] - a[0]) / length, (b[1] - a[1]) / length)


def control_polygon(corners):
    """Control points of a closed uniform cubic with about the given radius at each corner.

    A uniform cubic whose control points around a corner V are V - h e1, V, V + h e2 has there
    the radius h cos^2(phi/2) / (2 sin(phi/2)), phi being the turn from e1 to e2.
    """
    points = []
    for i, (x, y, radius, bulge, inner) in enumerate(corners):
        here, before, after = (x, y), corners[i - 1][:2], corners[(i + 1) % len(corners)][:2]
        e1, e2 = direction(before, here), direction(here, after)
        half = 0.5 * abs(math.atan2(e1[0] * e2[1] - e1[1] * e2[0], e1[0] * e2[0] + e1[1] * e2[1]))
        reach = 2.0 * radius * math.sin(half) / math.cos(half) ** 2
        points += [add(here, e1, -reach), here, add(here, e2, reach)]
        corners[i] = (x, y, radius, bulge, inner, reach)
    result = []
    for i, (x, y, _, bulge, inner, reach) in enumerate(corners):
        after = corners[(i + 1) % len(corners)]
        e = direction((x, y), after[:2])
        start, end = add((x, y), e, reach), add(after[:2], e, -after[5])
        room = (end[0] - start[0]) * e[0] + (end[1] - start[1]) * e[1]
        if room <= 0.0:
            # The two corners share the side: one control point between them.
            share = reach / (reach + after[5])
            start = end = add((x, y), e, share * math.dist((x, y), after[:2]))
        result.append((float(x), float(y)))
        result.append(start)
        for k in range(1, inner + 1):
            t = k / (inner + 1.0)
            point = add(start, (end[0] - start[0], end[1] - start[1]), t)
            result.append(add(point, (e[1], -e[0]), 4.0 * bulge * t * (1.0 - t)))
        if room > 0.0:
            result.append(end)
    return result


def insert_knot(knots, points, degree, value):
    """Boehm's knot insertion, one knot; points are tuples of any length."""
    k = max(i for i in range(len(knots) - 1) if knots[i] <= value)
    multiplicity = knots.count(value)
    fresh = []
    for i in range(len(points) + 1):
        if i <= k - degree:
            fresh.append(points[i])
        elif i > k - multiplicity:
            fresh.append(points[i - 1])
        else:
            t = (value - knots[i]) / (knots[i + degree] - knots[i])
            fresh.append(tuple((1 - t) * a + t * b for a, b in zip(points[i - 1], points[i])))
    return knots[:k + 1] + [value] + knots[k + 1:], fresh


def clamped_closed_cubic(polygon):
    """The closed uniform cubic of a control polygon, made to begin and end at one point."""
    count, degree = len(polygon), 3
    points = list(polygon) + list(polygon[:degree])
    knots = [float(i - degree) for i in range(len(points) + degree + 1)]
    for end in (0.0, float(count)):
        while knots.count(end) < degree:
            knots, points = insert_knot(knots, points, degree, end)
    first, last = knots.index(0.0), knots.index(float(count))
    points = points[first - 1:last]
    inner = [knot for knot in knots if 0.0 < knot < count]
    points[-1] = points[0]
    return points, [0.0] * 4 + inner + [float(count)] * 4


def rounded(corners):
    """Lines and arcs of a polygon with rounded corners: ("line", a, b), ("arc", c, r, a, b)."""
    pieces = []
    for i, (x, y, radius) in enumerate(corners):
        here, before, after = (x, y), corners[i - 1][:2], corners[(i + 1) % len(corners)][:2]
        e1, e2 = direction(before, here), direction(here, after)
        turn = math.atan2(e1[0] * e2[1] - e1[1] * e2[0], e1[0] * e2[0] + e1[1] * e2[1])
        reach = radius * math.tan(0.5 * turn)
        start, end = add(here, e1, -reach), add(here, e2, reach)
        pieces.append(("arc", add(start, (-e1[1], e1[0]), radius), radius, start, end))
    result = []
    for i, arc in enumerate(pieces):
        result.append(("line", pieces[i - 1][4], arc[3]))
        result.append(arc)
    return result


def arc_points(centre, radius, start, end):
    """Control points and weights of a quadratic for an arc of less than a half circle."""
    middle = (0.5 * (start[0] + end[0]), 0.5 * (start[1] + end[1]))
    cosine = math.dist(centre, middle) / radius
    out = direction(centre, middle)
    return [start, add(centre, out, radius / cosine), end], [1.0, cosine, 1.0]


def wheel_arch():
    """Half a circle on two upright lines, closed below: a quadratic with double knots."""
    (x, y), r, b, c = WHEEL_CENTRE, WHEEL_RADIUS, WHEEL_BOTTOM, WHEEL_CORNER
    left, right, top = x - r, x + r, (x, y + r)
    # Clockwise from the middle of the lower side.
    pieces = [("line", (x, b), (left + c, b)),
              ("arc", (left + c, b + c), c, (left + c, b), (left, b + c)),
              ("line", (left, b + c), (left, y)),
              ("arc", (x, y), r, (left, y), top),
              ("arc", (x, y), r, top, (right, y)),
              ("line", (right, y), (right, b + c)),
              ("arc", (right - c, b + c), c, (right, b + c), (right - c, b)),
              ("line", (right - c, b), (x, b))]
    points, weights, knots = [pieces[0][1]], [1.0], [0.0] * 3
    for piece in pieces:
        if piece[0] == "line":
            a, e = piece[1], piece[2]
            extra, length = [((a[0] + e[0]) / 2, (a[1] + e[1]) / 2), e], math.dist(a, e)
            extra_weights = [1.0, 1.0]
        else:
            extra, extra_weights = arc_points(*piece[1:])
            length = 2.0 * piece[2] * math.acos(extra_weights[1])
            extra, extra_weights = extra[1:], extra_weights[1:]
        points += extra
        weights += extra_weights
        knots += [knots[-1] + length] * 2
    return points, weights, knots + [knots[-1]]


def swept(points, weights, knots, degree):
    """Parameters of the surface that a contour sweeps from -HALF_HEIGHT to HALF_HEIGHT."""
    rows = [[point + (z,) for point in points] for z in (-HALF_HEIGHT, HALF_HEIGHT)]
    ends = [-HALF_HEIGHT] * 2 + [HALF_HEIGHT] * 2
    return bspline_surface(rows, [weights, weights], knots, ends, degree, 1)


def reverse(points, knots):
    return points[::-1], [knots[0] + knots[-1] - knot for knot in knots[::-1]]


def evaluate(points, weights, knots, degree, u):
    """A point of a curve, by de Boor's algorithm."""
    k = max(i for i in range(degree, len(points)) if knots[i] <= u)
    d = [(w * x, w * y, w) for (x, y), w in
         zip(points[k - degree:k + 1], weights[k - degree:k + 1])]
    for r in range(1, degree + 1):
        for j in range(degree, r - 1, -1):
            low, high = knots[j + k - degree], knots[j + 1 + k - r]
            t = (u - low) / (high - low)
            d[j] = tuple((1 - t) * a + t * b for a, b in zip(d[j - 1], d[j]))
    return (d[degree][0] / d[degree][2], d[degree][1] / d[degree][2])


def sample(points, weights, knots, degree, count=4000):
    first, last = knots[degree], knots[len(points)]
    return [evaluate(points, weights, knots, degree, first + (last - first) * i / count)
            for i in range(count)]


def sample_rear_door(pieces):
    result = []
    for piece in pieces:
        a, b = piece[-2], piece[-1]
        bulged = piece[0] == "line" and piece is pieces[BULGED_PIECE]
        for i in range(200):
            point = add(a, (b[0] - a[0], b[1] - a[1]), i / 200.0)
            if piece[0] == "arc":
                point = add(piece[1], direction(piece[1], point), piece[2])
            elif bulged:
                point = evaluate(bulged_points(a, b, -1.0), [1.0] * 5, BULGED_KNOTS, 4, i / 200.0)
            result.append(point)
    return result


def smallest_radius(samples):
    """Smallest radius of the circles through three samples that follow each other."""
    smallest = math.inf
    for i in range(len(samples)):
        a, b, c = samples[i - 2], samples[i - 1], samples[i]
        area = abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
        if area > 0:
            smallest = min(smallest, math.dist(a, b) * math.dist(b, c) * math.dist(a, c) / area / 2)
    return smallest


def bounded_plane(file, start, end, name):
    """A plane between two points: a bilinear surface within a trimmed surface, type 144."""
    margin = 0.25
    outer = [add(start, (start[0] - end[0], start[1] - end[1]), margin),
             add(end, (end[0] - start[0], end[1] - start[1]), margin)]
    rows = [[point + (z,) for point in outer] for z in (-2 * HALF_HEIGHT, 2 * HALF_HEIGHT)]
    base = file.add(128, bspline_surface(rows, [[1.0] * 2] * 2, [0.0, 0.0, 1.0, 1.0],
                                         [0.0, 0.0, 1.0, 1.0], 1, 1), subordinate=1)
    low = margin / (1.0 + 2.0 * margin)
    corners = [(low, 0.25), (1.0 - low, 0.25), (1.0 - low, 0.75), (low, 0.75)]
    flat, model = [], []
    for i, a in enumerate(corners):
        b = corners[(i + 1) % 4]
        flat.append(file.add(110, [a[0], a[1], 0.0, b[0], b[1], 0.0], subordinate=1))
        ends = [(end if p[0] > 0.5 else start) + ((HALF_HEIGHT if p[1] > 0.5 else -HALF_HEIGHT),)
                for p in (a, b)]
        model.append(file.add(110, list(ends[0] + ends[1]), subordinate=1))
    flat = file.add(102, [4] + flat, subordinate=1)
    model = file.add(102, [4] + model, subordinate=1)
    boundary = file.add(142, [1, base, flat, model, 1], subordinate=1)
    file.add(144, [base, 1, 0, boundary], label=name[-8:], name=name)


def bulged_points(start, end, side):
    """Control points of a quartic from start to end, tangent there to the line between them."""
    e = direction(start, end)
    length = math.dist(start, end)
    # 0.375: the share of the middle control point in the middle of a quartic.
    middle = add(add(start, e, length / 2), (-e[1], e[0]), side * BULGE / 0.375)
    return [start, add(start, e, length / 6), middle, add(end, e, -length / 6), end]


def write_rear_door(path, pieces):
    """A shell: a trimmed plane, swept lines and arcs, a swept spline, and a revolution."""
    file = IgesFile("RearDoor")
    lines = arcs = 0
    for piece in pieces:
        # Clockwise: each piece from its end to its start.
        start, end = piece[-1], piece[-2]
        if piece[0] == "line":
            lines += 1
            name = "RearDoorSide%d" % lines
            if lines == 1:
                bounded_plane(file, start, end, name)
                continue
            if piece is pieces[BULGED_PIECE]:
                curve = [point + (-HALF_HEIGHT,) for point in bulged_points(start, end, 1.0)]
                base = file.add(126, bspline_curve(curve, [1.0] * 5, BULGED_KNOTS, 4),
                                subordinate=1)
            else:
                base = file.add(110, list(start) + [-HALF_HEIGHT] + list(end) + [-HALF_HEIGHT],
                                subordinate=1)
            file.add(122, [base] + list(start) + [HALF_HEIGHT], label=name[-8:], name=name)
            continue
        arcs += 1
        name, centre = "RearDoorCorner%d" % arcs, piece[1]
        if arcs == 1:
            # A line turned about the arc's axis.
            axis = file.add(110, list(centre) + [-HALF_HEIGHT] + list(centre) + [HALF_HEIGHT],
                            subordinate=1)
            line = file.add(110, list(end) + [-HALF_HEIGHT] + list(end) + [HALF_HEIGHT],
                            subordinate=1)
            turn = [math.atan2(p[1] - centre[1], p[0] - centre[0]) for p in (end, start)]
            turn = (turn[1] - turn[0]) % (2 * math.pi)
            file.add(120, [axis, line, 0.0, turn], label=name[-8:], name=name)
            continue
        # Arcs run counter-clockwise in IGES; swept downwards the normal points inwards again.
        base = file.add(100, [HALF_HEIGHT] + list(centre) + list(end) + list(start),
                        subordinate=1)
        file.add(122, [base] + list(end) + [-HALF_HEIGHT], label=name[-8:], name=name)
    file.write(path)


def main(folder):
    contours = {}

    points, knots = clamped_closed_cubic(control_polygon(OUTER_CONTOUR))
    file = IgesFile("SidePanelOuter")
    file.add(128, swept(points, [1.0] * len(points), knots, 3), label="OUTER", name="OuterContour")
    file.write(os.path.join(folder, "SidePanelOuter.igs"))
    contours["SidePanelOuter"] = sample(points, [1.0] * len(points), knots, 3)

    points, knots = reverse(*clamped_closed_cubic(control_polygon(FRONT_DOOR)))
    file = IgesFile("FrontDoor")
    base = file.add(128, swept(points, [1.0] * len(points), knots, 3), subordinate=1)
    file.add(144, [base, 0, 0, 0], label="FRONTDR", name="FrontDoorOpening")
    file.write(os.path.join(folder, "FrontDoor.igs"))
    contours["FrontDoor"] = sample(points, [1.0] * len(points), knots, 3)

    pieces = rounded(REAR_DOOR)
    write_rear_door(os.path.join(folder, "RearDoor.igs"), pieces)
    contours["RearDoor"] = sample_rear_door(pieces)

    points, weights, knots = wheel_arch()
    file = IgesFile("WheelArch")
    file.add(128, swept(points, weights, knots, 2), label="WHEEL", name="WheelArch")
    file.write(os.path.join(folder, "WheelArch.igs"))
    contours["WheelArch"] = sample(points, weights, knots, 2)

    for name, samples in contours.items():
        others = [p for other in contours if other != name for p in contours[other][::8]]
        print("%-15s smallest radius %6.1f  distance to the next contour %6.1f  x %5.0f to %5.0f"
              "  y %5.0f to %5.0f" % (
                  name, smallest_radius(samples[::4]),
                  min(math.dist(p, q) for p in samples[::16] for q in others),
                  min(p[0] for p in samples), max(p[0] for p in samples),
                  min(p[1] for p in samples), max(p[1] for p in samples)))
    return contours


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__)))
