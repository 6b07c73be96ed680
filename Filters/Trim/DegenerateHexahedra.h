/**
 * @file DegenerateHexahedra.h
 * @brief Hexahedra that are wedges, as solvers without elements of six nodes have them.
 */
#ifndef DegenerateHexahedra_h
#define DegenerateHexahedra_h

#include <vtkSmartPointer.h>
#include <vtkType.h>
#include <vtkUnstructuredGrid.h>

namespace trim
{

/**
 * The grid itself, or, where hexahedra have two edges of a face that are a node each, one that is
 * the same but for these: they are wedges. The grid need not have been found free of defects.
 * @param count how many hexahedra these are, without those that are left out by their flags.
 */
vtkSmartPointer<vtkUnstructuredGrid> WithWedges(vtkUnstructuredGrid* grid, vtkIdType& count);

}

#endif
