"""What a GUI test's Python steps have at hand inside the window's own process."""
import os
import subprocess
import traceback

import numpy
from paraview import servermanager
from paraview.simple import *  # noqa: F401,F403: for the steps
from paraview.simple import (FindSource, GetActiveSource, GetActiveView, GetColorTransferFunction,
                             GetLayoutByName, GetScalarBar, GetViewsInLayout)
from paraview.modules.vtkRemotingMisc import vtkSMTooltipSelectionPipeline
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import reference
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter

from Checks import OUTPUT_DIRECTORY, check, check_close, check_equal, summary  # noqa: F401
from Replay import check_linked, pipeline
from Screen import screen
from StillWindow import StillWindow  # noqa: F401


def run(code):
    """Runs a step; what goes wrong is told on the process' standard error, not in the shell."""
    try:
        exec(code, globals())
    except BaseException:
        os.write(2, traceback.format_exc().encode())


def tell(text):
    os.write(1, (text + "\n").encode())


def active():
    return GetActiveSource()


def select(*selected):
    """Selects these in the Pipeline Browser: sources, or outputs as (source, port)."""
    model = servermanager.ActiveConnection.Session.GetSessionProxyManager().GetSelectionModel(
        "ActiveSources")
    model.SetCurrentProxy(None, model.CLEAR)
    for one in selected:
        proxy = one[0].SMProxy.GetOutputPort(one[1]) if isinstance(one, tuple) else one.SMProxy
        model.SetCurrentProxy(proxy, model.SELECT)


def save_screen(name, width, height):
    """A picture of the window, which stands in the screen's upper left corner."""
    pixels = numpy.ascontiguousarray(screen()[:height, :width][::-1])
    image = vtkImageData()
    image.SetDimensions(pixels.shape[1], pixels.shape[0], 1)
    image.GetPointData().SetScalars(numpy_to_vtk(pixels.reshape(-1, 3), deep=True))
    writer = vtkPNGWriter()
    writer.SetFileName(os.path.join(OUTPUT_DIRECTORY, name))
    writer.SetInputData(image)
    writer.Write()


def tooltip(association):
    """What the view tells of the node (0) or element (1) under the mouse."""
    text = reference("")
    vtkSMTooltipSelectionPipeline.GetInstance().GetTooltipInfo(association, text)
    return dict(line.replace("</p>", "").split(": ", 1)
                for line in str(text).splitlines() if ": " in line)


def check_color(color, pixels, what):
    """At least so many pixels of the screen have about this colour."""
    near = (numpy.abs(screen().astype(int) - color).max(axis=2) <= 8).sum()
    check(near >= pixels, "%d pixels in the colour of %s" % (near, what))


def representation():
    """The one visible representation of the active view."""
    shown = [r for r in GetActiveView().Representations
             if r.Visibility and hasattr(r, "ColorArrayName")]
    check_equal(len(shown), 1, "visible representations")
    return shown[0]


def shown_elements():
    port = representation().Input
    return port.GetDataInformation().GetNumberOfCells()


def check_first_view():
    """What Apply shows at once: the status of the elements, with a legend that names it."""
    shown = representation()
    check_equal(shown.Representation, "Surface With Edges", "representation")
    check_equal(list(shown.ColorArrayName), ["CELLS", "ElementStatus"], "coloured by")
    colors = GetColorTransferFunction("ElementStatus")
    check_equal(list(colors.Annotations), ["0", "keep", "1", "eliminate", "2", "to treat"],
                "names")
    check(GetScalarBar(colors, GetActiveView()).Visibility, "no legend")


def check_comparison(kept, volumes):
    """Three trims of the three types, each in a view with a title and a legend, linked cameras."""
    selected = GetActiveSource()
    trims = [FindSource("Type" + number) for number in ("I", "II", "III")]
    for index, (trim, volume) in enumerate(zip(trims, volumes)):
        check(trim is not None, "no trim of type %d" % (index + 1))
        check_equal(trim.GetProperty("CorrectionType").SMProperty.GetElement(0), index + 1, "type")
        check_equal(list(trim.KeepPoint), list(selected.KeepPoint), "settings of the selected trim")
        found = summary(trim)
        check_equal(found["Kept"], kept, "Kept")
        check_close(found["Volume"], volume, "Volume", 1e-6)
    layout = GetLayoutByName("Correction Types")
    views = GetViewsInLayout(layout)
    colors = GetColorTransferFunction("ElementStatus")
    titles = set()
    for view in views:
        check(GetScalarBar(colors, view).Visibility, "a view without legend")
        titles |= {shown.Input.Text for shown in view.Representations
                   if hasattr(shown, "Input") and shown.Input.GetXMLName() == "TextSource"}
    check_equal(len(titles), 4, "titles")
    check_linked(views)


def by_hand(python, how, height):
    """Starts AbortByHand.py, which waits for a trim to begin."""
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "AbortByHand.py")
    return subprocess.Popen([python, script, how, str(height)])


def count_starts(source):
    """A list that gets longer with each run of the source's algorithm."""
    starts = []
    source.GetClientSideObject().AddObserver("StartEvent", lambda *_: starts.append(1))
    return starts


def elements(source):
    return source.GetDataInformation().GetNumberOfCells()


def is_shown(name):
    view = GetActiveView()
    shown = view.SMProxy.FindRepresentation(FindSource(name).SMProxy, 0)
    return shown is not None and shown.GetProperty("Visibility").GetElement(0) == 1


def anew(source):
    """The summary of the same trim by a filter that has done nothing before."""
    properties = {name: source.GetPropertyValue(name) for name in source.ListProperties()}
    other = TrimHexahedralGrid(**properties)  # noqa: F405
    other.UpdatePipeline()
    found = summary(other)
    Delete(other)  # noqa: F405
    return found


def record(name):
    """Ends the trace and writes it, and what it has to bring back."""
    trace = servermanager.vtkSMTrace.StopTrace()
    for suffix, text in ((".py", trace), (".txt", pipeline())):
        with open(os.path.join(OUTPUT_DIRECTORY, name + suffix), "w") as file:
            file.write(text)
