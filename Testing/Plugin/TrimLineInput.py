"""Run by the window before TrimLineInWindow.xml: a sheet of 20 x 12 x 2 elements, a straight trim
line along y = 4, and the trim by it. The camera looks down at the line's middle point, so that it
is in the middle of the view whatever the window's size, and the view is 20 high."""
from paraview.simple import (GetActiveViewOrCreate, Hide, SetActiveSource, Show,
                             TrimLineSource)

from Checks import sheet, trim

view = GetActiveViewOrCreate("RenderView")
mesh = sheet()
line = TrimLineSource(registrationName="Line", LineType="Polyline", Sheet=mesh,
                      Points=[-2, 4, 0.5, 10, 4, 0.5, 22, 4, 0.5])
result = trim(mesh, line, registrationName="Trim")
Show(result, view)
Hide(mesh, view)
view.CameraParallelProjection = 1
view.CameraParallelScale = 10
view.CameraFocalPoint = [10, 4, 0.5]
view.CameraPosition = [10, 4, 100]
view.CameraViewUp = [0, 1, 0]
SetActiveSource(line)
