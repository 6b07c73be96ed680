/**
 * @file Pieces.h
 * @brief Divides a grid among ranks in several ways, trims the pieces, and holds the result
 * against the trim of the whole.
 */
#ifndef Pieces_h
#define Pieces_h

#include "RunTrim.h"

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <functional>
#include <string>
#include <vector>

namespace judge
{
/// A grid with the ids that its points and cells have in the whole.
vtkSmartPointer<vtkUnstructuredGrid> WithWholeIds(vtkUnstructuredGrid* grid);

/**
 * Names: "slabs" (by place along the longest side), "scattered" (each cell at random), "layers"
 * (each layer of a sheet on another rank), "empty" (slabs, but rank 0 has nothing), "ghosts"
 * (slabs, each with a ring of ghost cells), "ids" (scattered, with the
 * mesh's global point ids, which the others do not have).
 */
std::vector<std::string> PartitionNames();

/// The mean of a cell's nodes.
Vec3 CentreOf(vtkUnstructuredGrid* grid, vtkIdType cell);

/// The pieces of a grid WithWholeIds, one a rank.
std::vector<vtkSmartPointer<vtkUnstructuredGrid>> Divide(
  const Mesh& mesh, vtkUnstructuredGrid* whole, const std::string& partition, int ranks);

struct DivideOptions
{
  int Ranks = 2;
  bool WithGhosts = false; ///< each piece has a ring of ghost cells
  bool WithIds = false;    ///< the pieces have the whole's global point ids
};

/// The same by the rank of each cell.
std::vector<vtkSmartPointer<vtkUnstructuredGrid>> DivideBy(
  vtkUnstructuredGrid* whole, const std::vector<int>& rankOf, const DivideOptions& options);

/// What the ranks have made.
struct PiecesOutcome
{
  std::vector<vtkSmartPointer<vtkUnstructuredGrid>> Trimmed, Statuses, Offcuts;
  std::vector<std::string> Errors, Warnings; ///< of all ranks
};

/// Something done to the filter of a rank.
using FilterAction = std::function<void(int rank, vtkTrimHexahedralGrid* filter)>;

/**
 * Runs the filter on all pieces at once, each on a rank of its own.
 *
 * @param before done to each filter first.
 * @param again done to each filter after the first run; with it there is a second one.
 */
PiecesOutcome TrimPieces(const std::vector<vtkSmartPointer<vtkUnstructuredGrid>>& pieces,
  const std::vector<vtkSmartPointer<vtkDataObject>>& surfaces, const TrimOptions& options,
  const FilterAction& before = {}, const FilterAction& again = {});

/**
 * Bit by bit: every cell of the whole in one piece, with the same nodes, and every array at every
 * cell and node; the same number of both. Empty: no difference.
 */
std::string DifferenceFromWhole(
  vtkUnstructuredGrid* whole, const std::vector<vtkSmartPointer<vtkUnstructuredGrid>>& pieces);

/// Whether two runs have said the same, whoever said it and whichever number a cell has; the first
/// text that differs from that of the whole. Empty: they have.
std::string DifferenceOfTexts(
  const std::vector<std::string>& whole, const std::vector<std::string>& pieces);

/// Whether vtkOriginalPointIds and vtkOriginalCellIds are the ids in the piece that each result was
/// made of. Empty: they are.
std::string DifferenceOfOriginalIds(const std::vector<vtkSmartPointer<vtkUnstructuredGrid>>& pieces,
  const std::vector<vtkSmartPointer<vtkUnstructuredGrid>>& results);

/// DifferenceFromWhole for the summary, but for NodeBandwidth, on every rank, the empty ones too.
std::string DifferenceOfSummaries(vtkUnstructuredGrid* input, vtkUnstructuredGrid* whole,
  const std::vector<vtkSmartPointer<vtkUnstructuredGrid>>& pieces);
}

#endif
