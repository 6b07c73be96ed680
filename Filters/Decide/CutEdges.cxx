#include "CutEdges.h"

#include "AddUnique.h"
#include "EdgeCrossing.h"
#include "Runs.h"
#include "SortUnique.h"
#include "Status.h"

#include <vtkSMPTools.h>

#include <algorithm>

namespace trim
{
namespace
{

constexpr double Missed = -1.0;

/// The edges of the tetrahedra, each once and both ways.
template <std::size_t N>
std::vector<std::array<int, 2>> EdgesOf(const std::array<Tetrahedron, N>& tetrahedra)
{
  std::vector<std::array<int, 2>> edges;
  for (const auto& tetrahedron : tetrahedra)
  {
    for (int i = 0; i < 12; ++i)
    {
      AddUnique(edges, { tetrahedron[i / 3], tetrahedron[(i / 3 + i % 3 + 1) % 4] });
    }
  }
  return edges;
}

}

std::array<int, 8> NodesFromFirst(const BandElement& element)
{
  const auto& node = element.Node;
  const int corners = element.Count / 2; // of one end
  const auto first =
    static_cast<int>(std::min_element(node.begin(), node.begin() + element.Count) - node.begin());
  // Seen from the other end they go round the other way.
  const bool turned = first >= corners;
  const int start = turned ? first - corners : first;
  std::array<int, 8> nodes = node;
  for (int i = 0; i < corners; ++i)
  {
    const int next = turned ? start + corners - i : start + i;
    const int corner = next < corners ? next : next - corners;
    nodes[i] = node[turned ? corner + corners : corner];
    nodes[i + corners] = node[turned ? corner : corner + corners];
  }
  return nodes;
}

CutEdges::CutEdges(const Band& band, const nurbs::TrimmingSurface& surface, double gap)
  : Status(band.NodeStatus)
{
  this->ListEdges(band);
  this->Cross(band, surface, gap);
}

void CutEdges::ListEdges(const Band& band)
{
  constexpr Id length = 1000;
  const auto ofHexahedron = EdgesOf(HexahedronTetrahedra);
  const auto ofWedge = EdgesOf(WedgeTetrahedra);
  const auto eliminated = [this](int node) { return this->Status[node] == NodeEliminate; };
  std::vector<std::vector<std::array<int, 2>>> lists(NumberOfRuns(band.NumberOfElements(), length));
  ForRuns(band.NumberOfElements(), length,
    [&](Id run, Id begin, Id end)
    {
      for (Id e = begin; e < end; ++e)
      {
        const auto& element = band.Elements[e];
        const auto beyond = std::count_if(element.begin(), element.end(), eliminated);
        if (beyond == 0 || beyond == element.Count)
        {
          continue;
        }
        const std::array<int, 8> nodes = NodesFromFirst(element);
        for (const auto& [i, j] : element.Count == 8 ? ofHexahedron : ofWedge)
        {
          const std::array<int, 2> edge{ nodes[i], nodes[j] };
          if (eliminated(edge[0]) && !eliminated(edge[1]) && this->Status[edge[1]] != NodeOnSurface)
          {
            lists[run].push_back(edge);
          }
        }
      }
      SortUnique(lists[run]);
    });
  for (const auto& list : lists)
  {
    this->Edges.insert(this->Edges.end(), list.begin(), list.end());
  }
  SortUnique(this->Edges);
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
