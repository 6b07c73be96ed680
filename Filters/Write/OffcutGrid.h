/**
 * @file OffcutGrid.h
 * @brief Writes the offcut: the part that is cut away, fitted to the kept part.
 */
#ifndef OffcutGrid_h
#define OffcutGrid_h

#include "WritePart.h"

namespace trim
{

/**
 * Fills `output` with the elements that are not kept and the rests of those that became wedges,
 * with the same arrays as the trimmed grid (but Rescue) and, as field data, what the summary says
 * of touched elements, volume and numbering. Collective.
 */
void WriteOffcutGrid(const WriteInput& from, vtkUnstructuredGrid* output);

}

#endif
