#include "PillarOrdering.h"

#include "PillarGraph.h"
#include "PointFrame.h"
#include "RowSort.h"

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

PageVector<Vec3> CentresOf(const Pillars& pillars, const NodePlaces& position)
{
  PageVector<Vec3> centres(pillars.Count);
  vtkSMPTools::For(0, pillars.Count, 10000,
    [&](Id begin, Id end)
    {
      for (Id p = begin; p < end; ++p)
      {
        Vec3 sum = Vec3::Zero();
        for (int i = pillars.Start[p]; i < pillars.Start[p + 1]; ++i)
        {
          sum += position(pillars.Node[i]);
        }
        centres[p] = sum / (pillars.Start[p + 1] - pillars.Start[p]);
      }
    });
  return centres;
}

PageVector<int> Inverse(const PageVector<int>& order)
{
  PageVector<int> rank(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    rank[order[i]] = static_cast<int>(i);
  }
  return rank;
}

/// Frames whose axes, the longest of the part first, the pillars may be sorted along.
struct Frames
{
  std::vector<Eigen::Matrix3d> All; ///< each once
  Vec3 Longest;                     ///< principal axis

  Frames(const NodeGraph& graph, const NodePlaces& position, const PageVector<Vec3>& points)
  {
    const auto count = static_cast<int>(points.size());
    const auto point = [&points](int p) -> const Vec3& { return points[p]; };
    const Eigen::Matrix3d principal = ByExtent(PrincipalAxes(count, point), count, point);
    this->Longest = principal.col(0);
    for (const Eigen::Matrix3d& frame :
      { Eigen::Matrix3d(Eigen::Matrix3d::Identity()), ElementAxes(graph, position), principal })
    {
      const Eigen::Matrix3d axes = ByExtent(frame, count, point);
      if (std::find(this->All.begin(), this->All.end(), axes) == this->All.end())
      {
        this->All.push_back(axes);
      }
    }
  }
};

/// Where the pillars are.
struct PillarPlaces
{
  PageVector<Vec3> Centres;
  Frames Axes;
  double HalfElement; ///< of the first edge of the first element

  PillarPlaces(const NodeGraph& graph, const Pillars& pillars, const NodePlaces& position)
    : Centres(CentresOf(pillars, position))
    , Axes(graph, position, this->Centres)
    , HalfElement(0.5 * (position(graph.Connectivity[1]) - position(graph.Connectivity[0])).norm())
  {
  }

  /// Pillars at one end of the longest axis, less than half an element from it.
  PageVector<int> WholeSide() const
  {
    const Vec3& axis = this->Axes.Longest;
    double low = std::numeric_limits<double>::infinity();
    for (const Vec3& centre : this->Centres)
    {
      low = std::min(low, centre.dot(axis));
    }
    PageVector<int> side;
    for (std::size_t p = 0; p < this->Centres.size(); ++p)
    {
      if (this->Centres[p].dot(axis) <= low + this->HalfElement)
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
  Search(const PillarGraph& graph, const PillarPlaces& places, const std::function<bool()>& aborted)
    : Graph(graph)
    , Places(places)
    , Aborted(aborted)
    , Best(graph.Count())
  {
    std::iota(this->Best.begin(), this->Best.end(), 0);
    this->Bandwidth = this->Graph.Bandwidth(this->Best, std::numeric_limits<int>::max());
  }

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
      candidates.emplace_back([&] { return SortByRows(this->Places.Centres, axes); });
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

private:
  using Candidate = std::function<PageVector<int>()>;

  bool Done() const { return this->Bandwidth <= this->Bound || this->Aborted(); }

  void OfferCuthillMcKee(const std::vector<PageVector<int>>& roots)
  {
    const PageVector<int> rank = Inverse(this->Best);
    std::vector<Candidate> candidates;
    for (const auto& root : roots)
    {
      candidates.emplace_back([&] { return this->Graph.ReverseCuthillMcKee(root, rank); });
    }
    this->OfferEach(candidates);
  }

  /// Offers one after the other, as long as there is something to gain. With threads all are made
  /// at once, though the first may do.
  void OfferEach(const std::vector<Candidate>& candidates)
  {
    const auto count = static_cast<Id>(candidates.size());
    std::vector<PageVector<int>> orders(count);
    const auto make = [&](Id begin, Id end)
    {
      for (Id i = begin; i < end; ++i)
      {
        orders[i] = candidates[i]();
      }
    };
    const bool atOnce = vtkSMPTools::GetEstimatedNumberOfThreads() > 1;
    if (atOnce)
    {
      vtkSMPTools::For(0, count, 1, make);
    }
    for (Id i = 0; i < count && !this->Done(); ++i)
    {
      if (!atOnce)
      {
        make(i, i + 1);
      }
      this->Offer(std::move(orders[i]));
    }
  }

  /// @param order may be empty: none.
  void Offer(PageVector<int> order)
  {
    if (order.empty())
    {
      return;
    }
    const int bandwidth = this->Graph.Bandwidth(order, this->Bandwidth);
    if (bandwidth < this->Bandwidth)
    {
      this->Bandwidth = bandwidth;
      this->Best = std::move(order);
    }
  }

  const PillarGraph& Graph;
  const PillarPlaces& Places;
  const std::function<bool()>& Aborted;
  int Bound = 0;
  int Bandwidth = 0;
  PageVector<int> Best; ///< order
};

}

PageVector<int> OrderByPillars(const NodeGraph& graph, const Pillars& pillars,
  const NodePlaces& position, const std::function<bool()>& aborted)
{
  PillarColumns columns;
  std::optional<PillarPlaces> places;
  vtkSMPTools::For(0, 2, 1,
    [&](Id begin, Id end)
    {
      for (Id i = begin; i < end; ++i)
      {
        i == 0 ? void(columns = FindPillarColumns(graph, pillars))
               : void(places.emplace(graph, pillars, position));
      }
    });
  const PillarGraph pillarGraph(std::exchange(columns, {}), pillars);
  PageVector<int> number(graph.NumberOfNodes);
  int next = 0;
  for (const int p : Search(pillarGraph, *places, aborted).Run())
  {
    for (int i = pillars.Start[p]; i < pillars.Start[p + 1]; ++i)
    {
      number[pillars.Node[i]] = next++;
    }
  }
  if (NodeBandwidth(graph, number) >= graph.Bandwidth)
  {
    std::iota(number.begin(), number.end(), 0);
  }
  return number;
}

}
