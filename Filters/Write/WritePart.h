/**
 * @file WritePart.h
 * @brief What the trimmed grid and the offcut have in common on their way to an output.
 */
#ifndef WritePart_h
#define WritePart_h

#include "GridPart.h"
#include "MapValues.h"
#include "PartQuality.h"
#include "Ranks.h"
#include "Summary.h"

#include <optional>

namespace trim
{

struct WriteOptions
{
  bool RenumberNodes = true;
  bool QualityOfAllElements = false;
  bool MapValues = false;
  bool InsertLayer = false;
};

/// What the outputs are written from.
struct WriteInput
{
  vtkUnstructuredGrid* Grid;
  const HexMesh& Mesh; ///< of the grid, as are the blocks
  const MeshBlocks& Blocks;
  const Ranks& All;
  const TrimResult& Result;
  WriteOptions Options;
  const Progress& Tell;
};

/// Elements and points with the arrays that they have in the input and by the trim. Collective.
/// @param shapes, moved of the part's elements and nodes.
template <typename NodesOf>
void WritePart(const WriteInput& from, const GridPart& part, const MovedNodes& moved,
  const BandShapes& shapes, const NodesOf& nodesOf, const std::optional<Renumbering>& renumbered,
  Summary& summary, vtkUnstructuredGrid* output)
{
  summary.NodeBandwidth =
    from.All.Largest(WriteElements(from.Mesh, from.Blocks, part, nodesOf, renumbered, output));
  WritePoints(from.Grid, from.Mesh, part, moved, output);
  if (from.Options.MapValues)
  {
    MapValues(from.Grid, from.All, part, moved, shapes, output);
  }
  AddStatusesAndFindings(from.Result, part, moved, output);
}

/// Quality and volume, and the input's field data. Collective.
void MeasurePart(const WriteInput& from, const GridPart& part, const BandShapes& shapes,
  Summary& summary, vtkUnstructuredGrid* output);

}

#endif
