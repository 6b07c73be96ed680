"""Brings back what TrimLineInWindow.py recorded, from its trace or from its state file: every trim and
line with its properties and numbers, every view with what it shows."""
import difflib
import os
import sys

from paraview.simple import (GetLayoutByName, GetSources, GetViews, GetViewsInLayout, LoadState,
                             Render)

from Checks import OUTPUT_DIRECTORY, check, check_equal, summary

TRIM = ["CorrectionType", "Optimization", "InvertSide", "UseKeepPoint", "KeepPoint",
        "EliminationFraction", "MinimumScaledJacobian", "ProduceOffcut", "RenumberNodes", "Tolerance",
        "QualityOfAllElements", "InsertLayer", "MapValues"]
LINE = ["Points", "Closed", "LineType", "Direction", "Length"]


def pipeline():
    """The session in words, one line each for a source and a view."""
    lines = []
    for (name, _), proxy in GetSources().items():
        kind = proxy.GetXMLName()
        names = {"TrimHexahedralGrid": TRIM, "TrimLineSource": LINE}.get(kind)
        if names:
            values = [(n, [round(v, 9) if isinstance(v, float) else v for v in value]
                       if hasattr(value := proxy.GetPropertyValue(n), "__len__") and
                       not isinstance(value, str) else value) for n in names]
            numbers = sorted(summary(proxy).items()) if names is TRIM else ""
            lines.append("%s %s %r %r" % (name, kind, values, numbers))
    for view in GetViews():
        shown = sorted("%s:%d %s" % (r.Input.GetXMLName(), r.Input.Port, r.ColorArrayName[1])
                       for r in view.Representations
                       if r.Visibility and hasattr(r, "ColorArrayName"))
        lines.append("view %r" % shown)
    return "\n".join(sorted(lines)) + "\n"


def check_linked(views):
    """Moving one of the four cameras moves all."""
    check_equal(len(views), 4, "views")
    for turn in (views[2].ResetActiveCameraToPositiveX, views[2].ResetActiveCameraToNegativeZ):
        turn()
        views[2].ResetCamera()
        Render(views[2])
        for view in views:
            check_equal([round(c, 6) for c in view.CameraPosition],
                        [round(c, 6) for c in views[2].CameraPosition], "camera of a linked view")


if __name__ == "__main__":
    recorded = os.path.join(OUTPUT_DIRECTORY, "session" + sys.argv[1])
    if recorded.endswith(".pvsm"):
        LoadState(recorded)
    else:
        with open(recorded) as file:
            exec(compile(file.read(), recorded, "exec"), {"__name__": "trace"})
    with open(os.path.join(OUTPUT_DIRECTORY, "session.txt")) as file:
        expected = file.read()
    check(expected.count("TrimHexahedralGrid ") == 4, "the trims recorded:\n" + expected)
    difference = "\n".join(difflib.unified_diff(expected.splitlines(), pipeline().splitlines()))
    check(difference == "", "the session from %s:\n%s" % (sys.argv[1], difference))
    check_linked(GetViewsInLayout(GetLayoutByName("Correction Types")))
