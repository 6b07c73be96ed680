/**
 * @file StatusArrays.h
 * @brief The status arrays, for any selection of the input's points and cells.
 */
#ifndef StatusArrays_h
#define StatusArrays_h

#include "Selection.h"
#include "TrimResult.h"

#include <vector>

class vtkCellData;
class vtkPointData;

namespace trim
{

/// The nodes of the band that the trim moved and one part of the result uses.
struct MovedNodes
{
  const Moves* NodeMoves = nullptr;
  const Band* TheBand = nullptr;
  std::vector<int> Nodes; ///< of the band, by ascending point of the input

  /// Calls action(place, node) for the places of the nodes among the points of an output.
  template <typename Action>
  void ForPlaces(const Selection& points, const Action& action) const
  {
    for (const int node : this->Nodes)
    {
      if (this->TheBand->GlobalNode[node] >= 0)
      {
        points.ForPlaces(
          this->TheBand->GlobalNode[node], [&action, node](Id place) { action(place, node); });
      }
    }
  }
};
MovedNodes MovedNodesOfKept(const TrimResult& result);
MovedNodes MovedNodesOfOffcut(const TrimResult& result);

/// NodeStatus, SignedDistance, Displacement and CorrectionApplied of the points `ids`.
void AddPointStatuses(
  const TrimResult& result, const MovedNodes& moved, const Selection& ids, vtkPointData* pointData);

/// ElementStatus and EliminatedFraction of the cells `ids`.
void AddCellStatuses(const TrimResult& result, const Selection& ids, vtkCellData* cellData);

/// Rescue of so many cells.
/// @param placeOf of each element of the band: which of them it is, -1: none.
void AddRescues(
  const TrimResult& result, Id cells, const std::vector<Id>& placeOf, vtkCellData* cellData);

}

#endif
