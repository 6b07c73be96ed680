"""The status arrays come with a colour and a name for each value, in the legend too."""
import os

from paraview.simple import (ColorBy, CreateRenderView, GetColorTransferFunction, GetScalarBar,
                             OutputPort, ResetCamera, SaveScreenshot, Show)

from Checks import OUTPUT_DIRECTORY, check, check_equal, plane_at, sheet, trim

NAMES = {
    "NodeStatus": ["0", "keep", "1", "eliminate", "2", "on surface"],
    "ElementStatus": ["0", "keep", "1", "eliminate", "2", "to treat"],
    "CorrectionApplied": ["0", "none", "2", "type II", "3", "type III", "4", "relaxed"],
    "Feasibility": ["0", "as assumed", "1", "sharp bend or edge", "2", "inclined",
                    "3", "narrow hole", "4", "edge crossed twice", "5", "cut-out not opened",
                    "6", "open seam"],
    "Shortfall": ["0", "none", "1", "below the quality floor", "2", "left off the surface",
                  "3", "invalid", "4", "invalid as it came", "5", "short edge", "6", "loose part"],
    "NewBoundary": ["0", "other", "1", "new border"],
    "CornerLost": ["0", "none", "1", "corner lost"],
    "Inserted": ["0", "of the input", "1", "inserted"],
}


def check_maps():
    for array, names in NAMES.items():
        colors = GetColorTransferFunction(array)
        check_equal(colors.InterpretValuesAsCategories, 1, array + " by categories")
        check_equal(list(colors.Annotations), names, "names of " + array)
        count = len(names) // 2
        triples = [tuple(colors.IndexedColors[3 * i:3 * i + 3]) for i in range(count)]
        check_equal(len(set(triples)), count, "different colours of " + array)
    # What is not computed is as grey as the rest.
    for array in ("SignedDistance", "ScaledJacobian"):
        check_equal(list(GetColorTransferFunction(array).NanColor), [0.55] * 3, "NaN of " + array)


def colors_in(path):
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOImage import vtkPNGReader
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    pixels = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
    return {tuple(pixel) for pixel in pixels[:, :3]}


def check_view(result):
    """In the view the three statuses are told apart, by the colours of the map."""
    view = CreateRenderView(ViewSize=[800, 500])
    display = Show(OutputPort(result, 1), view)
    check_equal(display.Representation, "Surface With Edges", "representation")
    display.SetRepresentationType("Surface")
    display.Ambient, display.Diffuse = 1, 0
    ColorBy(display, ("CELLS", "ElementStatus"))
    display.SetScalarBarVisibility(view, True)
    colors = GetColorTransferFunction("ElementStatus")
    check(GetScalarBar(colors, view).Visibility, "no legend")
    ResetCamera(view)
    path = os.path.join(OUTPUT_DIRECTORY, "status-colors.png")
    SaveScreenshot(path, view)
    seen = colors_in(path)
    for value in range(3):
        wanted = [round(255 * c) for c in colors.IndexedColors[3 * value:3 * value + 3]]
        check(any(max(abs(int(a) - b) for a, b in zip(pixel, wanted)) <= 2 for pixel in seen),
              "the colour of %s is not in the picture" % NAMES["ElementStatus"][2 * value + 1])


check_maps()
check_view(trim(sheet(), plane_at(10.3)))
