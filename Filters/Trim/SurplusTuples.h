/**
 * @file SurplusTuples.h
 * @brief Arrays of a grid with more tuples than it has points or cells.
 */
#ifndef SurplusTuples_h
#define SurplusTuples_h

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <string>

namespace trim
{

/**
 * The grid itself, or, where arrays have tuples that belong to no point or cell, one that is the
 * same without these: no output is to carry them on.
 * @param told which arrays these are; empty: none.
 */
vtkSmartPointer<vtkUnstructuredGrid> WithoutSurplus(vtkUnstructuredGrid* grid, std::string& told);

}

#endif
