#include "CutEdges.h"

#include "AddUnique.h"
#include "EdgeCrossing.h"
#include "Runs.h"
#include "Status.h"

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

CutEdges::CutEdges(const Band& band, const nurbs::TrimmingSurface& surface, double gap)
  : Status(band.NodeStatus)
{
  this->ListEdges(band);
  this->Cross(band, surface, gap);
}

void CutEdges::ListEdges(const Band& band)
{
  const auto ofHexahedron = EdgesOf(HexahedronTetrahedra);
  const auto ofWedge = EdgesOf(WedgeTetrahedra);
  Band::Lists keptAt = BuildLists(band.NumberOfNodes(),
    [&](auto&& add)
    {
      for (int e = 0; e < band.NumberOfElements(); ++e)
      {
        if (band.ElementStatus[e] != ElementToTreat)
        {
          continue;
        }
        const std::array<int, 8> nodes = OrderForTetrahedra(band.Elements[e]);
        for (const auto& [i, j] : band.Elements[e].Count == 8 ? ofHexahedron : ofWedge)
        {
          if (this->Status[nodes[i]] == NodeEliminate && this->Status[nodes[j]] == NodeKeep)
          {
            add(nodes[i], nodes[j]);
          }
        }
      }
    });
  this->First.reserve(band.NumberOfNodes() + 1);
  this->First.push_back(0);
  for (int n = 0; n < band.NumberOfNodes(); ++n)
  {
    const auto begin = keptAt.Item.begin() + keptAt.Offset[n];
    const auto end = keptAt.Item.begin() + keptAt.Offset[n + 1];
    std::sort(begin, end);
    std::for_each(begin, std::unique(begin, end),
      [&](int kept) {
        this->Edges.push_back({ n, kept });
      });
    this->First.push_back(static_cast<int>(this->Edges.size()));
  }
}

void CutEdges::Cross(const Band& band, const nurbs::TrimmingSurface& surface, double gap)
{
  this->Shares.resize(this->Edges.size(), Missed);
  this->Normals.resize(this->Edges.size(), Vec3::Zero());
  ForAll(static_cast<int>(this->Edges.size()),
    [&](int i)
    {
      const auto [eliminated, kept] = this->Edges[i];
      if (const auto crossed = CrossEdge(surface, band.Point[eliminated], band.Point[kept], gap))
      {
        this->Shares[i] = crossed->Beyond;
        this->Normals[i] = crossed->Normal;
      }
    });
}

std::size_t CutEdges::Find(int eliminated, int kept) const
{
  const auto begin = this->Edges.begin();
  const std::array<int, 2> edge{ eliminated, kept };
  return std::find(begin + this->First[eliminated], begin + this->First[eliminated + 1], edge) -
    begin;
}

double CutEdges::Beyond(int eliminated, int other) const
{
  return this->Status[other] == NodeOnSurface ? 1.0 : this->Shares[this->Find(eliminated, other)];
}

const Vec3& CutEdges::Normal(int eliminated, int kept) const
{
  return this->Normals[this->Find(eliminated, kept)];
}

std::array<int, 2> CutEdges::FindMissed() const
{
  const auto missed = std::find(this->Shares.begin(), this->Shares.end(), Missed);
  return missed == this->Shares.end() ? std::array<int, 2>{ -1, -1 }
                                      : this->Edges[missed - this->Shares.begin()];
}

}
