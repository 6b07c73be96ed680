"""What the pvpython tests share: checks, a small sheet, surfaces whose cut is known on paper."""
import os

from paraview.simple import NURBSSurfaceSource, Transform, TrimHexahedralGrid, UnstructuredCellTypes

OUTPUT_DIRECTORY = os.environ["NURBSTRIM_OUTPUT"]
DATA_DIRECTORY = os.environ["NURBSTRIM_DATA"]

# Elements of the sheet and its lengths: unit elements in x and y, thin layers.
COUNTS = (20, 12, 2)
ELEMENT_COUNT = COUNTS[0] * COUNTS[1] * COUNTS[2]
LENGTHS = (20.0, 12.0, 0.5)


def check(condition, text):
    if not condition:
        raise AssertionError(text)


def check_equal(found, expected, what):
    check(found == expected, "%s: %r, expected %r" % (what, found, expected))


def check_close(found, expected, what, relative=1e-9):
    check(abs(found - expected) <= relative * max(1.0, abs(expected)),
          "%s: %.17g, expected %.17g" % (what, found, expected))


def sheet(counts=COUNTS):
    """A sheet of 20 x 12 x 2 hexahedra, or so many; carries the two point arrays of its source
    along."""
    blocks = UnstructuredCellTypes(CellType=12, BlocksDimensions=counts, OutputPrecision=1)
    scaled = Transform(Input=blocks)
    scaled.Transform.Scale = [length / count for length, count in zip(LENGTHS, counts)]
    return scaled


def plane_at(x, lean=0.0):
    """The plane through (x, *, 0), leaning by this much per unit of z; its normal points to +x."""
    corners = [(x - 2 * lean, -3, -2), (x - 2 * lean, 15, -2),
               (x + 2 * lean, -3, 2), (x + 2 * lean, 15, 2)]
    return NURBSSurfaceSource(Degrees=[1, 1], ControlNetSize=[2, 2],
                              ControlPoints=[c for corner in corners for c in corner + (1.0,)],
                              KnotsU=[0, 0, 1, 1], KnotsV=[0, 0, 1, 1])


def wave_at(x, height=1.5):
    """A surface that swings about the given x along y: cubic along y, straight along z."""
    net = [(x + height * swing, -3 + 3 * i, z)
           for z in (-2, 2) for i, swing in enumerate((0, 1, -1, 1, -1, 1, 0))]
    return NURBSSurfaceSource(Degrees=[3, 1], ControlNetSize=[7, 2],
                              ControlPoints=[c for point in net for c in point + (1.0,)],
                              KnotsU=[0, 0, 0, 0, 1, 2, 3, 4, 4, 4, 4], KnotsV=[0, 0, 1, 1])


def trim(mesh, surface, **options):
    result = TrimHexahedralGrid(Input=mesh, TrimmingSurface=surface, **options)
    result.UpdatePipeline()
    return result


def summary(result):
    """The field data of the trimmed grid as a dictionary: array name to number."""
    result.UpdatePipeline()
    return {name: result.FieldData[name].GetRange(0)[0] for name in result.FieldData.keys()}


def fetch(result, port=0):
    """One output of a trim as a VTK data set."""
    from paraview import servermanager
    return servermanager.Fetch(result, idx=port) if port else servermanager.Fetch(result)


def arrays_of(attributes):
    return {attributes.GetArrayName(i): attributes.GetAbstractArray(i)
            for i in range(attributes.GetNumberOfArrays())}


def same_grids(a, b, what):
    """Two grids with the same points and cells, bit for bit."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    check_equal(a.GetNumberOfPoints(), b.GetNumberOfPoints(), what + ": points")
    check_equal(a.GetNumberOfCells(), b.GetNumberOfCells(), what + ": cells")
    check((vtk_to_numpy(a.GetPoints().GetData()) == vtk_to_numpy(b.GetPoints().GetData())).all(),
          what + ": coordinates differ")
    check((vtk_to_numpy(a.GetCells().GetConnectivityArray()) ==
           vtk_to_numpy(b.GetCells().GetConnectivityArray())).all(),
          what + ": connectivity differs")
