#include "ElementTetrahedra.h"

#include "Status.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace trim
{
namespace
{

/// Two nodes of the band, ascending.
using Diagonal = std::pair<int, int>;

Diagonal Between(int a, int b)
{
  return { std::min(a, b), std::max(a, b) };
}

/// The edges of the tetrahedra across faces, by places in OrderForTetrahedra.
constexpr std::array<std::array<int, 2>, 6> HexahedronDiagonals = { { { 0, 2 }, { 0, 5 }, { 0, 7 },
  { 6, 1 }, { 6, 3 }, { 6, 4 } } };
constexpr std::array<std::array<int, 2>, 3> WedgeDiagonals = { { { 0, 4 }, { 0, 5 }, { 1, 5 } } };

std::array<int, 8> OrderFrom(const BandElement& element, int first)
{
  const auto& node = element.Node;
  const int corners = element.Count / 2; // of one end
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

/// Of each face whose nodes lie on the two sides by turns, the diagonal that the surface does not
/// cross.
std::vector<Diagonal> FindUncrossed(
  const Band& band, const BandElement& element, const nurbs::TrimmingSurface& surface)
{
  std::vector<Diagonal> uncrossed;
  const auto& topology = TopologyOf(element.Count);
  for (int f = 0; f < topology.NumberOfFaces; ++f)
  {
    const FaceNodes& face = topology.Faces[f];
    const auto node = [&](int i) { return element.Node[face.Node[i]]; };
    if (face.Count == 4 && LieByTurns([&](int i) { return band.NodeStatus[node(i)]; }))
    {
      const bool crossed = !surface.Intersect(band.Point[node(0)], band.Point[node(2)]).empty();
      uncrossed.push_back(crossed ? Between(node(1), node(3)) : Between(node(0), node(2)));
    }
  }
  return uncrossed;
}

/// How many of these diagonals are edges of the tetrahedra.
template <std::size_t N>
int CountDiagonals(const std::array<int, 8>& nodes, const std::array<std::array<int, 2>, N>& places,
  const std::vector<Diagonal>& diagonals)
{
  return static_cast<int>(std::count_if(places.begin(), places.end(),
    [&](const auto& place)
    {
      const Diagonal own = Between(nodes[place[0]], nodes[place[1]]);
      return std::find(diagonals.begin(), diagonals.end(), own) != diagonals.end();
    }));
}

int CountDiagonals(
  const std::array<int, 8>& nodes, int count, const std::vector<Diagonal>& diagonals)
{
  return count == 8 ? CountDiagonals(nodes, HexahedronDiagonals, diagonals)
                    : CountDiagonals(nodes, WedgeDiagonals, diagonals);
}

}

std::array<int, 8> OrderForTetrahedra(
  const Band& band, int element, const nurbs::TrimmingSurface& surface)
{
  const BandElement& own = band.Elements[element];
  const auto first = std::min_element(own.begin(), own.end());
  std::array<int, 8> best = OrderFrom(own, static_cast<int>(first - own.begin()));
  if (band.ElementStatus[element] != ElementToTreat)
  {
    return best;
  }
  const std::vector<Diagonal> uncrossed = FindUncrossed(band, own, surface);
  int most = CountDiagonals(best, own.Count, uncrossed);
  for (int i = 0; i < own.Count && !uncrossed.empty(); ++i)
  {
    const std::array<int, 8> nodes = OrderFrom(own, i);
    const int count = CountDiagonals(nodes, own.Count, uncrossed);
    if (count > most || (count == most && nodes[0] < best[0]))
    {
      most = count;
      best = nodes;
    }
  }
  return best;
}

}
