#include "PillarOrdering.h"

#include "PillarGraph.h"
#include "PointFrame.h"
#include "RowSort.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace trim
{
namespace
{

/// Orderings are applied to their own result up to this often.
constexpr int MostRounds = 2;

PageVector<Vec3> Centres(const Pillars& pillars, const NodePlaces& position)
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

/// The candidates and the best of them.
class Search
{
public:
  Search(const NodeGraph& graph, const Pillars& pillars, const NodePlaces& position,
    const std::function<bool()>& aborted)
    : Graph(graph)
    , Pillar(graph, pillars)
    , Position(position)
    , Aborted(aborted)
    , Points(Centres(pillars, position))
    , Best(pillars.Count)
  {
    std::iota(this->Best.begin(), this->Best.end(), 0);
    this->Bandwidth = this->Pillar.Bandwidth(this->Best, std::numeric_limits<int>::max());
  }

  PageVector<int> Run()
  {
    // A pseudo-peripheral pillar: the far end of the far end. Its depth gives the bound.
    const int oneEnd = this->Pillar.FindLevels(0).Last;
    const auto levels = this->Pillar.FindLevels(oneEnd);
    this->Bound = (levels.Reached - 1 + levels.Depth - 1) / std::max(1, levels.Depth);
    this->OfferSorts();
    // The ordering breaks ties by the numbers it is given, so it may gain from its own result.
    for (int round = 0; round < MostRounds && !this->Done(); ++round)
    {
      const int before = this->Bandwidth;
      this->OfferCuthillMcKee({ oneEnd, levels.Last });
      if (this->Bandwidth == before)
      {
        break;
      }
    }
    return std::move(this->Best);
  }

private:
  bool Done() const { return this->Bandwidth <= this->Bound || this->Aborted(); }

  void Offer(PageVector<int> order)
  {
    const int bandwidth = this->Pillar.Bandwidth(order, this->Bandwidth);
    if (bandwidth < this->Bandwidth)
    {
      this->Bandwidth = bandwidth;
      this->Best = std::move(order);
    }
  }

  void OfferSorts()
  {
    const auto count = static_cast<int>(this->Points.size());
    const auto centre = [this](int p) -> const Vec3& { return this->Points[p]; };
    this->Longest = ByExtent(PrincipalAxes(count, centre), count, centre);
    std::vector<Eigen::Matrix3d> tried;
    for (const Eigen::Matrix3d& frame : { Eigen::Matrix3d(Eigen::Matrix3d::Identity()),
           ElementAxes(this->Graph, this->Position), this->Longest })
    {
      const Eigen::Matrix3d axes = ByExtent(frame, count, centre);
      if (!this->Done() && std::find(tried.begin(), tried.end(), axes) == tried.end())
      {
        this->Offer(SortByRows(this->Points, axes));
        tried.push_back(axes);
      }
    }
  }

  void OfferCuthillMcKee(const PageVector<int>& ends)
  {
    const PageVector<int> rank = Inverse(this->Best);
    std::vector<PageVector<int>> roots = { this->WholeSide() };
    for (const int end : ends)
    {
      roots.push_back({ end });
    }
    for (const auto& root : roots)
    {
      if (!this->Done())
      {
        this->Offer(this->Pillar.ReverseCuthillMcKee(root, rank));
      }
    }
  }

  /// Pillars at one end of the longest axis, less than an element from it.
  PageVector<int> WholeSide() const
  {
    const Vec3 axis = this->Longest.col(0);
    double low = std::numeric_limits<double>::infinity();
    for (const Vec3& point : this->Points)
    {
      low = std::min(low, point.dot(axis));
    }
    const int* nodes = this->Graph.Connectivity.data();
    const double width = 0.5 * (this->Position(nodes[1]) - this->Position(nodes[0])).norm();
    PageVector<int> side;
    for (int p = 0; p < this->Pillar.Count(); ++p)
    {
      if (this->Points[p].dot(axis) <= low + width)
      {
        side.push_back(p);
      }
    }
    return side;
  }

  const NodeGraph& Graph;
  const PillarGraph Pillar;
  const NodePlaces& Position;
  const std::function<bool()>& Aborted;
  const PageVector<Vec3> Points; ///< the centres of the pillars
  Eigen::Matrix3d Longest;
  int Bound = 0;
  int Bandwidth = 0;
  PageVector<int> Best; ///< order
};

}

PageVector<int> OrderByPillars(
  const NodeGraph& graph, const NodePlaces& position, const std::function<bool()>& aborted)
{
  const Pillars pillars = FindPillars(graph, position);
  PageVector<int> number(graph.NumberOfNodes);
  int next = 0;
  for (const int p : Search(graph, pillars, position, aborted).Run())
  {
    for (int i = pillars.Start[p]; i < pillars.Start[p + 1]; ++i)
    {
      number[pillars.Node[i]] = next++;
    }
  }
  if (NodeBandwidth(graph, number) >= NodeBandwidth(graph))
  {
    std::iota(number.begin(), number.end(), 0);
  }
  return number;
}

}
