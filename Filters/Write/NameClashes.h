/**
 * @file NameClashes.h
 * @brief Arrays of the input that have the names of the trim's own.
 */
#ifndef NameClashes_h
#define NameClashes_h

#include <vtkSmartPointer.h>

#include <string>

class vtkUnstructuredGrid;

namespace trim
{

/**
 * The grid whose arrays are to be taken along. What an earlier trim has written is left out, as
 * this one writes it anew; arrays of others with the names of the trim's own, a solver's
 * Displacement say, get "Input" before theirs, also of one that this trim does not write: the next
 * would take it for that of an earlier trim. Neither the grid nor its arrays are changed.
 *
 * @param[out] warning which arrays have another name now; empty: none.
 * @return the input itself if there is nothing to do.
 */
vtkSmartPointer<vtkUnstructuredGrid> ResolveNameClashes(
  vtkUnstructuredGrid* input, std::string& warning);

}

#endif
