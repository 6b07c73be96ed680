/**
 * @file OtherFilters.h
 * @brief What VTK's own filters make of a grid, to compare with.
 */
#ifndef OtherFilters_h
#define OtherFilters_h

#include <memory>

class vtkUnstructuredGrid;

namespace benchmark
{

std::shared_ptr<void> CopyGrid(vtkUnstructuredGrid* grid);

/// The first cells, so many of all.
std::shared_ptr<void> ExtractCells(vtkUnstructuredGrid* grid, double share);

/// What lies below the plane x = limit, by the filter behind ParaView's Clip.
std::shared_ptr<void> ClipByPlane(vtkUnstructuredGrid* grid, double limit);

}

#endif
