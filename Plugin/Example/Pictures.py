"""Pictures of the side panel: the statuses before the trims and the mesh after them.

They correspond to the paper's Figs. 3 (statuses), 5 (correction types I, II and III, close up)
and 9 (base mesh, trimmed mesh).
"""
import math
import os

from paraview.simple import (AssignViewToLayout, ColorBy, CreateLayout, CreateRenderView, Delete,
                             GetColorTransferFunction, GetScalarBar, OutputPort, PassArrays,
                             SaveScreenshot, Show, Text, Transform, TrimHexahedralGrid)

SIZE = [1600, 1100]
MESH_COLOR = [0.80, 0.86, 0.92]
SURFACE_COLOR = [0.84, 0.19, 0.15]
EDGE_COLOR = [0.25, 0.30, 0.35]
FINE_EDGE_COLOR = [0.50, 0.56, 0.62]  # where an element is only a few pixels wide

# Places: x, y and half the height of the picture, in millimetres.
WHOLE_SHEET = (800, 530, 660)
REAR_OF_ROOF = (1235, 965, 75)
PILLAR_FOOT = (1395, 675, 60)
FRONT_DOOR_TOP = (660, 890, 60)
WHEEL_ARCH_AND_REAR_DOOR = (1105, 345, 130)
REAR_DOOR_CORNER = (780, 170, 50)

# Degrees from the view straight down.
TILTED, UPRIGHT = 30, 0


class Picture:
    """A render view on a white ground, saved and deleted at the end."""

    def __init__(self, place, tilt, size=SIZE):
        x, y, half_height = place
        self.fine = half_height > 200
        self.size = size
        self.view = CreateRenderView(ViewSize=size)
        self.view.UseColorPaletteForBackground = 0
        self.view.Background = [1, 1, 1]
        self.view.OrientationAxesVisibility = 0
        self.view.CameraParallelProjection = 1
        self.view.CameraParallelScale = half_height
        self.view.CameraFocalPoint = [x, y, 0]
        distance, angle = 3000, math.radians(tilt)
        aside, height = distance * math.sin(angle), distance * math.cos(angle)
        self.view.CameraPosition = [x - 0.5 * aside, y - 0.87 * aside, height]
        self.view.CameraViewUp = [0, 1, 0]

    def add_mesh(self, port, array=None):
        """Elements with their edges, in one colour or coloured by an array of the cells."""
        display = Show(port, self.view)
        display.SetRepresentationType("Surface With Edges")
        display.EdgeColor = FINE_EDGE_COLOR if self.fine else EDGE_COLOR
        display.Ambient, display.Diffuse = 0.5, 0.5
        if array:
            ColorBy(display, ("CELLS", array))
            self._add_legend(display, array, "Lower Right Corner")
        else:
            self._color_plainly(display, MESH_COLOR)

    def add_nodes(self, port, array, radius):
        """Nodes as dots just above the sheet, coloured by an array of the points."""
        nodes = Transform(Input=PassArrays(Input=port, PointDataArrays=[array]))
        nodes.Transform.Translate = [0, 0, radius]
        display = Show(nodes, self.view)
        display.SetRepresentationType("Point Gaussian")
        display.GaussianRadius = radius
        display.Ambient, display.Diffuse = 0.5, 0.5
        ColorBy(display, ("POINTS", array))
        self._add_legend(display, array, "Lower Left Corner")

    def add_surface(self, surface, opacity):
        display = Show(surface, self.view)
        display.SetRepresentationType("Surface")
        self._color_plainly(display, SURFACE_COLOR)
        display.Ambient, display.Diffuse = 0.6, 0.4
        display.Opacity = opacity

    def add_title(self, text):
        display = Show(Text(Text=text), self.view)
        display.Color = [0, 0, 0]
        display.FontSize = 24
        display.WindowLocation = "Upper Center"

    def save(self, directory, name):
        path = os.path.join(directory, name)
        SaveScreenshot(path, self.view, ImageResolution=self.size)
        Delete(self.view)
        return path

    @staticmethod
    def _color_plainly(display, color):
        display.ColorArrayName = ["POINTS", ""]
        display.AmbientColor = display.DiffuseColor = color

    def _add_legend(self, display, array, corner):
        display.SetScalarBarVisibility(self.view, True)
        legend = GetScalarBar(GetColorTransferFunction(array), self.view)
        legend.WindowLocation = corner
        legend.HorizontalTitle = 1
        legend.ScalarBarLength = 0.16
        legend.DrawBackground = 1
        legend.BackgroundColor = [1, 1, 1, 1]
        legend.BackgroundPadding = 8
        legend.TitleColor = legend.LabelColor = [0, 0, 0]
        legend.TitleFontSize = legend.LabelFontSize = 20


def base_mesh_and_surfaces(mesh, surfaces, directory):
    picture = Picture(WHOLE_SHEET, TILTED)
    picture.add_mesh(mesh)
    for surface in surfaces:
        picture.add_surface(surface, opacity=1)
    return picture.save(directory, "base-mesh.png")


def statuses(trim, place, directory, name, nodes=False):
    """The whole mesh before the trim, by what became of its elements."""
    picture = Picture(place, TILTED)
    before = OutputPort(trim, 1)
    picture.add_mesh(before, "ElementStatus")
    picture.add_surface(trim.TrimmingSurface, opacity=0.45)
    if nodes:
        picture.add_nodes(before, "NodeStatus", radius=0.9)
    return picture.save(directory, name)


def trimmed(trim, surfaces, place, tilt, directory, name):
    picture = Picture(place, tilt)
    picture.add_mesh(trim)
    for surface in surfaces:
        picture.add_surface(surface, opacity=0.4)
    return picture.save(directory, name)


def correction_types(mesh, surface, place, directory, name):
    """The same cut by correction types I, II and III, side by side."""
    layout = CreateLayout(name)
    hint = layout.SplitHorizontal(0, 1.0 / 3.0)
    layout.SplitHorizontal(hint + 1, 0.5)
    pictures = []
    for text in ("Type I: eliminate elements", "Type II: project nodes",
                 "Type III: slide along edges"):
        trim = TrimHexahedralGrid(Input=mesh, TrimmingSurface=surface, CorrectionType=text)
        picture = Picture(place, UPRIGHT)
        picture.add_mesh(trim)
        picture.add_title(text)
        AssignViewToLayout(picture.view, layout)
        pictures.append(picture)
    path = os.path.join(directory, name)
    SaveScreenshot(path, layout, ImageResolution=[1800, 600])
    for picture in pictures:
        Delete(picture.view)
    Delete(layout)
    return path


def draw_all(trims, directory):
    """All pictures of the example; returns their paths."""
    surfaces = [trim.TrimmingSurface for trim in trims]
    outside, final = trims[0], trims[-1]
    made = [base_mesh_and_surfaces(outside.Input, surfaces, directory)]
    for trim, name in zip(trims, ("outside", "front-door", "rear-door", "wheel-arch")):
        made.append(statuses(trim, WHOLE_SHEET, directory, "statuses-%s.png" % name))
    made.append(statuses(outside, PILLAR_FOOT, directory, "statuses-close-up.png", nodes=True))
    made.append(correction_types(outside.Input, surfaces[0], (1390, 680, 36), directory,
                                 "correction-types.png"))
    for place, name in [(WHOLE_SHEET, "trimmed.png"),
                        (REAR_OF_ROOF, "trimmed-roof.png"),
                        (FRONT_DOOR_TOP, "trimmed-front-door.png"),
                        (WHEEL_ARCH_AND_REAR_DOOR, "trimmed-wheel-arch.png"),
                        (REAR_DOOR_CORNER, "trimmed-rear-door.png")]:
        made.append(trimmed(final, [], place, UPRIGHT, directory, name))
    for place, name in [(WHOLE_SHEET, "surfaces-over-mesh.png"),
                        (PILLAR_FOOT, "surfaces-over-mesh-close-up.png")]:
        made.append(trimmed(final, surfaces, place, TILTED, directory, name))
    return made
