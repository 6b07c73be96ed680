/**
 * @file GridPart.h
 * @brief A part of the mesh on its way to an output: which cells and points it has, in which
 * order, and where the points are.
 *
 * All of it is counted first and then filled in place by all threads, so that the memory is that
 * of the output and the result does not depend on the threads; but for the cells of an offcut,
 * which one thread lists.
 */
#ifndef GridPart_h
#define GridPart_h

#include "ArrayNames.h"
#include "FreshArray.h"
#include "MeshBlocks.h"
#include "NodeOrdering.h"
#include "Progress.h"
#include "Runs.h"
#include "Selection.h"
#include "Status.h"
#include "StatusArrays.h"
#include "StreamedCopy.h"
#include "TrimResult.h"

#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>

#include <algorithm>
#include <array>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

class vtkDataSetAttributes;
class vtkUnstructuredGrid;

namespace trim
{

/// Work for a thread at a time, in cells or points.
constexpr Id PartGrain = 30000;

/// A point that the input does not have.
struct InsertedPoint
{
  Id Origin;  ///< the input's point in whose place it is
  Vec3 Place; ///< before any correction
};

/// Those of this rank, in the order of their ids, which follow those of the input.
std::vector<InsertedPoint> FindInsertedPoints(const TrimResult& result);

struct GridPart
{
  IdList Cells{ names::OriginalCells };   ///< input ids, ascending
  IdList Points{ names::OriginalPoints }; ///< input ids, by new number
  /// Of each cell: its place among the part's elements in the band, -1 away from the cut. Elements
  /// of the kept part are told by those of the band, of the offcut by Offcut::Elements.
  UnsetVector<int> InBand;
  /// Of each input point, then of each inserted one: its new number, -1: it is not in the part.
  UnsetVector<int> Number;
  std::vector<InsertedPoint> Inserted; ///< see FindInsertedPoints
  std::vector<Id> Offset; ///< nodes of the cells before each run of PartGrain cells, and of all

  /// So many cells are looked at at once where they are side by side: whole runs of the mesh.
  static constexpr Id Stretch = MeshBlocks::CellsPerClusterRun;
  /// Whether the cells from i on are so many that follow each other in the input, off the band.
  bool IsStretch(Id i, Id end) const
  {
    return i + Stretch <= end && this->Cells[i + Stretch - 1] == this->Cells[i] + Stretch - 1 &&
      this->AreOffBand(i);
  }
  /// Whether none of so many cells is in the band.
  bool AreOffBand(Id i) const
  {
    int all = -1;
    for (Id k = 0; k < Stretch; ++k)
    {
      all &= this->InBand[i + k];
    }
    return all == -1;
  }

  /// Calls action(i) for the cells from begin to end that are in the band.
  template <typename Action>
  void ForInBand(Id begin, Id end, const Action& action) const
  {
    for (Id i = begin; i < end;)
    {
      if (i + Stretch <= end && this->AreOffBand(i))
      {
        i += Stretch;
        continue;
      }
      if (this->InBand[i] >= 0)
      {
        action(i);
      }
      ++i;
    }
  }

  Selection CellIds() const { return Selection::Ascending(this->Cells); }
  Selection PointIds() const { return Selection::Numbered(this->Points, this->Number); }
};

/// Of each of so many elements of the part in the band, by InBand, its cell in the part; -1: none.
std::vector<Id> PlacesInBand(const GridPart& part, int count);

/// Calls action(run, begin, end) for all runs of PartGrain items, by all threads.
template <typename Action>
void ForRuns(Id count, const Action& action)
{
  ForRuns(count, PartGrain, action);
}

using PointFlags = UnsetVector<unsigned char>;

/// Sets the flags of points on a side, but for those all of whose cells are in the band: off the
/// band no cell joins points of both sides.
PointFlags FlagSideOffBand(
  const HexMesh& mesh, const MeshBlocks& blocks, const TrimResult& result, NodeStatus side);

/// Lists the flagged points and numbers them: ascending, inserted ones behind those in whose places
/// they are.
void NumberFlagged(const PointFlags& flags, GridPart& part);

/**
 * Fills Points, ascending, Number and Offset.
 *
 * @param side of all cells of the part off the band.
 * @param nodesOf (i, nodes): the nodes of cell i of the part, in input ids; returns their number.
 */
template <typename NodesOf>
void NumberPoints(const HexMesh& mesh, const MeshBlocks& blocks, const TrimResult& result,
  NodeStatus side, GridPart& part, const NodesOf& nodesOf)
{
  const Id count = part.Cells.size();
  part.Offset.assign(NumberOfRuns(count, PartGrain) + 1, 0);
  std::vector<std::vector<Id>> inBand(NumberOfRuns(count, PartGrain)); // their nodes
  ForRuns(count,
    [&](Id run, Id begin, Id end)
    {
      std::array<Id, 8> nodes;
      Id size = 0;
      for (Id i = begin, next; i < end; i = next)
      {
        next = i + (part.IsStretch(i, end) ? GridPart::Stretch : 1);
        if (part.InBand[i] < 0)
        {
          size += mesh.NumberOfNodes(part.Cells[i], part.Cells[next - 1]);
          continue;
        }
        const int number = nodesOf(i, nodes);
        inBand[run].insert(inBand[run].end(), nodes.begin(), nodes.begin() + number);
        size += number;
      }
      part.Offset[run + 1] = size;
    });
  for (std::size_t run = 1; run < part.Offset.size(); ++run)
  {
    part.Offset[run] += part.Offset[run - 1];
  }
  PointFlags used = FlagSideOffBand(mesh, blocks, result, side);
  for (const auto& nodes : inBand)
  {
    std::for_each(nodes.begin(), nodes.end(), [&used](Id node) { used[node] = 1; });
  }
  part.Inserted = FindInsertedPoints(result);
  NumberFlagged(used, part);
}

/**
 * Writes a stretch of elements the nodes of each of which are those of the one before, plus one, if
 * their numbers are so, too: without a look at the nodes between the first ones and the last.
 *
 * @param number ascending with the nodes.
 * @param nodes of the first element.
 * @return the largest difference of numbers within one; -1: their numbers are not so.
 */
template <typename Index>
int NumberCounting(
  const int* number, const std::array<int, 8>& nodes, Id first, Index* offsets, Index* connectivity)
{
  constexpr int more = static_cast<int>(GridPart::Stretch) - 1;
  std::array<Index, 8> numbers;
  bool count = true;
  for (int k = 0; k < 8; ++k)
  {
    numbers[k] = number[nodes[k]];
    count &= number[nodes[k] + more] == numbers[k] + more;
  }
  if (!count)
  {
    return -1;
  }
  const auto range = std::minmax_element(numbers.begin(), numbers.end());
  const auto width = static_cast<int>(*range.second - *range.first);
  for (int i = 0; i <= more; ++i)
  {
    offsets[i] = static_cast<Index>(first + 8 * i);
    CopyStreamed(connectivity + 8 * i, numbers.data(), sizeof(numbers));
    for (Index& own : numbers)
    {
      ++own;
    }
  }
  return width;
}

/// Writes the nodes of one element; returns the largest difference of their numbers.
template <typename Index>
int NumberElement(const int* number, const std::array<Id, 8>& nodes, int size, Index* connectivity)
{
  int low = number[nodes[0]];
  int high = low;
  const auto take = [&](int k)
  {
    const int own = number[nodes[k]];
    connectivity[k] = static_cast<Index>(own);
    low = std::min(low, own);
    high = std::max(high, own);
  };
  if (size == 8) // most are
  {
    for (int k = 0; k < 8; ++k)
    {
      take(k);
    }
  }
  else
  {
    for (int k = 0; k < size; ++k)
    {
      take(k);
    }
  }
  return high - low;
}

/// The elements of the part with their nodes numbered; returns the largest difference of numbers
/// within one.
/// @param counting (i, end): the nodes of the first element of a stretch from i on the nodes of
/// each of which are those of the one before, plus one, where numbers ascend with nodes; else null.
/// @param number of the nodes that nodesOf tells.
template <typename Index, typename NodesOf, typename Counting>
Id NumberElements(const GridPart& part, const NodesOf& nodesOf, const Counting& counting,
  const int* number, Index* offsets, Index* connectivity)
{
  std::vector<int> widest(part.Offset.size(), 0);
  ForRuns(part.Cells.size(),
    [&](Id run, Id begin, Id end)
    {
      std::array<Id, 8> nodes;
      Id next = part.Offset[run];
      int width = 0;
      for (Id i = begin; i < end;)
      {
        const std::array<int, 8>* const first = counting(i, end);
        const int ofStretch =
          first ? NumberCounting(number, *first, next, offsets + i, connectivity + next) : -1;
        if (ofStretch >= 0)
        {
          width = std::max(width, ofStretch);
          next += 8 * GridPart::Stretch;
          i += GridPart::Stretch;
          continue;
        }
        const int size = nodesOf(i, nodes);
        offsets[i] = static_cast<Index>(next);
        width = std::max(width, NumberElement(number, nodes, size, connectivity + next));
        next += size;
        ++i;
      }
      widest[run] = width;
      FinishStreaming();
    });
  offsets[part.Cells.size()] = static_cast<Index>(part.Offset.back());
  return *std::max_element(widest.begin(), widest.end());
}

/// For NumberElements, with the numbers of NumberPoints.
inline auto CountingInMesh(const HexMesh& mesh, const MeshBlocks& blocks, const GridPart& part)
{
  return [&](Id i, Id end) -> const std::array<int, 8>*
  {
    const Id cell = part.Cells[i];
    const auto* const first =
      cell % GridPart::Stretch == 0 ? blocks.CountedFrom(cell / GridPart::Stretch) : nullptr;
    return first && !mesh.TurnsInsideOut && part.IsStretch(i, end) ? first : nullptr;
  };
}

/// Takes the new numbers of the points, by the old ones.
void TakeNumbers(const PageVector<int>& number, GridPart& part);

/// Where the points of the part are before any correction; empty if the input has them all.
std::vector<Vec3> PlacesIfInserted(const HexMesh& mesh, const GridPart& part);

/// The elements in the numbers that the points had before, and the new numbers by these.
struct Renumbering
{
  NodeGraph Graph;
  PageVector<int> Number;
};

/// Gives the points new numbers, so that the band is narrow.
template <typename NodesOf>
Renumbering RenumberPart(const HexMesh& mesh, const MeshBlocks& blocks, const Progress& progress,
  GridPart& part, const NodesOf& nodesOf)
{
  NodeGraph graph;
  graph.NumberOfNodes = static_cast<int>(part.Points.size());
  graph.Offset.resize(part.Cells.size() + 1);
  graph.Connectivity.resize(part.Offset.back());
  graph.Bandwidth =
    static_cast<int>(NumberElements(part, nodesOf, CountingInMesh(mesh, blocks, part),
      part.Number.data(), graph.Offset.data(), graph.Connectivity.data()));
  const NodePlaces places(mesh, part.Points.data(), PlacesIfInserted(mesh, part));
  PageVector<int> number = OrderNodes(graph, places, [&progress] { return progress(-1.0); });
  TakeNumbers(number, part);
  return { std::move(graph), std::move(number) };
}

/// Points, the input's attributes and the original ids.
void WritePoints(vtkUnstructuredGrid* input, const HexMesh& mesh, const GridPart& part,
  const MovedNodes& moved, vtkUnstructuredGrid* output);

/// Hands over the elements.
template <typename ArrayType>
void TakeElements(const GridPart& part, vtkSmartPointer<ArrayType> offsets,
  vtkSmartPointer<ArrayType> connectivity, vtkUnstructuredGrid* output);

/// The elements of the part; returns the largest difference of node numbers within one.
/// @param renumbered if the points were: its elements are half as long to read as the input's.
template <typename NodesOf>
Id WriteElements(const HexMesh& mesh, const MeshBlocks& blocks, const GridPart& part,
  const NodesOf& nodesOf, const std::optional<Renumbering>& renumbered, vtkUnstructuredGrid* output)
{
  const auto write = [&](auto offsets)
  {
    using ArrayType = std::remove_reference_t<decltype(*offsets)>;
    const auto connectivity = MakeArray<ArrayType>(nullptr, part.Offset.back());
    const auto number = [&](const auto& nodes, const auto& counting, const int* numbers)
    {
      return NumberElements(
        part, nodes, counting, numbers, offsets->GetPointer(0), connectivity->GetPointer(0));
    };
    const auto nodesOfGraph = [&renumbered](Id i, std::array<Id, 8>& nodes)
    { return renumbered->Graph.NodesOf(i, nodes); };
    const auto noneCounts = [](Id, Id) -> const std::array<int, 8>* { return nullptr; };
    const Id widest = renumbered
      ? number(nodesOfGraph, noneCounts, renumbered->Number.data())
      : number(nodesOf, CountingInMesh(mesh, blocks, part), part.Number.data());
    TakeElements(part, offsets, connectivity, output);
    return widest;
  };
  const Id count = part.Cells.size() + 1;
  return mesh.Offsets64 ? write(MakeArray<vtkTypeInt64Array>(nullptr, count))
                        : write(MakeArray<vtkTypeInt32Array>(nullptr, count));
}

/// What ParaView colours by at first, unless the input has active scalars of its own.
void ColourByStatus(vtkUnstructuredGrid* grid);

/// Global ids are an array like others from now on, as several points or cells of one origin have
/// the same id.
void ForgetGlobalIds(vtkDataSetAttributes* data);

/// The arrays Inserted of points and cells, and the signed distance of inserted points: that of
/// those in whose places they are.
void AddInserted(const TrimResult& result, const GridPart& part, vtkUnstructuredGrid* output);

/// The statuses and findings of the part's points and cells.
void AddStatusesAndFindings(const TrimResult& result, const GridPart& part, const MovedNodes& moved,
  vtkUnstructuredGrid* output);

}

#endif
