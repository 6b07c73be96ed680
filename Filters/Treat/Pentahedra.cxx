#include "Pentahedra.h"

#include "Decision.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace trim
{
namespace
{

/// A corner that opens wider than this (150 degrees) is no corner of the surface.
constexpr double WidestCornerSine = 0.5;
/// Or one of whose sides is shorter than this share of the other.
constexpr double ShortestSide = 0.15;
/// A corner that opens beyond a straight angle by more than rounding.
constexpr double ReflexSine = -1e-7;

/// One edge A-B of one element: position k of the axis ends.
struct ExposedEdge
{
  int Element;
  int Axis;
  int Corner;
};

/// The four nodes of the element round A in its layer: A, the two along the new boundary, and
/// the one inside, such that (next - a) x (previous - a) and (previous - d) x (next - d) agree.
struct LayerCorner
{
  int A, Previous, Next, Inside;
};

LayerCorner CornerAt(const BandElement& element, const ExposedEdge& edge, int end)
{
  const auto& cycle = AxisEnds[edge.Axis][end];
  const int k = edge.Corner;
  return { element.Node[cycle[k]], element.Node[cycle[(k + 3) % 4]],
    element.Node[cycle[(k + 1) % 4]], element.Node[cycle[(k + 2) % 4]] };
}

struct CornerShape
{
  double Sine; ///< of the angle at A, negative where it opens beyond a straight angle
  double Cosine;
  double SideRatio;
};

CornerShape ShapeOf(const std::vector<Vec3>& p, const LayerCorner& c)
{
  const Vec3 previous = p[c.Previous] - p[c.A];
  const Vec3 next = p[c.Next] - p[c.A];
  Vec3 normal = (p[c.Next] - p[c.Inside]).cross(p[c.Previous] - p[c.Inside]);
  const double lengths = previous.norm() * next.norm();
  if (lengths == 0.0 || normal.norm() == 0.0)
  {
    return { 0.0, -1.0, 0.0 };
  }
  normal.normalize();
  return { previous.cross(next).dot(normal) / lengths, previous.dot(next) / lengths,
    std::min(previous.norm(), next.norm()) / std::max(previous.norm(), next.norm()) };
}

bool IsCorner(const CornerShape& shape)
{
  const bool open = shape.Sine > WidestCornerSine || (shape.Cosine > 0.0 && shape.Sine > 0.2);
  return open && shape.SideRatio > ShortestSide;
}

bool OnlyKeptAt(const Band& band, const std::vector<char>& kept, int element, int a, int b)
{
  for (const int other : band.ElementsOfNode(a))
  {
    const auto& nodes = band.Elements[other].Node;
    if (other != element && kept[other] &&
      std::find(nodes.begin(), nodes.begin() + band.Elements[other].Count, b) !=
        nodes.begin() + band.Elements[other].Count)
    {
      return false;
    }
  }
  return true;
}

/// Exposed edges by pillar; in a block each edge stands for itself.
std::map<int, std::vector<ExposedEdge>> FindExposed(
  const Band& band, const Columns& columns, const std::vector<char>& kept)
{
  std::map<int, std::vector<ExposedEdge>> exposed;
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    const auto& element = band.Elements[e];
    if (!kept[e] || element.Count != 8 || element.Ring > 2)
    {
      continue;
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      if (columns.HasThickness(e) && columns.Axis[e] != axis)
      {
        continue;
      }
      for (int k = 0; k < 4; ++k)
      {
        const int a = element.Node[AxisEnds[axis][0][k]];
        const int b = element.Node[AxisEnds[axis][1][k]];
        int cutFaces = 0;
        for (int slot = 0; slot < 6; ++slot)
        {
          const auto& face = band.Faces[element.Face[slot]];
          const auto end = face.Node.begin() + face.Count;
          cutFaces += IsCutFace(face, kept) && std::find(face.Node.begin(), end, a) != end &&
            std::find(face.Node.begin(), end, b) != end;
        }
        if (cutFaces == 2 && OnlyKeptAt(band, kept, e, a, b))
        {
          exposed[columns.Pillar[std::min(a, b)]].push_back({ e, axis, k });
        }
      }
    }
  }
  return exposed;
}

/// Puts A of each layer in the middle of its neighbours, on the surface; all layers or none.
bool Distribute(
  const Band& band, const NodeMover& mover, const std::vector<ExposedEdge>& edges, Moves& moves)
{
  std::map<int, Vec3> targets;
  for (const auto& edge : edges)
  {
    for (int end = 0; end < 2; ++end)
    {
      const auto corner = CornerAt(band.Elements[edge.Element], edge, end);
      const Vec3& p = moves.Position[corner.Previous];
      const Vec3& q = moves.Position[corner.Next];
      const NodeMove move = mover.Between(corner.A, 0.5 * (p + q), (q - p).normalized());
      if (!move.Found)
      {
        return false;
      }
      targets[corner.A] = move.Target;
    }
  }
  for (const auto& target : targets)
  {
    moves.Position[target.first] = AsStored(band, target.second);
    moves.Applied[target.first] = Correction::Project;
    moves.Failed[target.first] = 0;
  }
  return true;
}

ReplacedElement MakeWedge(const BandElement& element, const ExposedEdge& edge)
{
  ReplacedElement wedge;
  wedge.Element = edge.Element;
  wedge.Dropped = { element.Node[AxisEnds[edge.Axis][0][edge.Corner]],
    element.Node[AxisEnds[edge.Axis][1][edge.Corner]] };
  wedge.Node.fill(-1);
  for (int i = 0; i < 3; ++i)
  {
    const int k = (edge.Corner + 1 + i) % 4;
    wedge.Node[i] = element.Node[AxisEnds[edge.Axis][0][k]];
    wedge.Node[3 + i] = element.Node[AxisEnds[edge.Axis][1][k]];
  }
  return wedge;
}

template <typename Test>
bool AnyLayer(
  const Band& band, const std::vector<ExposedEdge>& edges, const Moves& moves, const Test& test)
{
  for (const auto& edge : edges)
  {
    for (int end = 0; end < 2; ++end)
    {
      if (test(ShapeOf(moves.Position, CornerAt(band.Elements[edge.Element], edge, end))))
      {
        return true;
      }
    }
  }
  return false;
}

/// True if one of the nodes must not be touched (in a block each has a choice of its own).
bool IsLeft(const Band& band, const Columns& columns, const std::vector<ExposedEdge>& edges,
  const std::vector<TreatmentChoice>& choice)
{
  return std::any_of(edges.begin(), edges.end(),
    [&](const ExposedEdge& edge)
    {
      const auto& element = band.Elements[edge.Element];
      return choice[columns.Pillar[CornerAt(element, edge, 0).A]] == TreatmentChoice::LeaveCorner ||
        choice[columns.Pillar[CornerAt(element, edge, 1).A]] == TreatmentChoice::LeaveCorner;
    });
}

Optimization Resolve(Optimization asked, TreatmentChoice choice)
{
  switch (choice)
  {
    case TreatmentChoice::Distribute:
      return Optimization::Distribute;
    case TreatmentChoice::Degenerate:
      return Optimization::Degenerate;
    default:
      return asked;
  }
}

}

Pentahedra TreatPentahedra(const Band& band, const Columns& columns, const NodeMover& mover,
  const std::vector<char>& kept, Optimization asked, const std::vector<TreatmentChoice>& choice,
  Moves& moves)
{
  Pentahedra result;
  result.Exposed.assign(band.NumberOfElements(), 0);
  result.FlatCorner.assign(band.NumberOfElements(), 0);
  std::vector<char> isWedge(band.NumberOfElements(), 0);
  for (const auto& pillar : FindExposed(band, columns, kept))
  {
    const auto& edges = pillar.second;
    for (const auto& edge : edges)
    {
      result.Exposed[columns.Column[edge.Element]] = 1;
    }
    const bool straight =
      AnyLayer(band, edges, moves, [](const CornerShape& shape) { return !IsCorner(shape); });
    const bool twice = std::any_of(edges.begin(), edges.end(),
      [&](const ExposedEdge& edge) { return isWedge[edge.Element] != 0; });
    const bool left = IsLeft(band, columns, edges, choice);
    if (twice || left || (!straight && choice[pillar.first] == TreatmentChoice::AsAsked))
    {
      continue;
    }
    result.Count += static_cast<int>(edges.size());
    auto treatment = Resolve(asked, choice[pillar.first]);
    // Only through a whole column of a sheet does dropping an edge leave a conforming mesh.
    const bool droppable = columns.HasThickness(edges.front().Element);
    if (treatment == Optimization::Distribute || (treatment != Optimization::None && !droppable))
    {
      const bool done = Distribute(band, mover, edges, moves);
      const bool reflex = !done ||
        AnyLayer(
          band, edges, moves, [](const CornerShape& shape) { return shape.Sine < ReflexSine; });
      treatment = reflex && choice[pillar.first] != TreatmentChoice::Distribute
        ? Optimization::Degenerate
        : treatment;
    }
    const bool drop = treatment == Optimization::Degenerate && droppable;
    for (const auto& edge : edges)
    {
      (drop ? isWedge : result.FlatCorner)[edge.Element] = 1;
      if (drop)
      {
        result.Wedges.push_back(MakeWedge(band.Elements[edge.Element], edge));
      }
    }
  }
  std::sort(result.Wedges.begin(), result.Wedges.end(),
    [](const ReplacedElement& a, const ReplacedElement& b) { return a.Element < b.Element; });
  return result;
}

}
