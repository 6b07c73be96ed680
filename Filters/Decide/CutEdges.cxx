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

CutEdges::CutEdges(const Band& band, const std::vector<unsigned char>& status,
  const nurbs::TrimmingSurface& surface, double gap)
  : Status(status)
{
  this->ListEdges(band);
  this->Cross(band, surface, gap);
}

void CutEdges::ListEdges(const Band& band)
{
  std::vector<std::array<int, 2>> edges;
  const auto add = [&](int a, int b)
  {
    if (this->Status[a] == NodeEliminate && this->Status[b] != NodeEliminate &&
      this->Status[b] != NodeOnSurface)
    {
      edges.push_back({ a, b });
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
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  this->Others = BuildLists(band.NumberOfNodes(),
    [&edges](auto&& addTo)
    {
      for (const auto& edge : edges)
      {
        addTo(edge[0], edge[1]);
      }
    });
}

void CutEdges::Cross(const Band& band, const nurbs::TrimmingSurface& surface, double gap)
{
  this->Shares.resize(this->Others.Item.size());
  vtkSMPTools::For(0, band.NumberOfNodes(), 256,
    [&](Id begin, Id end)
    {
      for (int a = static_cast<int>(begin); a < end; ++a)
      {
        for (int at = this->Others.Offset[a]; at < this->Others.Offset[a + 1]; ++at)
        {
          const int b = this->Others.Item[at];
          const auto crossing = CrossEdge(surface, band.Point[a], band.Point[b], false, gap);
          this->Shares[at] = crossing.Found ? crossing.BeyondK : Missed;
        }
      }
    });
}

double CutEdges::Beyond(int eliminated, int other) const
{
  if (this->Status[other] == NodeOnSurface)
  {
    return 1.0;
  }
  const int* first = this->Others.begin(eliminated);
  const int* at = std::find(first, this->Others.end(eliminated), other);
  return this->Shares[at - this->Others.Item.data()];
}

std::array<int, 2> CutEdges::FindMissed() const
{
  for (int a = 0; a + 1 < static_cast<int>(this->Others.Offset.size()); ++a)
  {
    for (int at = this->Others.Offset[a]; at < this->Others.Offset[a + 1]; ++at)
    {
      if (this->Shares[at] < 0.0)
      {
        return { a, this->Others.Item[at] };
      }
    }
  }
  return { -1, -1 };
}

}
