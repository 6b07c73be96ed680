"""Pictures of the side panel: the statuses before the trims and the mesh after them.

They correspond to the paper's Figs. 3 (statuses), 5 (close-up) and 9 (base mesh, trimmed mesh).
"""
import os

from paraview.simple import (ColorBy, CreateRenderView, Delete, GetColorTransferFunction,
                             GetScalarBar, OutputPort, PassArrays, SaveScreenshot, Show)

SIZE = [1600, 1100]
MESH_COLOR = [0.78, 0.84, 0.90]
SURFACE_COLOR = [0.84, 0.19, 0.15]
EDGE_COLOR = [0.15, 0.20, 0.25]

# Places worth a closer look: x, y and half the height of the picture, in millimetres.
REAR_OF_ROOF = (1235, 965, 75)
PILLAR_FOOT = (1395, 675, 60)
FRONT_DOOR_TOP = (640, 905, 60)
WHEEL_ARCH_AND_REAR_DOOR = (1105, 345, 130)
REAR_DOOR_CORNER = (780, 170, 50)
MIDDLE_OF_SHEET = (800, 550, 600)


class Picture:
    """A render view on a white ground, saved and deleted at the end."""

    def __init__(self, place, tilt):
        """place: x, y and half the height seen; tilt: degrees from the view straight down."""
        from math import cos, radians, sin
        x, y, half_height = place
        self.view = CreateRenderView(ViewSize=SIZE)
        self.view.UseColorPaletteForBackground = 0
        self.view.Background = [1, 1, 1]
        self.view.OrientationAxesVisibility = 0
        self.view.CameraParallelProjection = 1
        self.view.CameraParallelScale = half_height
        self.view.CameraFocalPoint = [x, y, 0]
        distance = 3000
        self.view.CameraPosition = [x, y - distance * sin(radians(tilt)),
                                    distance * cos(radians(tilt))]
        self.view.CameraViewUp = [0, 1, 0]

    def add_mesh(self, port, array=None):
        """Elements with their edges, in one colour or coloured by an array of the cells."""
        display = Show(port, self.view)
        display.SetRepresentationType("Surface With Edges")
        display.EdgeColor = EDGE_COLOR
        if array:
            ColorBy(display, ("CELLS", array))
            self._add_legend(display, array, "Lower Right Corner")
        else:
            self._color_plainly(display, MESH_COLOR)
        return display

    def add_nodes(self, port, array, radius):
        """Nodes as dots, coloured by an array of the points."""
        nodes = PassArrays(Input=port, PointDataArrays=[array])
        display = Show(nodes, self.view)
        display.SetRepresentationType("Point Gaussian")
        display.GaussianRadius = radius
        ColorBy(display, ("POINTS", array))
        self._add_legend(display, array, "Lower Left Corner")
        return display

    def add_surface(self, surface, opacity=0.6):
        display = Show(surface, self.view)
        display.SetRepresentationType("Surface")
        self._color_plainly(display, SURFACE_COLOR)
        display.Opacity = opacity
        return display

    @staticmethod
    def _color_plainly(display, color):
        display.ColorArrayName = ["POINTS", ""]
        display.AmbientColor = display.DiffuseColor = color

    def _add_legend(self, display, array, corner):
        display.SetScalarBarVisibility(self.view, True)
        legend = GetScalarBar(GetColorTransferFunction(array), self.view)
        legend.WindowLocation = corner
        legend.TitleColor = legend.LabelColor = [0, 0, 0]
        legend.TitleFontSize = legend.LabelFontSize = 20

    def save(self, directory, name):
        path = os.path.join(directory, name)
        SaveScreenshot(path, self.view, ImageResolution=SIZE)
        Delete(self.view)
        return path


def base_mesh_and_surfaces(mesh, surfaces, directory):
    picture = Picture(MIDDLE_OF_SHEET, tilt=30)
    picture.add_mesh(mesh)
    for surface in surfaces:
        picture.add_surface(surface, opacity=1)
    return picture.save(directory, "base-mesh.png")


def statuses(trim, surface, place, tilt, directory, name, nodes=False):
    picture = Picture(place, tilt)
    before = OutputPort(trim, 1)
    picture.add_mesh(before, "ElementStatus")
    picture.add_surface(surface, opacity=0.45)
    if nodes:
        picture.add_nodes(before, "NodeStatus", radius=1.0)
    return picture.save(directory, name)


def trimmed(trim, surfaces, place, tilt, directory, name):
    picture = Picture(place, tilt)
    picture.add_mesh(trim)
    for surface in surfaces:
        picture.add_surface(surface, opacity=0.35)
    return picture.save(directory, name)


def draw_all(trims, directory):
    """All pictures of the example; returns their paths."""
    outside, front_door, rear_door, wheel_arch = trims
    surfaces = [trim.TrimmingSurface for trim in trims]
    final = wheel_arch
    made = [base_mesh_and_surfaces(outside.Input, surfaces, directory)]
    made += [
        statuses(outside, surfaces[0], MIDDLE_OF_SHEET, 30, directory, "statuses-outside.png"),
        statuses(front_door, surfaces[1], MIDDLE_OF_SHEET, 30, directory,
                 "statuses-front-door.png"),
        statuses(rear_door, surfaces[2], MIDDLE_OF_SHEET, 30, directory,
                 "statuses-rear-door.png"),
        statuses(wheel_arch, surfaces[3], MIDDLE_OF_SHEET, 30, directory,
                 "statuses-wheel-arch.png"),
        statuses(outside, surfaces[0], PILLAR_FOOT, 30, directory,
                 "statuses-close-up.png", nodes=True),
    ]
    made += [
        trimmed(final, [], MIDDLE_OF_SHEET, 0, directory, "trimmed.png"),
        trimmed(final, [], REAR_OF_ROOF, 0, directory, "trimmed-roof.png"),
        trimmed(final, [], FRONT_DOOR_TOP, 0, directory, "trimmed-front-door.png"),
        trimmed(final, [], WHEEL_ARCH_AND_REAR_DOOR, 0, directory, "trimmed-wheel-arch.png"),
        trimmed(final, [], REAR_DOOR_CORNER, 0, directory, "trimmed-rear-door.png"),
        trimmed(final, surfaces, MIDDLE_OF_SHEET, 30, directory, "surfaces-over-mesh.png"),
        trimmed(final, surfaces, PILLAR_FOOT, 30, directory, "surfaces-over-mesh-close-up.png"),
    ]
    return made
