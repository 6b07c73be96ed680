"""OpenCASCADE is loaded with the first CAD file and not before; a plugin that lacks the library which
needs it says so. With an argument: the part that runs in a plugin without that library."""
import os
import shutil
import subprocess
import sys

from paraview.simple import *

from Checks import DATA_DIRECTORY, OUTPUT_DIRECTORY, check, check_equal

LIBRARY = "libNURBSTrimCAD.so"


def loaded(library):
    with open("/proc/self/maps") as maps:
        return any(library in line for line in maps)


def read():
    reader = CADSurfaceReader(FileName=os.path.join(DATA_DIRECTORY, "WheelArch.igs"))
    reader.UpdatePipeline()
    return reader.GetDataInformation().GetNumberOfPoints()


def read_without():
    """In a copy of the plugin. Called by a process of its own, as this one has the library."""
    plugin = os.environ["PV_PLUGIN_PATH"]
    copy = os.path.join(OUTPUT_DIRECTORY, "WithoutCAD")
    shutil.rmtree(copy, ignore_errors=True)
    shutil.copytree(os.path.join(plugin, "NURBSTrim"), os.path.join(copy, "NURBSTrim"),
                    ignore=shutil.ignore_patterns(LIBRARY))
    environment = dict(os.environ, PV_PLUGIN_PATH=copy)
    run = subprocess.run(["pvpython", "--dr", __file__, "without"], env=environment, text=True,
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    check_equal(run.returncode, 0, "exit status, with " + run.stdout)
    errors = [line for line in run.stdout.splitlines() if "ERR|" in line]
    check_equal(len(errors), 1, "errors without the library, with " + run.stdout)
    for part in ("WheelArch.igs", LIBRARY, "build or install the plugin again"):
        check(part in errors[0], "no %r in %s" % (part, errors[0]))


if len(sys.argv) > 1:
    check_equal(read(), 0, "points without the library")
else:
    check(not loaded("libTKernel") and not loaded(LIBRARY), "OpenCASCADE is loaded with the plugin")
    check(read() > 0, "nothing was read")
    check(loaded("libTKernel") and loaded(LIBRARY), "read by something else")
    read_without()
