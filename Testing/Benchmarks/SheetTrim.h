/**
 * @file SheetTrim.h
 * @brief What the filter's benchmarks trim: a sheet of two layers and a wavy surface through it.
 */
#ifndef SheetTrim_h
#define SheetTrim_h

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <memory>

namespace benchmark
{

/**
 * A square sheet of two layers, elements of 1 x 1 x 0.4.
 *
 * @param cells about so many.
 * @param shuffled nodes and cells numbered at random instead of by rows.
 */
vtkSmartPointer<vtkUnstructuredGrid> MakeSheet(vtkIdType cells, bool shuffled);

/// Side of that sheet, in elements.
int SideOfSheet(vtkIdType cells);

/// A bicubic of 12 x 8 control points across the middle of that sheet, moved by `shift` of a side.
vtkSmartPointer<vtkPolyData> MakeWave(vtkIdType cells, double shift);

/// A bicubic of `count` x `count` control points there, whose shape does not depend on their
/// number.
vtkSmartPointer<vtkPolyData> MakeFineWave(vtkIdType cells, double shift, int count);

/// The least a trim has to make: the kept cells and their points, compact, as a grid has them.
struct AnalyticTrim
{
  vtkIdType NumberOfPoints = 0, NumberOfCells = 0;
  std::unique_ptr<double[]> Points;
  std::unique_ptr<vtkTypeInt64[]> Offsets, Connectivity;
  std::unique_ptr<unsigned char[]> Types;
};

/**
 * The floor: keeps the cells with at most half of their nodes beyond the plane x = limit; one
 * thread. The grid has points in double precision and 64-bit ids.
 */
AnalyticTrim TrimByPlane(vtkUnstructuredGrid* grid, double limit);

}

#endif
