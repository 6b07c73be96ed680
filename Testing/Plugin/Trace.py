"""What Tools > Start Trace records of a trim and of an Apply runs again and gives the same trim."""
from paraview import smtrace
from paraview.simple import Delete, FindSource, TrimHexahedralGrid

from Checks import check, check_equal, sheet, summary, wave_at

mesh, surface = sheet(), wave_at(10.3)

smtrace.start_trace()
traced = TrimHexahedralGrid(registrationName="TheTrim", Input=mesh, TrimmingSurface=surface)
# The Apply button does this with whatever the panel changed.
apply = smtrace._create_trace_item_internal("PropertiesModified", kwargs={"proxy": traced.SMProxy})
traced.CorrectionType = "Type III: slide along edges"
traced.Optimization = "Distribute nodes"
traced.UseKeepPoint = 1
traced.KeepPoint = [19.0, 5.0, 0.25]
traced.RenumberNodes = 0
apply.finalize()
trace = smtrace.stop_trace()

for line in ("TrimHexahedralGrid(registrationName='TheTrim', Input=", "TrimmingSurface=",
             ".CorrectionType = 'Type III: slide along edges'",
             ".Optimization = 'Distribute nodes'", ".KeepPoint = [19.0, 5.0, 0.25]",
             ".UseKeepPoint = 1", ".RenumberNodes = 0"):
    check(line in trace, "not in the trace: %s\n%s" % (line, trace))

expected = repr(summary(traced))
Delete(traced)
del traced, apply
check(FindSource("TheTrim") is None, "the traced filter is still there")
exec(compile(trace, "trace", "exec"), {"__name__": "trace"})
check_equal(repr(summary(FindSource("TheTrim"))), expected, "summary of the trim from the trace")
