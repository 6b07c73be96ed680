#include "BandPlace.h"

#include "ElementMap.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <numeric>

namespace trim
{
namespace
{

/// No node moves so far that a walk would need more elements.
constexpr int LongestWalk = 24;
/// How far outside of a facet, in parameters, still counts as inside.
constexpr double InsideSlack = 1e-9;
/// What is farther outside can be seen.
constexpr double SeenOutside = 0.01;

/// How far a point lies outside of each facet, by the facets' planes, in units of an element's
/// width: where the point is too far away from a distorted element to have parameters in it.
std::array<double, 6> OutsideOfPlanes(const ElementPoints& points, int count, const Vec3& point)
{
  const auto& topology = TopologyOf(count);
  const Vec3 centre =
    std::accumulate(points.begin(), points.begin() + count, Vec3(0, 0, 0)) / count;
  std::array<double, 6> outside;
  outside.fill(-1.0);
  for (int slot = 0; slot < topology.NumberOfFaces; ++slot)
  {
    const auto& face = topology.Faces[slot];
    const auto corner = [&](int i) -> const Vec3& { return points[face.Node[i]]; };
    Vec3 middle = Vec3::Zero();
    for (int i = 0; i < face.Count; ++i)
    {
      middle += corner(i) / face.Count;
    }
    const Vec3 normal = (corner(2) - corner(0)).cross(corner(face.Count - 1) - corner(1));
    const double width = 2.0 * normal.dot(middle - centre);
    outside[slot] = width > 0.0 ? normal.dot(point - middle) / width : -1.0;
  }
  return outside;
}

/// Whether a point is to be seen outside of a facet behind which there is more of the mesh than the
/// band has.
bool EndsBand(const Band& band, int element, const std::array<double, 6>& outside)
{
  bool ends = false;
  for (int slot = 0; slot < TopologyOf(band.Elements[element].Count).NumberOfFaces; ++slot)
  {
    ends |= outside[slot] > SeenOutside && band.Neighbour(element, slot) < 0 &&
      !band.Faces[band.Elements[element].Face[slot]].Exterior;
  }
  return ends;
}

}

BandPlace FindBandPlace(const Band& band, int start, const Vec3& point)
{
  BandPlace nearest;
  std::array<int, LongestWalk> passed;
  int steps = 0;
  bool known = true;
  for (int e = start; e >= 0 && steps < LongestWalk;)
  {
    passed[steps++] = e;
    const int count = band.Elements[e].Count;
    const ElementPoints points = PointsOf(band, e);
    Vec3 parameters;
    const bool found = FindParameters(points, count, point, parameters);
    const auto outside = found ? Outside(count, parameters) : OutsideOfPlanes(points, count, point);
    const double farthest = *std::max_element(outside.begin(), outside.end());
    if (found && farthest < nearest.Outside)
    {
      nearest = { e, ClampToElement(count, parameters), farthest <= InsideSlack };
      nearest.Outside = farthest;
    }
    known = known && !EndsBand(band, e, outside);
    // On through the facet that it lies farthest outside of, and that leads somewhere.
    double most = InsideSlack;
    int next = -1;
    for (int slot = 0; slot < TopologyOf(count).NumberOfFaces; ++slot)
    {
      const int other = outside[slot] > most ? band.Neighbour(e, slot) : -1;
      if (other >= 0 &&
        std::find(passed.begin(), passed.begin() + steps, other) == passed.begin() + steps)
      {
        most = outside[slot];
        next = other;
      }
    }
    e = next;
  }
  nearest.Beyond =
    known && steps < LongestWalk && nearest.Element >= 0 && nearest.Outside > SeenOutside;
  return nearest;
}

bool LiesOutside(const Band& band, int node, const Vec3& point)
{
  const Band& mesh = WithoutLayer(band);
  const auto elements = mesh.ElementsOfNode(NodeWithoutLayer(band, node));
  // From each of them: where the border bends inwards a walk may end beside the point.
  return std::all_of(
    elements.begin(), elements.end(), [&](int e) { return FindBandPlace(mesh, e, point).Beyond; });
}

}
