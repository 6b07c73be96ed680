"""The proxies have the names, ports, properties, defaults and choices that the contract promises."""
import os

from paraview import servermanager
from paraview.simple import *

from Checks import DATA_DIRECTORY, check, check_equal, plane_at, sheet


def xml_of(group, name):
    manager = servermanager.ProxyManager().SMProxyManager
    prototype = manager.GetPrototypeProxy(group, name)
    check(prototype is not None, "no proxy %s in %s" % (name, group))
    return prototype


def check_proxies():
    for group, name, vtk_class, label in [
            ("filters", "TrimHexahedralGrid", "vtkTrimHexahedralGrid", "Trim Hexahedral Grid"),
            ("sources", "CADSurfaceReader", "vtkCADSurfaceReader", "CAD Surface Reader"),
            ("sources", "NURBSSurfaceSource", "vtkNURBSSurfaceSource", "NURBS Surface Source"),
            ("sources", "TrimLineSource", "vtkTrimLineSource", "Trim Line Source")]:
        prototype = xml_of(group, name)
        check_equal(prototype.GetVTKClassName(), vtk_class, "class of " + name)
        check_equal(prototype.GetXMLLabel(), label, "label of " + name)
        check(name in globals(), "pvpython does not know " + name)


def check_defaults(trim):
    expected = {"CorrectionType": "Type II: project nodes", "Optimization": "Degenerate to wedges",
                "InvertSide": 0, "UseKeepPoint": 0, "EliminationFraction": 0.5,
                "RenumberNodes": 1, "Tolerance": 1e-9, "QualityOfAllElements": 0,
                "ProduceOffcut": 0, "InsertLayer": 0, "MapValues": 0}
    for name, value in expected.items():
        check_equal(trim.GetPropertyValue(name), value, "default of " + name)
    check_equal(list(trim.KeepPoint), [0, 0, 0], "default of KeepPoint")
    for name in list(expected) + ["KeepPoint", "Input", "TrimmingSurface"]:
        check(len(trim.SMProxy.GetProperty(name).GetDocumentation().GetDescription()) > 20,
              name + " has no help text")


def check_values(trim):
    """Numbers of the contract and readable texts set the same; out of range is refused."""
    for name, choices in [("CorrectionType", {1: "Type I: eliminate elements",
                                              2: "Type II: project nodes",
                                              3: "Type III: slide along edges"}),
                          ("Optimization", {0: "None", 1: "Distribute nodes",
                                            2: "Degenerate to wedges"})]:
        for number, text in choices.items():
            setattr(trim, name, number)
            check_equal(getattr(trim, name), text, "%s = %d" % (name, number))
            trim.UpdateVTKObjects()
            setattr(trim, name, text)
            check_equal(trim.SMProxy.GetProperty(name).GetElement(0), number, name + " = " + text)
        try:
            setattr(trim, name, "Type IV")
        except ValueError:
            continue
        raise AssertionError(name + " takes a text that is none of its choices")
    for name, value in [("InvertSide", 1), ("UseKeepPoint", 1), ("EliminationFraction", 0.25),
                        ("RenumberNodes", 0), ("Tolerance", 1e-7), ("QualityOfAllElements", 1),
                        ("ProduceOffcut", 1), ("InsertLayer", 1), ("MapValues", 1)]:
        setattr(trim, name, value)
        check_equal(trim.GetPropertyValue(name), value, name)
    trim.KeepPoint = [1, 2, 3]
    check_equal(list(trim.KeepPoint), [1, 2, 3], "KeepPoint")


def check_no_slider(proxy, name):
    """The panel shows a slider where a range has both its ends: none where no step of it is right."""
    domain = proxy.SMProxy.GetProperty(name).GetDomain("range")
    check(domain.GetMinimumExists(0) and not domain.GetMaximumExists(0), name + " has a slider")


def check_trim_line():
    line = TrimLineSource()
    check_equal(line.Sheet, None, "default of Sheet, whatever source is active")
    for name, value in {"Closed": 0, "Length": 0, "FileName": "", "LengthUnit": "Millimetre",
                        "LineType": "Spline", "Resolution": 64}.items():
        check_equal(line.GetPropertyValue(name), value, "default of " + name)
    check_equal(list(line.Direction), [0, 0, 0], "default of Direction")
    check_equal(len(line.Points), 15, "default of Points")
    for name in ("Sheet", "Points", "Closed", "LineType", "Direction", "Length", "FileName",
                 "LengthUnit", "Resolution"):
        check(len(line.SMProxy.GetProperty(name).GetDocumentation().GetDescription()) > 20,
              name + " has no help text")
    groups = [line.SMProxy.GetPropertyGroup(i)
              for i in range(line.SMProxy.GetNumberOfPropertyGroups())]
    for widget in ("InteractiveSpline", "InteractivePolyLine"):
        group = [g for g in groups if g.GetPanelWidget() == widget][0]
        for function in ("HandlePositions", "Closed"):
            check(group.GetProperty(function) is not None, "%s without %s" % (widget, function))


def check_ports(trim):
    check_equal(trim.SMProxy.GetNumberOfOutputPorts(), 3, "output ports")
    check_equal(trim.SMProxy.GetOutputPortName(0), "Trimmed Grid", "name of port 0")
    check_equal(trim.SMProxy.GetOutputPortName(1), "Statuses", "name of port 1")
    check_equal(trim.SMProxy.GetOutputPortName(2), "Offcut", "name of port 2")
    check_equal(trim.SMProxy.GetProperty("Input").GetPortIndex(), 0, "port of Input")
    check_equal(trim.SMProxy.GetProperty("TrimmingSurface").GetPortIndex(), 1,
                "port of TrimmingSurface")


def check_file_types():
    """File > Open finds the reader for the four extensions."""
    factory = servermanager.vtkSMProxyManager.GetProxyManager().GetReaderFactory()
    factory.UpdateAvailableReaders()
    supported = factory.GetSupportedFileTypes(servermanager.ActiveConnection.Session)
    for extension in ("igs", "iges", "stp", "step"):
        check("*." + extension in supported, "no reader for *." + extension)
    opened = OpenDataFile(os.path.join(DATA_DIRECTORY, "WheelArch.igs"))
    check_equal(opened.GetXMLName(), "CADSurfaceReader", "reader of a .igs file")
    check_equal(opened.TimeLimit, 0, "TimeLimit of the reader")
    check_no_slider(opened, "TimeLimit")
    opened.TimeLimit = 250
    opened.UpdateVTKObjects()
    check("TimeLimit: 250" in str(opened.GetClientSideObject()), "TimeLimit as given")


check_proxies()
filter_proxy = TrimHexahedralGrid(Input=sheet(), TrimmingSurface=plane_at(10.3))
check_defaults(filter_proxy)
check_values(filter_proxy)
check_no_slider(filter_proxy, "Tolerance")
check_ports(filter_proxy)
check_trim_line()
check_file_types()
