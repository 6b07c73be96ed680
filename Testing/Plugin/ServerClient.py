"""The same trim here and on the server: the same summary. Argument: the server's port."""
import sys

from paraview.simple import Connect, Disconnect

from Checks import check_equal, sheet, summary, trim, wave_at

builtin = repr(summary(trim(sheet(), wave_at(10.3))))
Disconnect()
Connect("localhost", int(sys.argv[1]))
check_equal(repr(summary(trim(sheet(), wave_at(10.3)))), builtin, "summary on the server")
