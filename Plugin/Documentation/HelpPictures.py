"""Draws the pictures of the help pages.

    PV_PLUGIN_PATH=build/lib sh Plugin/with-display.sh pvpython Plugin/Documentation/HelpPictures.py
"""
import os
import sys

from paraview.simple import (CADSurfaceReader, NURBSSurfaceSource, OutputPort, PassArrays,
                             PolyLineSource, Show, Sphere, Transform, TrimHexahedralGrid,
                             TrimLineSource, UnstructuredCellTypes)

HERE = os.path.dirname(os.path.abspath(__file__))
IMAGES = os.path.join(HERE, "Images")
DATA = os.path.join(HERE, "..", "..", "Data")
sys.path.insert(0, os.path.join(HERE, "..", "Example"))
from Pictures import SURFACE_COLOR, Picture, TILTED, WHOLE_SHEET  # noqa: E402

SIZE = [720, 440]


def sheet(counts, lengths):
    blocks = UnstructuredCellTypes(CellType=12, BlocksDimensions=counts, OutputPrecision=1)
    scaled = Transform(Input=blocks)
    scaled.Transform.Scale = [length / count for length, count in zip(lengths, counts)]
    return PassArrays(Input=scaled)


def draw_reader(mesh, surface):
    picture = Picture(WHOLE_SHEET, TILTED, SIZE)
    picture.add_mesh(mesh)
    picture.add_surface(surface, opacity=1)
    picture.save(IMAGES, "cad-surface-reader.png")


def draw_statuses(mesh, surface):
    trim = TrimHexahedralGrid(Input=mesh, TrimmingSurface=surface)
    picture = Picture((1395, 675, 60), TILTED, SIZE)
    picture.add_mesh(OutputPort(trim, 1), "ElementStatus")
    picture.add_surface(surface, opacity=0.45)
    picture.save(IMAGES, "statuses.png")


def draw_surface_source():
    surface = NURBSSurfaceSource()
    picture = Picture((0, 0, 1.25), 50, SIZE)
    picture.add_surface(surface, opacity=0.6)
    points = list(surface.ControlPoints)
    columns = surface.ControlNetSize[0]
    net = [points[i:i + 3] for i in range(0, len(points), 4)]
    rows = [net[i:i + columns] for i in range(0, len(net), columns)]
    for line in rows + list(zip(*rows)):
        display = Show(PolyLineSource(Points=[c for point in line for c in point]), picture.view)
        display.SetRepresentationType("Wireframe")
        display.RenderLinesAsTubes = 1
        display.LineWidth = 2
        display.AmbientColor = display.DiffuseColor = [0.18, 0.28, 0.35]
    picture.save(IMAGES, "nurbs-surface-source.png")


def draw_line_source():
    mesh = sheet([40, 25, 2], [80, 50, 1])
    points = [20, 22, 0.5, 34, 12, 0.5, 52, 18, 0.5, 62, 32, 0.5, 44, 38, 0.5, 28, 34, 0.5]
    line = TrimLineSource(Points=points, Closed=1, Length=6)
    picture = Picture((40, 25, 29), TILTED, SIZE)
    picture.add_mesh(TrimHexahedralGrid(Input=mesh, TrimmingSurface=line))
    picture.add_surface(line, opacity=0.35)
    for i in range(0, len(points), 3):
        dot = Show(Sphere(Center=points[i:i + 3], Radius=0.7), picture.view)
        dot.AmbientColor = dot.DiffuseColor = SURFACE_COLOR
    picture.save(IMAGES, "trim-line-source.png")


def draw_layer():
    """A block cut aslant to all its elements, without and with a layer along the cut."""
    block = sheet([12, 12, 12], [12, 12, 12])
    corner = [-9, 12.5, -1.2, 1, 21, -11.5, -1.2, 1, -3, 12.5, 25, 1, 27, -11.5, 25, 1]
    plane = NURBSSurfaceSource(Degrees=[1, 1], ControlNetSize=[2, 2], ControlPoints=corner,
                               KnotsU=[0, 0, 1, 1], KnotsV=[0, 0, 1, 1])
    picture = Picture((20.6, 19.7, 12), 55, SIZE)
    for layer, aside in [(0, [0, 0, 0]), (1, [22.5, 13.3, 0])]:
        trim = TrimHexahedralGrid(Input=block, TrimmingSurface=plane, InsertLayer=layer,
                                  UseKeepPoint=1, KeepPoint=[11, 11, 0])
        moved = Transform(Input=trim)
        moved.Transform.Translate = aside
        picture.add_mesh(moved)
    picture.save(IMAGES, "inserted-layer.png")


panel = sheet([200, 138, 2], [1600, 1100, 0.8])
outside = CADSurfaceReader(FileName=os.path.join(DATA, "SidePanelOuter.igs"), Resolution=300)
draw_reader(panel, outside)
draw_statuses(panel, outside)
draw_surface_source()
draw_line_source()
draw_layer()
