/**
 * @file PartQuality.h
 * @brief How good the elements of a part are that the trim touched, and how large the part is.
 */
#ifndef PartQuality_h
#define PartQuality_h

#include "GridPart.h"
#include "Ranks.h"
#include "Summary.h"

#include <functional>

namespace trim
{

/// A part's elements in the band, those of other ranks' pieces too.
struct BandShapes
{
  int Count = 0;
  /// By GridPart::InBand; with a Count of 0 where none of the part is. Thread-safe.
  std::function<FinalElement(int)> ShapeOf;
  std::function<int(int)> BandElementOf; ///< the element of the band that it lies in
  const Moves* NodeMoves = nullptr;      ///< null if there are none
};
BandShapes ShapesOfKept(const TrimResult& result);
BandShapes ShapesOfOffcut(const TrimResult& result);

/// ScaledJacobian of the elements that the trim touched, or of all.
void AddScaledJacobians(const HexMesh& mesh, const GridPart& part, const BandShapes& shapes,
  bool allElements, vtkUnstructuredGrid* output);

/// The volume of the part on all ranks; collective.
double VolumeOfPart(
  const MeshBlocks& blocks, const GridPart& part, const BandShapes& shapes, const Ranks& ranks);

/// Counts the elements with a moved node and those of them that are certified, and finds the
/// minima over them.
void SummariseTouched(const BandShapes& shapes, Summary& summary);

}

#endif
