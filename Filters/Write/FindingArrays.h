/**
 * @file FindingArrays.h
 * @brief The findings of a trim as arrays, for any selection of the input's points and cells.
 */
#ifndef FindingArrays_h
#define FindingArrays_h

#include "Findings.h"
#include "Selection.h"

class vtkCellData;
class vtkPointData;

namespace trim
{

/// DistanceLeft (float), NewBoundary and CornerLost (unsigned char) of the points `ids`.
void AddPointFindings(const Findings& findings, const Selection& ids, vtkPointData* pointData);

/// Feasibility (unsigned char) of the cells `ids`.
void AddCellFindings(const Findings& findings, const Selection& ids, vtkCellData* cellData);

/**
 * Shortfall (unsigned char) of the cells of an output.
 *
 * @param found by place in the output, in any order; -1: not there. Of several at one place the
 * gravest counts.
 */
void AddShortfalls(std::vector<std::pair<Id, Shortfall>> found, Id cells, vtkCellData* cellData);

}

#endif
