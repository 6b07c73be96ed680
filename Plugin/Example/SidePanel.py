"""Trims a sheet to the automotive side panel of the paper's Fig. 9.

    PV_PLUGIN_PATH=build/lib pvpython SidePanel.py DATA_DIRECTORY OUTPUT_DIRECTORY

Four trims in sequence, as in the paper: the outside contour, then three openings. Correction
type II, pentahedra by distributed nodes. Writes side-panel-trimmed.vtu and pictures, and prints
one row of the summary for each trim.
"""
import os
import sys

from paraview.simple import (CADSurfaceReader, PassArrays, SaveData, Transform, TrimHexahedralGrid,
                             UnstructuredCellTypes)

import Pictures
import Summary

TRIMS = [
    ("Outside", "SidePanelOuter.igs"),
    ("Front door", "FrontDoor.igs"),
    ("Rear door", "RearDoor.igs"),
    ("Wheel arch", "WheelArch.igs"),
]

# The sheet, in millimetres: elements of 8 mm, two layers.
LENGTH, WIDTH, THICKNESS = 1600.0, 1100.0, 0.8
COUNTS = [200, 138, 2]


def base_mesh():
    """A rectangular sheet of hexahedra with its corner at the origin."""
    blocks = UnstructuredCellTypes(registrationName="Blocks", CellType=12,
                                   BlocksDimensions=COUNTS, OutputPrecision=1)
    scaled = Transform(registrationName="Scaled", Input=blocks)
    scaled.Transform.Scale = [size / count
                              for size, count in zip((LENGTH, WIDTH, THICKNESS), COUNTS)]
    # Without the arrays that the source makes for its own purposes.
    return PassArrays(registrationName="Sheet", Input=scaled)


def trim_in_sequence(mesh, data_directory):
    """One trim after the other; the result of each is the input of the next."""
    trims = []
    for name, file_name in TRIMS:
        surface = CADSurfaceReader(registrationName=name + " surface",
                                   FileName=os.path.join(data_directory, file_name))
        surface.Resolution = 300  # for the pictures; the trim uses the exact surface
        mesh = TrimHexahedralGrid(registrationName=name, Input=mesh, TrimmingSurface=surface,
                                  CorrectionType="Type II: project nodes",
                                  Optimization="Distribute nodes")
        mesh.UpdatePipeline()
        if mesh.GetDataInformation().GetNumberOfCells() == 0:
            sys.exit("%s: the trim failed, nothing is left" % name)
        trims.append(mesh)
    return trims


def main(data_directory, output_directory):
    trims = trim_in_sequence(base_mesh(), data_directory)
    print(Summary.table(trims, [name for name, _ in TRIMS]), flush=True)

    # Not the default mode: Debian 12's ParaView cannot read back its own appended raw data.
    mesh_file = os.path.join(output_directory, "side-panel-trimmed.vtu")
    SaveData(mesh_file, proxy=trims[-1], DataMode="Binary")
    made = [mesh_file] + Pictures.draw_all(trims, output_directory)

    missing = [name for name in made if not os.path.isfile(name) or os.path.getsize(name) == 0]
    if missing:
        sys.exit("Not made: " + ", ".join(missing))


if __name__ == "__main__":
    if len(sys.argv) != 3 or not os.path.isdir(sys.argv[-1]):
        sys.exit(__doc__)
    main(*sys.argv[1:])
