/**
 * @file MapValues.h
 * @brief Maps the input's values to where nodes and elements are after the trim.
 */
#ifndef MapValues_h
#define MapValues_h

#include "PartQuality.h"

class vtkUnstructuredGrid;

namespace trim
{

/**
 * New values for the part's moved nodes and changed elements, see ValueWeights.h, in all arrays of
 * floating point that the output has from the input. Those of elements stay within the range of
 * the values they are made of. Where one of these is not finite, what was taken along stays.
 * Collective: the values are those of all ranks' pieces.
 */
void MapValues(vtkUnstructuredGrid* input, const Ranks& ranks, const GridPart& part,
  const MovedNodes& moved, const BandShapes& shapes, vtkUnstructuredGrid* output);

}

#endif
