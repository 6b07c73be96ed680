#include "ElementProbe.h"

#include "ElementChain.h"
#include "ElementTopology.h"
#include "Status.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace trim
{
namespace
{

/// How far beyond the surface there is something to hold, in elements.
constexpr double Beyond = 1e-3;

/// Mean edges of a hexahedron by axis; of a wedge the axis and two sides of its triangles.
Eigen::Matrix3d MeanEdges(const ElementProbe& probe)
{
  Eigen::Matrix3d edges = Eigen::Matrix3d::Zero();
  const auto& topology = TopologyOf(probe.Count);
  if (probe.Count == 8)
  {
    for (const auto& edge : topology.Edges)
    {
      edges.col(edge.Axis) += 0.25 * (probe.Point[edge.Second] - probe.Point[edge.First]);
    }
    return edges;
  }
  for (int i = 0; i < 3; ++i)
  {
    edges.col(0) += (probe.Point[i + 3] - probe.Point[i]) / 3.0;
  }
  for (int i = 1; i < 3; ++i)
  {
    edges.col(i) = 0.5 * (probe.Point[i] - probe.Point[0] + probe.Point[i + 3] - probe.Point[3]);
  }
  return edges;
}

void SetNodes(const HexMesh& mesh, const NodeFeet& near, ElementProbe& probe)
{
  probe.Count = mesh.OrientedCell(probe.Cell, probe.Node);
  for (int i = 0; i < probe.Count; ++i)
  {
    probe.Point[i] = mesh.Point(probe.Node[i]);
    probe.Feet[i] = &near.Feet[near.Find(probe.Node[i])];
    if (probe.Feet[i]->Kind == nurbs::FootKind::Interior &&
      (probe.Nearest < 0 || probe.Feet[i]->Distance < probe.Feet[probe.Nearest]->Distance))
    {
      probe.Nearest = i;
    }
  }
}

/// False where the surface cuts an element between two skins that lie whole on one side, as the
/// wall of a hole along a bar does: to the surface the element is one of a block.
bool MeetsSkin(const TrimResult& result, const ElementProbe& probe, int axis)
{
  const Band& band = result.Near->Mesh;
  const auto& status = result.Nodes.Status;
  const bool oneSided = std::all_of(probe.Node.begin(), probe.Node.begin() + probe.Count,
    [&](Id node) { return status[node] == status[probe.Node[0]]; });
  if (oneSided)
  {
    return true;
  }
  const Chain chain = MeasureChain(band, probe.Element, axis);
  std::array<bool, 3> met{};
  for (const int f : chain.EndFace)
  {
    const auto& face = band.Faces[f];
    std::for_each(face.begin(), face.end(), [&](int n) { met[band.NodeStatus[n]] = true; });
  }
  return met[NodeOnSurface] || met[NodeKeep] == met[NodeEliminate];
}

}

bool ElementProbe::HoldsNearestFoot() const
{
  const auto& topology = TopologyOf(this->Count);
  Vec3 centre = Vec3::Zero();
  for (int i = 0; i < this->Count; ++i)
  {
    centre += this->Point[i] / this->Count;
  }
  const nurbs::Foot& foot = *this->Feet[this->Nearest];
  const Vec3 x = foot.Point + foot.Normal * (Beyond / this->InElements(foot.Normal));
  for (int f = 0; f < topology.NumberOfFaces; ++f)
  {
    const auto& face = topology.Faces[f];
    const auto corner = [&](int i) -> const Vec3& { return this->Point[face.Node[i]]; };
    const Vec3 normal = face.Count == 4 ? (corner(2) - corner(0)).cross(corner(3) - corner(1))
                                        : (corner(1) - corner(0)).cross(corner(2) - corner(0));
    Vec3 middle = Vec3::Zero();
    for (int i = 0; i < face.Count; ++i)
    {
      middle += corner(i) / face.Count;
    }
    if (normal.dot(x - middle) * normal.dot(centre - middle) < 0.0)
    {
      return false;
    }
  }
  return true;
}

bool MakeProbe(const HexMesh& mesh, const TrimResult& result, Id cell, ElementProbe& probe)
{
  probe.Cell = cell;
  probe.Element = result.Near ? result.Near->Mesh.FindElement(cell) : -1;
  SetNodes(mesh, result.Nodes.Near, probe);
  const Eigen::Matrix3d edges = MeanEdges(probe);
  const double volume = std::abs(edges.determinant());
  const double scale = edges.col(0).norm() * edges.col(1).norm() * edges.col(2).norm();
  if (probe.Nearest < 0 || !(volume > 1e-6 * scale))
  {
    return false;
  }
  probe.ToElements = edges.inverse();
  const int axis = probe.Element < 0 ? -1 : result.Near->SheetAxis[probe.Element];
  if (axis >= 0 && MeetsSkin(result, probe, axis))
  {
    probe.Skin = edges.col((axis + 1) % 3).cross(edges.col((axis + 2) % 3)).normalized();
  }
  return true;
}

}
