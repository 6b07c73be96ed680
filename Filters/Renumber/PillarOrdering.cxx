#include "PillarOrdering.h"

#include "PillarGraph.h"
#include "PointFrame.h"
#include "RowSort.h"
#include "Runs.h"
#include "Team.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace trim
{
namespace
{

/// Orderings are applied to their own result up to this often.
constexpr int MostRounds = 2;

/// Frames whose axes, the longest of the part first, the pillars may be sorted along.
struct Frames
{
  std::vector<Eigen::Matrix3d> All; ///< each once
  Vec3 Longest;                     ///< principal axis

  Frames(const NodeGraph& graph, const NodePlaces& position, const PageVector<Vec3>& points)
  {
    const auto count = static_cast<int>(points.size());
    const auto point = [&points](int p) -> const Vec3& { return points[p]; };
    const auto add = [this](const Eigen::Matrix3d& axes)
    {
      if (std::find(this->All.begin(), this->All.end(), axes) == this->All.end())
      {
        this->All.push_back(axes);
      }
    };
    const Eigen::Matrix3d asItLies = Eigen::Matrix3d::Identity();
    const Eigen::Matrix3d ofElement = ElementAxes(graph, position);
    add(ByExtent(asItLies, count, point));
    if (ofElement != asItLies)
    {
      add(ByExtent(ofElement, count, point));
    }
    const Eigen::Matrix3d principal = ByExtent(PrincipalAxes(count, point), count, point);
    add(principal);
    this->Longest = principal.col(0);
  }
};

/// Where the search may start or sort along.
struct PillarPlaces
{
  const PageVector<Vec3>& Centre;
  Frames Axes;
  double HalfElement; ///< of the first edge of the first element

  PillarPlaces(const NodeGraph& graph, const Pillars& pillars, const NodePlaces& position)
    : Centre(pillars.Centre)
    , Axes(graph, position, pillars.Centre)
    , HalfElement(0.5 * (position(graph.Connectivity[1]) - position(graph.Connectivity[0])).norm())
  {
  }

  /// Pillars at one end of the longest axis, less than half an element from it.
  PageVector<int> WholeSide() const
  {
    const Vec3& axis = this->Axes.Longest;
    double low = std::numeric_limits<double>::infinity();
    for (const Vec3& centre : this->Centre)
    {
      low = std::min(low, centre.dot(axis));
    }
    PageVector<int> side;
    for (std::size_t p = 0; p < this->Centre.size(); ++p)
    {
      if (this->Centre[p].dot(axis) <= low + this->HalfElement)
      {
        side.push_back(static_cast<int>(p));
      }
    }
    return side;
  }
};

/// The candidates and the best of them.
class Search
{
public:
  Search(const Pillars& pillars, const PillarGraph& graph, const PillarPlaces& places,
    const std::function<bool()>& aborted)
    : ThePillars(pillars)
    , Graph(graph)
    , Places(places)
    , Aborted(aborted)
    , Best(pillars.Start.begin(), pillars.Start.end() - 1)
  {
    this->Bandwidth = this->Graph.Bandwidth(this->Best, std::numeric_limits<int>::max());
  }

  /// The best first numbers.
  PageVector<int> Run()
  {
    // A pseudo-peripheral pillar: the far end of the far end. Its depth gives the bound.
    int oneEnd = 0;
    PillarGraph::Levels levels;
    std::vector<Candidate> candidates{ [&]
      {
        oneEnd = this->Graph.FindLevels(0).Last;
        levels = this->Graph.FindLevels(oneEnd);
        this->Bound = (levels.Reached - 1 + levels.Depth - 1) / std::max(1, levels.Depth);
        return PageVector<int>();
      } };
    for (const Eigen::Matrix3d& axes : this->Places.Axes.All)
    {
      candidates.emplace_back(
        [&] { return FirstNumbers(this->ThePillars, SortByRows(this->Places.Centre, axes)); });
    }
    this->OfferEach(candidates);
    // The ordering breaks ties by the numbers it is given, so it may gain from its own result.
    for (int round = 0; round < MostRounds && !this->Done(); ++round)
    {
      const int before = this->Bandwidth;
      this->OfferCuthillMcKee({ this->Places.WholeSide(), { oneEnd }, { levels.Last } });
      if (this->Bandwidth == before)
      {
        break;
      }
    }
    return std::move(this->Best);
  }

  /// Not less than the node bandwidth of what Run returned.
  int LargestBandwidth() const
  {
    int tallest = 0;
    for (int p = 0; p < this->ThePillars.Count; ++p)
    {
      tallest = std::max(tallest, this->ThePillars.Size(p));
    }
    return this->Bandwidth + tallest - 1;
  }

private:
  using Candidate = std::function<PageVector<int>()>;

  bool Done() const { return this->Bandwidth <= this->Bound || this->Aborted(); }

  void OfferCuthillMcKee(const std::vector<PageVector<int>>& roots)
  {
    const PageVector<int> rank = this->Best;
    std::vector<Candidate> candidates;
    for (const auto& root : roots)
    {
      candidates.emplace_back(
        [&] { return this->Graph.ReverseCuthillMcKee(root, rank, this->Bandwidth); });
    }
    this->OfferEach(candidates);
  }

  /// Offers one after the other, as long as there is something to gain. With threads all are made
  /// at once, though the first may do.
  void OfferEach(const std::vector<Candidate>& candidates)
  {
    const auto count = static_cast<Id>(candidates.size());
    std::vector<PageVector<int>> found(count);
    const auto make = [&](Id begin, Id end)
    {
      for (Id i = begin; i < end; ++i)
      {
        found[i] = candidates[i]();
      }
    };
    const bool atOnce = vtkSMPTools::GetEstimatedNumberOfThreads() > 1;
    if (atOnce)
    {
      ParallelFor(0, count, 1, make);
    }
    for (Id i = 0; i < count && !this->Done(); ++i)
    {
      if (!atOnce)
      {
        make(i, i + 1);
      }
      this->Offer(std::move(found[i]));
    }
  }

  /// @param first may be empty: none.
  void Offer(PageVector<int> first)
  {
    if (first.empty())
    {
      return;
    }
    const int bandwidth = this->Graph.Bandwidth(first, this->Bandwidth);
    if (bandwidth < this->Bandwidth)
    {
      this->Bandwidth = bandwidth;
      this->Best = std::move(first);
    }
  }

  const Pillars& ThePillars;
  const PillarGraph& Graph;
  const PillarPlaces& Places;
  const std::function<bool()>& Aborted;
  int Bound = 0;
  int Bandwidth = 0;
  PageVector<int> Best; ///< first numbers
};

}

PageVector<int> OrderByPillars(const NodeGraph& graph, const Pillars& pillars,
  const NodePlaces& position, const std::function<bool()>& aborted)
{
  std::optional<PillarGraph> pillarGraph;
  std::optional<PillarPlaces> places;
  ParallelFor(0, 2, 1,
    [&](Id begin, Id end)
    {
      for (Id i = begin; i < end; ++i)
      {
        i == 0 ? void(pillarGraph.emplace(graph, pillars))
               : void(places.emplace(graph, pillars, position));
      }
    });
  Search search(pillars, *pillarGraph, *places, aborted);
  const PageVector<int> first = search.Run();
  PageVector<int> number(graph.NumberOfNodes);
  const auto setNumbers = [&](int p)
  {
    for (int i = 0; i < pillars.Size(p); ++i)
    {
      number[pillars.Node[pillars.Start[p] + i]] = first[p] + i;
    }
  };
  ForAll(pillars.Count, setNumbers, LightGrain);
  if (search.LargestBandwidth() >= graph.Bandwidth &&
    NodeBandwidth(graph, number) >= graph.Bandwidth)
  {
    std::iota(number.begin(), number.end(), 0);
  }
  return number;
}

}
