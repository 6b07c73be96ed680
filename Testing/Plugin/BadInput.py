"""Bad input through the pipeline: one clear error, empty outputs, no crash, and a trim that works
again after it."""
import os

from paraview.simple import (AppendDatasets, NURBSSurfaceSource, OpenDataFile, OutputPort,
                             ProgrammableFilter, ProgrammableSource, SaveData, Sphere, Transform,
                             Wavelet)
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow

from Checks import (OUTPUT_DIRECTORY, arrays_of, check, check_equal, fetch, plane_at, sheet,
                    summary, trim)

window = vtkStringOutputWindow()
vtkOutputWindow.SetInstance(window)
seen = 0


def messages(kind):
    """The errors or warnings since the last call to mark()."""
    return [text for text in window.GetOutput()[seen:].split(kind)[1:]]


def mark():
    global seen
    seen = len(window.GetOutput())


def check_fails(what, mesh, surface, *words):
    """One error of the filter with these words in it; nothing on the outputs."""
    mark()
    result = trim(mesh, surface)
    errors = [text for text in messages("ERROR:") if "vtkTrimHexahedralGrid" in text]
    check_equal(len(errors), 1, "errors for %s: %s" % (what, window.GetOutput()[seen:]))
    for word in words:
        check(word in errors[0], "%s: no '%s' in: %s" % (what, word, errors[0]))
    for port in (0, 1):
        check_equal(fetch(result, port).GetNumberOfCells(), 0, "%s: port %d" % (what, port))
        check("Kept" not in arrays_of(fetch(result, port).GetFieldData()),
              "%s: a summary on port %d" % (what, port))
    # ParaView's writer crashes on grids that lack arrays.
    for port in (0, 1, 2):
        SaveData(os.path.join(OUTPUT_DIRECTORY, "nothing.vtu"), OutputPort(result, port),
                 DataMode="Binary")


def without_weights(surface, value):
    """The surface with the weight of its last control point changed in the field data."""
    return ProgrammableFilter(Input=surface, Script="""
import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
source = self.GetPolyDataInput()
output = self.GetPolyDataOutput()
output.DeepCopy(source)
points = vtk_to_numpy(output.GetFieldData().GetArray("NURBSControlPoints"))
points[-1, 3] = %s
""" % value)


check_fails("plain poly data", sheet(), Sphere(), "NURBS")
check_fails("tetrahedra and voxels", AppendDatasets(Input=Wavelet(WholeExtent=[0, 3, 0, 3, 0, 3])),
            plane_at(1.3), "cell")
check_fails("mesh and surface swapped", plane_at(10.3), sheet(), "vtkPolyData", "other input")
image = Wavelet(WholeExtent=[0, 20, 0, 12, 0, 2])
check_fails("an image", image, plane_at(1.3), "vtkImageData", "Transform", "Append Datasets")
check_fails("a structured grid", Transform(Input=image), plane_at(1.3), "vtkStructuredGrid",
            "Append Datasets")
check_fails("a table", ProgrammableSource(OutputDataSetType="vtkTable", Script=""), plane_at(1.3),
            "vtkTable")
check_fails("a table to trim with", sheet(), ProgrammableSource(OutputDataSetType="vtkTable", Script=""),
            "NURBS")
check_fails("a zero weight", sheet(), without_weights(plane_at(10.3), "0"), "weight")
check_fails("a weight that is no number", sheet(), without_weights(plane_at(10.3), "numpy.nan"))
corners = [(10.3, -3, -2), (10.3, 6, -2), (10.3, -3, 2), (10.3, 6, 2)]
check_fails("plain poly data on a trimmed grid", trim(sheet(), plane_at(15.3)), Sphere(), "NURBS")
check_fails("a surface that ends inside the grid", sheet(),
            NURBSSurfaceSource(Degrees=[1, 1], ControlNetSize=[2, 2],
                               ControlPoints=[c for p in corners for c in p + (1.0,)],
                               KnotsU=[0, 0, 1, 1], KnotsV=[0, 0, 1, 1]), "ends")

mark()
missed = summary(trim(sheet(), plane_at(40)))
check_equal(len(messages("ERROR:")), 0, "errors for a surface that misses the grid")
check_equal(len([text for text in messages("Warning:") if "vtkTrimHexahedralGrid" in text]), 1,
            "warnings for a surface that misses the grid")
check_equal(missed["Eliminated"], 0, "Eliminated by a surface that misses the grid")

# What ParaView opens by its name alone, the reader says what is wrong with it.
mark()
page = os.path.join(OUTPUT_DIRECTORY, "page.stp")
with open(page, "w") as file:
    file.write("<html>not found</html>")
OpenDataFile(page).UpdatePipeline()
check_equal(["neither IGES nor STEP" in text for text in messages("ERROR:")], [True],
            "errors for a page called .stp")

# What the messages advise helps.
mark()
check_equal(summary(trim(AppendDatasets(Input=Transform(Input=image)), plane_at(8.3)))["Kept"], 192,
            "Kept of an image made a grid of hexahedra")
check_equal(len(messages("ERROR:")), 0, "errors for an image made a grid of hexahedra")

mark()
check(summary(trim(sheet(), plane_at(10.3)))["Kept"] > 0, "no trim after the errors")
check_equal(len(messages("ERROR:")), 0, "errors of a good trim")
