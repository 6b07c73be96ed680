"""The first look at a trim: coloured by status whatever the input carries, and on a fine mesh the
colours are not hidden by the edges of the elements. Surfaces stand out from the mesh."""
import os

import numpy
from paraview import smstate
from paraview.simple import (ColorBy, CreateRenderView, Elevation, FindSource, FindViewOrCreate,
                             GetActiveView, GetColorTransferFunction, GetDisplayProperties,
                             LoadState, OutputPort, PassArrays, RenameSource, Render, ResetCamera, ResetSession,
                             SaveScreenshot, SaveState, Show, Transform, UnstructuredCellTypes)
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

from Checks import LENGTHS, OUTPUT_DIRECTORY, check, check_equal, plane_at, sheet, trim


def fine_sheet():
    """The sheet with cubes, each less than two pixels wide in the picture."""
    counts = (400, 240, 1)
    blocks = UnstructuredCellTypes(CellType=12, BlocksDimensions=counts, OutputPrecision=1)
    scaled = Transform(Input=blocks)
    scaled.Transform.Scale = [LENGTHS[0] / counts[0]] * 3
    return PassArrays(Input=scaled)


def pixels(view, name):
    path = os.path.join(OUTPUT_DIRECTORY, name)
    SaveScreenshot(path, view)
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())[:, :3].astype(int)


def share(image, value):
    """The share of the picture in the colour of a status."""
    colors = GetColorTransferFunction("ElementStatus").IndexedColors
    wanted = [round(255 * c) for c in colors[3 * value:3 * value + 3]]
    return numpy.mean(numpy.abs(image - wanted).max(axis=1) <= 2)


def unlit(display):
    display.Ambient, display.Diffuse = 1, 0


def check_active_scalars():
    """Scalars that the input is coloured by do not hide the statuses."""
    mesh = Elevation(Input=sheet())
    view = CreateRenderView(ViewSize=[400, 300])
    ColorBy(Show(mesh, view), ("POINTS", "Elevation"))
    result = trim(mesh, plane_at(8.3))
    for port in (0, 1):
        display = Show(OutputPort(result, port), view)
        check_equal(list(display.ColorArrayName), ["CELLS", "ElementStatus"], "coloured by")
        check_equal(display.Representation, "Surface With Edges", "representation")
        check(display.LookupTable is not None, "no color map")


def draws_edges(view):
    """Are edges drawn of anything that is shown in the view?"""
    Render(view)
    actors = view.SMProxy.GetClientSideObject().GetRenderer().GetActors()
    shown = [actor for actor in actors if actor.GetVisibility()]
    check(shown, "nothing is shown in the view")
    return any(actor.GetProperty().GetEdgeVisibility() for actor in shown)


def check_faded_edges():
    """Edges that cannot be seen are not drawn, and the picture is the same, but for the outline: there
    facets are seen from the side, and what the shader knows of their width is not exact."""
    view = CreateRenderView(ViewSize=[800, 500])
    display = Show(OutputPort(trim(fine_sheet(), plane_at(8.3)), 1), view)
    ResetCamera(view)
    for parallel in (0, 1):
        view.CameraParallelProjection = parallel
        check(not draws_edges(view), "edges of a fine mesh are drawn")
        without = pixels(view, "first-view-fine.png")
        # Translation by nothing worth mentioning: then the representation draws them.
        display.Position = [1e-9, 0, 0]
        check(draws_edges(view), "edges of a mesh that was moved are not drawn")
        changed = (pixels(view, "first-view-fine.png") != without).any(axis=1).mean()
        check(changed < 0.005, "edges that were left out change %g of the picture" % changed)
        display.Position = [0, 0, 0]
        check(not draws_edges(view), "edges of a fine mesh are drawn again")
    display.UseShaderReplacements = 0
    check(draws_edges(view), "edges that do not fade are not drawn")
    display.UseShaderReplacements = 1
    view.CameraParallelScale /= 10
    check(draws_edges(view), "edges are not drawn when there is room for them")
    view.CameraParallelProjection = 0
    view.CameraPosition = [9.0, 6.0, 3.0]
    check(draws_edges(view), "edges are not drawn from near")


def check_edges():
    """Edges are drawn where there is room for them, and only there."""
    for mesh, fine in ((sheet(), False), (fine_sheet(), True)):
        view = CreateRenderView(ViewSize=[800, 500])
        display = Show(OutputPort(trim(mesh, plane_at(8.3)), 1), view)
        unlit(display)
        ResetCamera(view)
        with_edges = share(pixels(view, "first-view-%d.png" % fine), 0)
        display.SetRepresentationType("Surface")
        without = share(pixels(view, "first-view-surface.png"), 0)
        check(without > 0.1, "no kept elements in the picture")
        if fine:
            check(with_edges > 0.99 * without, "the edges hide the colours of a fine mesh: %g of %g"
                  % (with_edges, without))
        else:
            check(with_edges < 0.95 * without, "no edges on a coarse mesh")


def check_representations():
    """The fading edges are in nobody's way: ParaView reports no error with any representation."""
    view = CreateRenderView(ViewSize=[400, 300])
    display = Show(trim(sheet(), plane_at(8.3)), view)
    for name in display.GetProperty("RepresentationTypesInfo").GetData():
        display.SetRepresentationType(name)
        pixels(view, "first-view-representation.png")


def check_surface():
    """A surface is seen on the mesh, also by who looks down at it, and from a state file as it was."""
    ResetSession()
    view = CreateRenderView(ViewSize=[400, 300], OrientationAxesVisibility=0)
    Show(sheet(), view, Representation="Surface With Edges")
    plane = plane_at(8.3)
    RenameSource("ThePlane", plane)
    display = Show(plane, view)
    view.CameraPosition, view.CameraFocalPoint = [8.3, 6, 100], [8.3, 6, 0]
    ResetCamera(view)
    image = pixels(view, "first-view-edge-on.png")
    red = (image[:, 0] > 100) & (image[:, 1:].max(axis=1) < 0.4 * image[:, 0])
    check(red.sum() > 100, "%d pixels of the surface seen edge-on" % red.sum())
    display.DiffuseColor = [0.1, 0.2, 0.9]
    path = os.path.join(OUTPUT_DIRECTORY, "first-view-surface.pvsm")
    SaveState(path)
    ResetSession()
    LoadState(path)
    display = GetDisplayProperties(FindSource("ThePlane"), FindViewOrCreate("RenderView1", "RenderView"))
    check_equal([round(c, 6) for c in display.DiffuseColor], [0.1, 0.2, 0.9], "colour, from state")


def check_state():
    """What was changed by hand stays as it was set when a state is loaded."""
    ResetSession()
    view = CreateRenderView(ViewSize=[400, 300])
    result = trim(sheet(), plane_at(8.3), registrationName="TheTrim")
    display = Show(result, view)
    ColorBy(display, ("POINTS", "NodeStatus"))
    display.UseShaderReplacements = 0
    path = os.path.join(OUTPUT_DIRECTORY, "first-view.pvsm")
    SaveState(path)
    script = smstate.get_state()
    ResetSession()
    LoadState(path)
    view = FindViewOrCreate("RenderView1", "RenderView")
    display = GetDisplayProperties(FindSource("TheTrim"), view)
    check_equal(list(display.ColorArrayName), ["POINTS", "NodeStatus"], "coloured by, from state")
    check_equal(display.UseShaderReplacements, 0, "fading edges turned off, from state")
    ResetSession()
    exec(compile(script, "state", "exec"), {"__name__": "state"})
    display = GetDisplayProperties(FindSource("TheTrim"), GetActiveView())
    check_equal(list(display.ColorArrayName), ["POINTS", "NodeStatus"], "coloured by, from script")


check_active_scalars()
check_edges()
check_faded_edges()
check_representations()
check_surface()
check_state()
