/**
 * @file StatusArrays.h
 * @brief The status arrays, for any selection of the input's points and cells.
 */
#ifndef StatusArrays_h
#define StatusArrays_h

#include "TrimPipeline.h"

#include <vector>

class vtkCellData;
class vtkPointData;

namespace trim
{

/// NodeStatus, SignedDistance, Displacement and CorrectionApplied of the points `ids`.
void AddPointStatuses(
  const TrimResult& result, const std::vector<Id>& ids, vtkPointData* pointData);

/// ElementStatus and EliminatedFraction of the cells `ids`.
void AddCellStatuses(const TrimResult& result, const std::vector<Id>& ids, vtkCellData* cellData);

/// Position in the band of each point that the trim moved and the result still uses.
std::vector<int> MovedBandNodes(const TrimResult& result);

}

#endif
