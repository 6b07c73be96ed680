/**
 * @file GridPart.h
 * @brief A part of the mesh on its way to an output: which cells and points it has, in which
 * order, and where the points are.
 *
 * All of it is counted first and then filled in place by all threads, so that the memory is that
 * of the output and the result does not depend on the threads.
 */
#ifndef GridPart_h
#define GridPart_h

#include "NodeOrdering.h"
#include "Selection.h"
#include "StatusArrays.h"
#include "TrimPipeline.h"

#include <vtkSMPTools.h>

#include <array>
#include <atomic>
#include <memory>
#include <vector>

class vtkUnstructuredGrid;

namespace trim
{

struct GridPart
{
  std::vector<Id> Cells;   ///< input ids, ascending
  std::vector<Id> Points;  ///< input ids, by new number
  std::vector<int> Number; ///< of each input point: its new number, -1: it is not in the part
  NodeGraph Graph;         ///< the elements, in new numbers

  Selection CellIds() const { return Selection::Ascending(this->Cells); }
  Selection PointIds() const { return Selection::Numbered(this->Points, this->Number); }
};

/// Lists the flagged points, ascending, and numbers them.
void NumberFlagged(const std::atomic<unsigned char>* flags, Id count, GridPart& part);

/// Work for a thread at a time, in cells or points.
constexpr Id PartGrain = 30000;

/**
 * Fills Points, ascending, Number and Graph.
 *
 * @param nodesOf (i, nodes): the nodes of cell i of the part, in input ids; returns their number.
 */
template <typename NodesOf>
void NumberPoints(const HexMesh& mesh, GridPart& part, const NodesOf& nodesOf)
{
  const Id count = static_cast<Id>(part.Cells.size());
  auto& graph = part.Graph;
  graph.Offset.resize(count + 1);
  graph.Offset[0] = 0;
  {
    const std::unique_ptr<std::atomic<unsigned char>[]> used(
      new std::atomic<unsigned char>[mesh.NumberOfPoints] {});
    vtkSMPTools::For(0, count, PartGrain,
      [&](Id begin, Id end)
      {
        std::array<Id, 8> nodes;
        for (Id i = begin; i < end; ++i)
        {
          const int size = nodesOf(i, nodes);
          for (int k = 0; k < size; ++k)
          {
            used[nodes[k]].store(1, std::memory_order_relaxed);
          }
          graph.Offset[i + 1] = size;
        }
      });
    NumberFlagged(used.get(), mesh.NumberOfPoints, part);
  }
  for (Id i = 0; i < count; ++i)
  {
    graph.Offset[i + 1] += graph.Offset[i];
  }
  graph.NumberOfNodes = static_cast<int>(part.Points.size());
  graph.Connectivity.resize(graph.Offset.back());
  vtkSMPTools::For(0, count, PartGrain,
    [&](Id begin, Id end)
    {
      std::array<Id, 8> nodes;
      for (Id i = begin; i < end; ++i)
      {
        const int size = nodesOf(i, nodes);
        for (int k = 0; k < size; ++k)
        {
          graph.Connectivity[graph.Offset[i] + k] = part.Number[nodes[k]];
        }
      }
    });
}

/// New numbers for the points, so that the band is narrow.
void RenumberPart(const HexMesh& mesh, const Progress& progress, GridPart& part);

/// Points, cells, the input's attributes and the original ids.
void WritePart(vtkUnstructuredGrid* input, const HexMesh& mesh, const GridPart& part,
  const MovedNodes& moved, vtkUnstructuredGrid* output);

/// What ParaView colours by at first, unless the input has active scalars of its own.
void ColourByStatus(vtkUnstructuredGrid* grid);

}

#endif
