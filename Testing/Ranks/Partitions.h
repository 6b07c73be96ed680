/**
 * @file Partitions.h
 * @brief Random ways to give the cells of a grid to ranks.
 */
#ifndef Partitions_h
#define Partitions_h

#include "Draws.h"

#include <string>
#include <vector>

class vtkDataArray;
class vtkUnstructuredGrid;

namespace judge
{
/// slabs, scattered, checkerboard, voronoi, singles and few (of the cells that are cut, the rest on
/// one rank), sides (by the status of cells), cut (those scattered, the rest on one rank), last
/// (all on the last rank) and columns.
const std::vector<std::string>& RandomPartitions();

/**
 * The rank of each cell.
 *
 * @param statuses of the elements; null: not known.
 */
std::vector<int> DrawPartition(const std::string& name, const Mesh& mesh, vtkUnstructuredGrid* grid,
  vtkDataArray* statuses, int ranks, Dice& dice);
}

#endif
