"""Progress is reported and grows; an abort leaves the outputs empty and is no error; the next run
is whole again. Who can abort the trim is asked often, and a trim of what another one left is not made
after an abort."""
import nurbstrim.NURBSTrimFilter  # noqa: before GetClientSideObject, for the wrapped class

from Checks import check, check_equal, sheet, summary, trim, wave_at

whole = trim(sheet(), wave_at(10.3))
expected = repr(summary(whole))
algorithm = whole.GetClientSideObject()
reports = []


def on_progress(caller, event):
    reports.append(caller.GetProgress())


tag = algorithm.AddObserver("ProgressEvent", on_progress)
algorithm.Modified()
algorithm.Update()
check(len(reports) >= 5, "only %d progress reports" % len(reports))
check_equal(reports, sorted(reports), "progress goes back")
check(0 <= reports[0] < 0.5 and reports[-1] == 1.0, "progress from %g to %g" %
      (reports[0], reports[-1]))
algorithm.RemoveObserver(tag)


def abort(caller, event):
    if caller.GetProgress() < 1:
        caller.SetAbortExecute(1)


tag = algorithm.AddObserver("ProgressEvent", abort)
algorithm.Modified()
algorithm.Update()
for port in (0, 1):
    check_equal(algorithm.GetOutputDataObject(port).GetNumberOfCells(), 0,
                "elements of port %d after an abort" % port)
algorithm.RemoveObserver(tag)
algorithm.SetAbortExecute(0)
algorithm.Modified()
algorithm.Update()
check(algorithm.GetOutputDataObject(0).GetNumberOfCells() > 0, "nothing after the abort")
check_equal(repr(summary(whole)), expected, "summary after an abort")

# Asked between the reports of progress too, and not after the outputs were begun.
asked = []
tags = [algorithm.AddObserver("AbortCheckEvent", lambda caller, event: asked.append(caller.GetProgress()))]
algorithm.Modified()
algorithm.Update()
check(len(asked) > 3 * len(reports), "asked %d times, %d reports" % (len(asked), len(reports)))
next_trim = trim(whole, wave_at(5.3))
check_equal(summary(next_trim)["Kept"] > 0, True, "the next trim")
next_algorithm = next_trim.GetClientSideObject()
next_asked = []
next_algorithm.AddObserver("AbortCheckEvent", lambda *_: next_asked.append(1))
tags.append(algorithm.AddObserver("AbortCheckEvent", lambda *_: algorithm.SetAbortExecute(1)))
algorithm.Modified()
next_algorithm.Update()
check_equal(len(next_asked), 0, "work on an aborted input")
check_equal(next_algorithm.GetOutputDataObject(0).GetNumberOfCells(), 0, "elements of it")
for tag in tags:
    algorithm.RemoveObserver(tag)
algorithm.SetAbortExecute(0)
next_algorithm.Update()
check_equal(repr(summary(whole)), expected, "summary after an abort in sequence")
check(next_algorithm.GetOutputDataObject(0).GetNumberOfCells() > 0, "nothing of the next trim")
