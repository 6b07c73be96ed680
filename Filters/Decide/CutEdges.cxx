#include "CutEdges.h"

#include "EdgeCrossing.h"
#include "Status.h"

#include <vtkSMPTools.h>

#include <algorithm>

namespace trim
{
namespace
{

constexpr double Missed = -1.0;

/// Calls take(i, j) for each edge of the tetrahedra, once or several times.
template <std::size_t N, typename Take>
void ForEdges(const std::array<Tetrahedron, N>& tetrahedra, const Take& take)
{
  for (const auto& tetrahedron : tetrahedra)
  {
    for (int i = 1; i < 4; ++i)
    {
      for (int j = 0; j < i; ++j)
      {
        take(tetrahedron[i], tetrahedron[j]);
      }
    }
  }
}

template <typename Take>
void ForEdgesOf(int count, const Take& take)
{
  count == 8 ? ForEdges(HexahedronTetrahedra, take) : ForEdges(WedgeTetrahedra, take);
}

}

CutEdges::CutEdges(const Band& band, const nurbs::TrimmingSurface& surface, double gap)
  : Status(band.NodeStatus)
{
  this->ListEdges(band);
  this->Cross(band, surface, gap);
}

void CutEdges::ListEdges(const Band& band)
{
  const auto add = [&](int a, int b)
  {
    if (this->Status[a] == NodeEliminate && this->Status[b] != NodeEliminate &&
      this->Status[b] != NodeOnSurface)
    {
      this->Edges.push_back({ a, b });
    }
  };
  for (const auto& element : band.Elements)
  {
    const auto eliminated = [&](int node) { return this->Status[node] == NodeEliminate; };
    const auto* last = element.Node.begin() + element.Count;
    const auto beyond = std::count_if(element.Node.begin(), last, eliminated);
    if (beyond > 0 && beyond < element.Count)
    {
      ForEdgesOf(element.Count,
        [&](int i, int j)
        {
          add(element.Node[i], element.Node[j]);
          add(element.Node[j], element.Node[i]);
        });
    }
  }
  std::sort(this->Edges.begin(), this->Edges.end());
  this->Edges.erase(std::unique(this->Edges.begin(), this->Edges.end()), this->Edges.end());
}

void CutEdges::Cross(const Band& band, const nurbs::TrimmingSurface& surface, double gap)
{
  this->Shares.resize(this->Edges.size());
  vtkSMPTools::For(0, static_cast<Id>(this->Edges.size()), 256,
    [&](Id begin, Id end)
    {
      for (Id i = begin; i < end; ++i)
      {
        const auto [eliminated, kept] = this->Edges[i];
        this->Shares[i] =
          CrossEdge(surface, band.Point[eliminated], band.Point[kept], gap).value_or(Missed);
      }
    });
}

double CutEdges::Beyond(int eliminated, int other) const
{
  if (this->Status[other] == NodeOnSurface)
  {
    return 1.0;
  }
  const std::array<int, 2> edge{ eliminated, other };
  return this
    ->Shares[std::lower_bound(this->Edges.begin(), this->Edges.end(), edge) - this->Edges.begin()];
}

std::array<int, 2> CutEdges::FindMissed() const
{
  const auto missed = std::find(this->Shares.begin(), this->Shares.end(), Missed);
  return missed == this->Shares.end() ? std::array<int, 2>{ -1, -1 }
                                      : this->Edges[missed - this->Shares.begin()];
}

}
