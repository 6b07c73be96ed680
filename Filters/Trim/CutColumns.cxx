#include "CutColumns.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace trim
{
namespace
{

/// A surface that shifts by more than this share of an element from skin to skin cannot be
/// followed by whole columns: other columns are looked for, else every element is decided alone.
constexpr double LargestColumnShift = 3.5;
/// Columns that the cut has chosen follow it farther: elements decided alone leave more nodes off.
constexpr double LargestChosenShift = 4.0;
/// Below, the surface is at right angles to an axis, and none of its columns can follow it.
constexpr double SmallestCosine = 1e-6;

/// The closest point to a node of the band; most are known from the classification.
nurbs::Foot FootOf(
  const Band& band, int node, const NodeFeet& known, const nurbs::TrimmingSurface& surface)
{
  const nurbs::Foot* const foot = known.FootOf(band.GlobalNode[node]);
  return foot ? *foot : surface.ClosestPoint(band.Point[node]);
}

/// Shift of the surface along an axis of an element, in elements as they are in the direction of
/// the shift; infinite across the axis.
double ShiftAlong(
  const Band& band, int e, int axis, const NodeFeet& known, const nurbs::TrimmingSurface& surface)
{
  const auto& element = band.Elements[e];
  const auto& topology = TopologyOf(element.Count);
  const auto edge = [&](int i)
  {
    const EdgeNodes& nodes = topology.Edges[i];
    return Vec3(band.Point[element.Node[nodes.Second]] - band.Point[element.Node[nodes.First]]);
  };
  Vec3 thickness = Vec3::Zero();
  int axisEdges = 0;
  for (int i = 0; i < topology.NumberOfEdges; ++i)
  {
    if (topology.Edges[i].Axis == axis)
    {
      thickness += edge(i);
      ++axisEdges;
    }
  }
  thickness /= axisEdges;
  // Not the first as the element has them: how it is numbered must not decide.
  const int node = *std::min_element(element.begin(), element.end());
  const Vec3 normal = FootOf(band, node, known, surface).Normal;
  const Vec3 along = thickness.normalized();
  const double sine = normal.dot(along);
  const Vec3 across = normal - sine * along;
  const double cosine = across.norm();
  double squares = 0.0;
  for (int i = 0; i < topology.NumberOfEdges; ++i)
  {
    squares += topology.Edges[i].Axis == axis ? 0.0 : std::pow(edge(i).dot(across), 2);
  }
  const double lateral = std::sqrt(2.0 * squares / (topology.NumberOfEdges - axisEdges)) / cosine;
  return cosine > SmallestCosine ? thickness.norm() * std::abs(sine) / (cosine * lateral)
                                 : std::numeric_limits<double>::infinity();
}

/// Mean shift of the surface from skin to skin, in elements; 0 without thickness.
double ColumnShift(const Band& band, const Columns& columns, const NodeFeet& known,
  const nurbs::TrimmingSurface& surface)
{
  double shift = 0.0;
  int count = 0;
  std::vector<int> layers(band.NumberOfElements(), 0);
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    ++layers[columns.Column[e]];
  }
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    if (band.Elements[e].Ring == 0 && columns.Axis[e] >= 0)
    {
      shift += std::min(
        10.0, layers[columns.Column[e]] * ShiftAlong(band, e, columns.Axis[e], known, surface));
      ++count;
    }
  }
  return count > 0 ? shift / count : 0.0;
}

}

void SetColumns(
  TrimBand& near, const NodeFeet& known, const nurbs::TrimmingSurface& surface, bool nodesMove)
{
  const Band& band = near.Mesh;
  if (ColumnShift(band, near.Structure, known, surface) > LargestColumnShift ||
    !near.Structure.Complete(band, 2))
  {
    near.Structure = NoColumns(band, std::move(near.Structure.Part));
  }
  if (near.Structure.AllHaveThickness() || !nodesMove)
  {
    return;
  }
  Columns chosen = near.Structure;
  const auto shift = [&](int e, int axis) { return ShiftAlong(band, e, axis, known, surface); };
  ChooseColumns(band, shift, LargestChosenShift, chosen);
  if (chosen.Complete(band, 2))
  {
    near.Structure = std::move(chosen);
  }
}

}
