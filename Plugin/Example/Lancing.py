"""Lances a sheet: a cut without scrap. Both parts stay, with a slit between them.

    PV_PLUGIN_PATH=build/lib pvpython Lancing.py OUTPUT_DIRECTORY

The trimmed grid and its offcut have the same nodes and facets along the cut. Append Datasets
merges no points, so both together are one mesh in which each node of the cut is there twice, at
one place: a slit that can open. Writes lanced.vtu; its cell array Part is 0 in the trimmed grid,
1 in the offcut.
"""
import os
import sys

from paraview.simple import (AppendDatasets, Calculator, OutputPort, SaveData, Transform,
                             TrimHexahedralGrid, TrimLineSource, UnstructuredCellTypes)

# The sheet, in millimetres: elements of 2 mm, two layers.
LENGTH, WIDTH, THICKNESS = 120.0, 80.0, 1.0
COUNTS = [60, 40, 2]

# A tongue, by points of its outline.
TONGUE = [35, 25, 0,  75, 22, 0,  88, 40, 0,  75, 58, 0,  35, 55, 0,  28, 40, 0]


def sheet():
    blocks = UnstructuredCellTypes(CellType=12, BlocksDimensions=COUNTS, OutputPrecision=1)
    scaled = Transform(Input=blocks)
    scaled.Transform.Scale = [size / count
                              for size, count in zip((LENGTH, WIDTH, THICKNESS), COUNTS)]
    return scaled


def marked(part, number):
    return Calculator(Input=part, AttributeType="Cell Data", ResultArrayName="Part",
                      Function=str(number))


def lance(mesh, surface):
    """The trim, and both its parts as one mesh with a slit."""
    trim = TrimHexahedralGrid(Input=mesh, TrimmingSurface=surface, ProduceOffcut=1)
    both = AppendDatasets(Input=[marked(OutputPort(trim, 0), 0), marked(OutputPort(trim, 2), 1)])
    both.UpdatePipeline()
    return trim, both


def main(output_directory):
    outline = TrimLineSource(Points=TONGUE, Closed=1, Direction=[0, 0, 1], Length=5)
    trim, both = lance(sheet(), outline)
    kept, offcut = (OutputPort(trim, port) for port in (0, 2))
    for name, part in (("trimmed grid", kept), ("offcut", offcut)):
        data = part.GetDataInformation()
        print("%-12s  %5d elements, %5d nodes" % (name, data.GetNumberOfCells(),
                                                  data.GetNumberOfPoints()))
    print("%-12s  %5d elements, %5d nodes" % (
        "lanced", both.GetDataInformation().GetNumberOfCells(),
        both.GetDataInformation().GetNumberOfPoints()))
    SaveData(os.path.join(output_directory, "lanced.vtu"), both, DataMode="Binary")


if __name__ == "__main__":
    if len(sys.argv) != 2 or not os.path.isdir(sys.argv[-1]):
        sys.exit(__doc__)
    main(*sys.argv[1:])
