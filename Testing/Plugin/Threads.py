"""The same bits with one thread and with several."""
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkSMPTools

from Checks import arrays_of, check, check_equal, fetch, same_grids, sheet, trim, wave_at


def run(backend, threads):
    check(vtkSMPTools.SetBackend(backend), "no backend " + backend)
    vtkSMPTools.Initialize(threads)
    return trim(sheet(), wave_at(10.3))


def same_arrays(a, b, what):
    a, b = arrays_of(a), arrays_of(b)
    check_equal(sorted(a), sorted(b), what)
    for name in a:
        check(vtk_to_numpy(a[name]).tobytes() == vtk_to_numpy(b[name]).tobytes(),
              "%s: %s differs" % (what, name))


one = run("Sequential", 1)
for threads in (1, 2, 4):
    several = run("STDThread", threads)
    for port in (0, 1):
        a, b = fetch(one, port), fetch(several, port)
        what = "%d threads, port %d" % (threads, port)
        same_grids(a, b, what)
        same_arrays(a.GetPointData(), b.GetPointData(), what)
        same_arrays(a.GetCellData(), b.GetCellData(), what)
