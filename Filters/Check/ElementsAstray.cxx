#include "ElementsAstray.h"

#include "ElementTopology.h"
#include "Jacobian.h"
#include "Status.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace trim
{
namespace
{

Vec3 CentreAt(const std::vector<Vec3>& places, const BandElement& element)
{
  const auto sum = [&places](const Vec3& before, int node) -> Vec3
  { return before + places[node]; };
  return std::accumulate(element.begin(), element.end(), Vec3(Vec3::Zero()), sum) / element.Count;
}

/// Whether an element lies on the kept side where its nodes went.
bool WentBehind(
  const TrimBand& near, const BandElement& element, const nurbs::TrimmingSurface& surface)
{
  const Vec3 centre = CentreAt(near.Trimmed.NodeMoves.Position, element);
  return surface.ClosestPoint(centre).SignedDistance < 0.0;
}

/// Size of an element along a direction of unit length: of a cube its edge, whatever the direction.
double SizeAlong(const Band& band, const BandElement& element, const Vec3& direction)
{
  const auto& topology = TopologyOf(element.Count);
  double squares = 0.0;
  for (int i = 0; i < topology.NumberOfEdges; ++i)
  {
    const auto& edge = topology.Edges[i];
    const Vec3 way = band.Point[element.Node[edge.Second]] - band.Point[element.Node[edge.First]];
    squares += std::pow(way.dot(direction), 2);
  }
  return std::sqrt(3.0 * squares / topology.NumberOfEdges);
}

}

std::array<std::vector<char>, 2> NodesByFate(const TrimBand& near)
{
  std::array<std::vector<char>, 2> has;
  has.fill(std::vector<char>(near.Mesh.NumberOfNodes(), 0));
  for (int e = 0; e < near.Mesh.NumberOfElements(); ++e)
  {
    const auto& element = near.Mesh.Elements[e];
    auto& own = has[near.Trimmed.Kept[e] ? 1 : 0];
    std::for_each(element.begin(), element.end(), [&own](int n) { own[n] = 1; });
  }
  return has;
}

double VolumeBefore(const Band& band, int e)
{
  const ElementShape shape = ShapeBefore(band, e);
  return std::abs(VolumeOf(shape.Points, shape.Count));
}

double ExcessOf(const TrimBand& near, int e, double whole)
{
  const bool inserted = near.Mesh.IsInserted(e);
  const double due = inserted ? 0.0 : whole * (1.0 - near.Shares.Element[e]);
  if (!near.Trimmed.Kept[e])
  {
    return -due;
  }
  const FinalElement shape = FinalShape(near.Mesh, near.Trimmed, e);
  // One that came inside out holds what it held before.
  const bool changed = shape.Touched || inserted;
  return (changed ? std::abs(VolumeOf(shape.Points, shape.Count)) : whole) - due;
}

ElementsAstray MeasureVolumeAstray(
  const TrimBand& near, const std::vector<double>& volumes, const std::vector<char>& without)
{
  ElementsAstray astray;
  const Band& band = near.Mesh;
  double cut = 0.0;
  double excess = 0.0;
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    if (!without.empty() && without[e])
    {
      continue;
    }
    if (band.ElementStatus[e] == ElementToTreat && !band.IsInserted(e))
    {
      cut += volumes[e];
      ++astray.Cut;
    }
    excess += ExcessOf(near, e, volumes[e]);
  }
  astray.Volume = cut > 0.0 ? std::abs(excess) / cut * static_cast<double>(astray.Cut) : 0.0;
  return astray;
}

ElementsAstray FindElementsAstray(
  const TrimBand& near, const nurbs::TrimmingSurface& surface, Correction type)
{
  const Band& band = near.Mesh;
  const auto has = NodesByFate(near);
  // By type I the border is no surface.
  ElementsAstray sum = type == Correction::Eliminate
    ? ElementsAstray()
    : MeasureVolumeAstray(near, near.Shares.Volume);
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    const unsigned char side = near.Trimmed.Kept[e] ? ElementEliminate : ElementKeep;
    if (band.ElementStatus[e] != side)
    {
      continue;
    }
    const auto& element = band.Elements[e];
    const auto& others = has[near.Trimmed.Kept[e] ? 0 : 1];
    const bool reached =
      std::any_of(element.begin(), element.end(), [&](int n) { return others[n]; }) ||
      (near.Trimmed.Kept[e] && WentBehind(near, element, surface));
    sum.Lost += reached ? 0 : 1;
    const Vec3 centre = CentreAt(band.Point, element);
    const nurbs::Foot foot = surface.ClosestPoint(centre);
    const Vec3 way = (centre - foot.Point).stableNormalized();
    const double distance = foot.Distance / SizeAlong(band, element, way);
    sum.Squares += distance > 1.0 ? distance * distance : 0.0;
  }
  return sum;
}

}
