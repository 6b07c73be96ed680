"""What the sessions in the window have left: the trace of one, its state, and the state of another.
All in one process, which starts slower than it checks; the trace comes first, as it names the layout
that a fresh process has.
"""
import os
import runpy
import sys

from paraview.simple import ResetSession

for script, *arguments in (["Replay.py", ".py"], ["Replay.py", ".pvsm"], ["CheckWindow.py"]):
    sys.argv[1:] = arguments
    runpy.run_path(os.path.join(os.path.dirname(os.path.abspath(__file__)), script),
                   run_name="__main__")
    print(script, *arguments, "is as it was")
    ResetSession()
