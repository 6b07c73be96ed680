"""Trims every mesh of a directory with one surface, and writes a table of the results.

    PV_PLUGIN_PATH=build/lib pvpython TrimBatch.py meshes/ surface.igs results/

Reads all .vtu and .vtk files of meshes/, writes results/<name>.vtu for each, and results/trims.csv
with a line for each: the summary, and what the filter had to say. Of part.vtk and part.vtu the
results are part.vtk.vtu and part.vtu.vtu. A mesh that fails has its line, too, with the error in
it, and does not stop the others; the exit status is then 1.
"""
import csv
import glob
import os
import sys
from collections import Counter

from paraview.simple import CADSurfaceReader, Delete, OpenDataFile, TrimHexahedralGrid
from vtkmodules.vtkCommonCore import VTK_STRING
from vtkmodules.util.misc import calldata_type

import ResultFile

NUMBERS = ["Kept", "Eliminated", "Treated", "MovedNodes", "Pentahedra", "Wedges",
           "MinimumScaledJacobian", "MinimumIntegrationPointJacobian",
           "MaximumDistanceToSurface", "Volume", "NodeBandwidth"]
COLUMNS = ["mesh", "state"] + NUMBERS + ["messages"]


class Messages:
    """Collects a filter's errors and warnings, first line each, instead of printing them."""

    def __init__(self, proxy):
        self.errors, self.warnings = [], []
        algorithm = proxy.GetClientSideObject()
        algorithm.AddObserver("ErrorEvent", self._collector(self.errors))
        algorithm.AddObserver("WarningEvent", self._collector(self.warnings))

    @staticmethod
    def _collector(messages):
        @calldata_type(VTK_STRING)
        def collect(caller, event, text):
            # "ERROR: In file, line n" and "class (address): message", each on its own line.
            lines = [line for line in text.splitlines() if line and not line.endswith(":")]
            messages.append(lines[-1].split("): ", 1)[-1])
        return collect


def trim(mesh_file, surface, result_file):
    """One line of the table as a dictionary."""
    row = {"mesh": os.path.basename(mesh_file), "state": "failed"}
    try:
        mesh = OpenDataFile(mesh_file)
    except RuntimeError as error:
        row["messages"] = str(error).strip()
        return row
    result = TrimHexahedralGrid(Input=mesh, TrimmingSurface=surface)
    messages = Messages(result)
    result.UpdatePipeline()
    if result.GetDataInformation().GetNumberOfCells() > 0:
        row["state"] = "trimmed"
        ranges = {name: result.FieldData[name].GetRange(0) for name in NUMBERS}
        # Upside down, that of NaN: no element was touched that could be measured.
        row.update((name, "%.9g" % low) for name, (low, high) in ranges.items() if low <= high)
        if not ResultFile.write(result, result_file):
            row["state"] = "failed"
            messages.errors.append(result_file + " cannot be written")
    elif not messages.errors:
        messages.errors.append("no element is left, or the mesh cannot be read")
    row["messages"] = "; ".join(messages.errors + messages.warnings)
    Delete(result)
    Delete(mesh)
    return row


def result_names(mesh_files):
    """A name for each result: the mesh's without its ending, or with it where two would clash."""
    names = [os.path.basename(mesh_file) for mesh_file in mesh_files]
    stems = [os.path.splitext(name)[0] for name in names]
    taken = Counter(stems + names)
    return [(stem if taken[stem] == 1 else name) + ".vtu" for stem, name in zip(stems, names)]


def main(mesh_directory, surface_file, result_directory):
    mesh_files = sorted(glob.glob(os.path.join(mesh_directory, "*.vt[uk]")))
    if not mesh_files:
        sys.exit("There is no .vtu or .vtk file in " + mesh_directory)
    if not os.path.isfile(surface_file):
        sys.exit("There is no file " + surface_file)
    if os.path.realpath(result_directory) == os.path.realpath(mesh_directory):
        sys.exit("The results would overwrite the meshes: name another directory for them.")
    os.makedirs(result_directory, exist_ok=True)
    surface = CADSurfaceReader(FileName=surface_file)
    failed = 0
    with open(os.path.join(result_directory, "trims.csv"), "w", newline="") as file:
        table = csv.DictWriter(file, COLUMNS, restval="")
        table.writeheader()
        for mesh_file, name in zip(mesh_files, result_names(mesh_files)):
            row = trim(mesh_file, surface, os.path.join(result_directory, name))
            table.writerow(row)
            file.flush()
            failed += row["state"] == "failed"
            print("%-24s %s %s" % (row["mesh"], row["state"], row["messages"]), flush=True)
    if failed:
        sys.exit("%d of %d meshes failed, see trims.csv" % (failed, len(mesh_files)))


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
