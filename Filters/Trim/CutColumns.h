/**
 * @file CutColumns.h
 * @brief Columns that the cut can be followed by.
 */
#ifndef CutColumns_h
#define CutColumns_h

#include "NodeClassification.h"
#include "TrimBand.h"
#include "TrimmingSurface.h"

namespace trim
{

/**
 * Columns that the cut can be followed by: those through the sheet, else any, if nodes move: they
 * exist for their sake, and without that each element of a block goes by its own share.
 *
 * @param known closest points to nodes of the mesh.
 * @param[in,out] near its structure has the columns through the sheet before.
 */
void SetColumns(
  TrimBand& near, const NodeFeet& known, const nurbs::TrimmingSurface& surface, bool nodesMove);

}

#endif
