#include "EliminatedFraction.h"

#include "EdgeCrossing.h"
#include "Status.h"

#include <cmath>

namespace trim
{
namespace
{

using Tetrahedron = std::array<int, 4>;

/// Six tetrahedra round the diagonal 0-6, and three in a wedge; positive in VTK's node order.
constexpr std::array<Tetrahedron, 6> HexahedronTetrahedra = { { { 0, 1, 2, 6 }, { 0, 2, 3, 6 },
  { 0, 3, 7, 6 }, { 0, 7, 4, 6 }, { 0, 4, 5, 6 }, { 0, 5, 1, 6 } } };
constexpr std::array<Tetrahedron, 3> WedgeTetrahedra = { { { 0, 1, 2, 5 }, { 0, 1, 5, 4 },
  { 0, 4, 5, 3 } } };

double Volume(const std::array<Vec3, 4>& p)
{
  return (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]) / 6.0;
}

/// For each pair of local nodes on different sides, the share of their edge, measured from the
/// first, up to the surface.
class Crossings
{
public:
  Crossings(const Band& band, int element, const std::vector<unsigned char>& status,
    const nurbs::TrimmingSurface& surface, double gap, std::array<int, 2>& missedEdge)
    : TheBand(band)
    , Element(band.Elements[element])
    , Status(status)
    , Surface(surface)
    , Gap(gap)
    , MissedEdge(missedEdge)
  {
    for (auto& row : this->Share)
    {
      row.fill(-1.0);
    }
  }

  bool IsEliminated(int i) const { return this->Status[this->Element.Node[i]] == NodeEliminate; }

  /// Share of the edge from an eliminated node to one that is not, which lies beyond.
  double Beyond(int eliminated, int other)
  {
    double& share = this->Share[eliminated][other];
    if (share >= 0.0)
    {
      return share;
    }
    const int a = this->Element.Node[eliminated];
    const int b = this->Element.Node[other];
    if (this->Status[b] == NodeOnSurface)
    {
      return share = 1.0;
    }
    const auto crossing =
      CrossEdge(this->Surface, this->TheBand.Point[a], this->TheBand.Point[b], false, this->Gap);
    if (!crossing.Found)
    {
      this->MissedEdge = { a, b };
      return share = 0.5;
    }
    return share = crossing.BeyondK;
  }

private:
  const Band& TheBand;
  const BandElement& Element;
  const std::vector<unsigned char>& Status;
  const nurbs::TrimmingSurface& Surface;
  double Gap;
  std::array<int, 2>& MissedEdge;
  std::array<std::array<double, 8>, 8> Share;
};

/// Share of a tetrahedron beyond the surface, by how many of its nodes are eliminated.
double ShareOfTetrahedron(const Tetrahedron& tetrahedron, Crossings& crossings)
{
  std::array<int, 4> beyond;
  std::array<int, 4> kept;
  int b = 0;
  int k = 0;
  for (const int node : tetrahedron)
  {
    (crossings.IsEliminated(node) ? beyond[b++] : kept[k++]) = node;
  }
  switch (b)
  {
    case 0:
      return 0.0;
    case 1:
      return crossings.Beyond(beyond[0], kept[0]) * crossings.Beyond(beyond[0], kept[1]) *
        crossings.Beyond(beyond[0], kept[2]);
    case 2:
    {
      // A prism with the two nodes as its short edges, as three tetrahedra.
      const double ac = crossings.Beyond(beyond[0], kept[0]);
      const double ad = crossings.Beyond(beyond[0], kept[1]);
      const double bc = crossings.Beyond(beyond[1], kept[0]);
      const double bd = crossings.Beyond(beyond[1], kept[1]);
      return ac * ad + ad * bc * (1.0 - ac) + bc * bd * (1.0 - ad);
    }
    case 3:
    {
      double left = 1.0;
      for (int i = 0; i < 3; ++i)
      {
        left *= 1.0 - crossings.Beyond(beyond[i], kept[0]);
      }
      return 1.0 - left;
    }
    default:
      return 1.0;
  }
}

template <std::size_t N>
ElementVolumes Measure(const std::array<Tetrahedron, N>& tetrahedra, const Band& band,
  const BandElement& element, Crossings& crossings)
{
  ElementVolumes volumes;
  for (const auto& tetrahedron : tetrahedra)
  {
    std::array<Vec3, 4> p;
    for (int i = 0; i < 4; ++i)
    {
      p[i] = band.Point[element.Node[tetrahedron[i]]];
    }
    const double volume = std::abs(Volume(p));
    volumes.Total += volume;
    volumes.Eliminated += volume * ShareOfTetrahedron(tetrahedron, crossings);
  }
  return volumes;
}

}

ElementVolumes MeasureEliminated(const Band& band, int element,
  const std::vector<unsigned char>& status, const nurbs::TrimmingSurface& surface, double gap,
  std::array<int, 2>& missedEdge)
{
  Crossings crossings(band, element, status, surface, gap, missedEdge);
  const auto& e = band.Elements[element];
  return e.Count == 8 ? Measure(HexahedronTetrahedra, band, e, crossings)
                      : Measure(WedgeTetrahedra, band, e, crossings);
}

}
