"""The filter under MPI: pieces of several kinds, against the trim of the whole on each rank."""
import numpy as np

from Checks import wave_at
from Grids import RANK, RANKS, compare, compare_summaries, extract, trim_with, whole_grid

TREATMENTS = [(2, 2), (2, 1), (3, 2), (1, 0)]
grid = whole_grid()
count = grid.GetNumberOfCells()
surface = wave_at(10.3)
surface = surface.GetClientSideObject()
surface.UpdatePiece(0, 1, 0)
surface = surface.GetOutputDataObject(0)
layers = np.arange(count) // (count // 2)
partitions = {
    "slabs": np.arange(count) * RANKS // count,
    "scattered": np.random.RandomState(5).randint(0, RANKS, count),
    "layers": layers % RANKS,
    "last rank only": np.full(count, RANKS - 1),
}
for i, (name, rank_of) in enumerate(partitions.items()):
    for correction, optimization in (TREATMENTS[i], TREATMENTS[(i + 1) % 4]):
        what = "%s, type %d, treatment %d" % (name, correction, optimization)
        whole = trim_with(grid, surface, False, correction, optimization)
        piece = trim_with(extract(grid, np.nonzero(rank_of == RANK)[0]), surface, True, correction,
                          optimization)
        compare(whole[0], piece[0], what)
        compare(whole[1], piece[1], what + ", port 1")
        compare_summaries(whole[0], piece[0], what)
print("rank %d of %d: %d partitions are trimmed like the whole" % (RANK, RANKS, len(partitions)))
