#include "Pentahedra.h"

#include <algorithm>
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
/// A corner whose sides point the same way and open less than this (12 degrees) is a spike.
constexpr double SpikeSine = 0.2;

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
  const bool open = shape.Sine > WidestCornerSine || (shape.Cosine > 0.0 && shape.Sine > SpikeSine);
  return open && shape.SideRatio > ShortestSide;
}

/// In elements that are askew A may come to lie past one of its neighbours along the surface: the
/// border turns back on itself there, and the element is folded.
bool IsSpike(const CornerShape& shape)
{
  return shape.Cosine > 0.0 && shape.Sine < SpikeSine;
}

/// What the ladder has set for a pillar; in a block each node has a choice of its own.
TreatmentChoice ChoiceFor(const Band& band, const Columns& columns, const ExposedPillar& pillar,
  const std::vector<TreatmentChoice>& choices)
{
  TreatmentChoice found = TreatmentChoice::AsAsked;
  for (const auto& edge : pillar.Edges)
  {
    for (const int node : EndsOf(band, edge))
    {
      const auto choice = choices[columns.Pillar[node]];
      if (choice == TreatmentChoice::LeaveCorner)
      {
        return choice;
      }
      found = choice != TreatmentChoice::AsAsked ? choice : found;
    }
  }
  return found;
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
    const Vec3 place = AsStored(band, target.second);
    moves.Position[target.first] = place;
    // One that an earlier trim has put there stays.
    moves.Applied[target.first] =
      place != band.Point[target.first] ? Correction::Project : Correction::None;
    moves.Failed[target.first] = 0;
    moves.Left[target.first] = 0;
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

void SortByElement(std::vector<ReplacedElement>& wedges)
{
  std::sort(wedges.begin(), wedges.end(),
    [](const ReplacedElement& a, const ReplacedElement& b) { return a.Element < b.Element; });
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

const ReplacedElement* FindWedge(const Pentahedra& treated, int element)
{
  const auto& wedges = treated.Wedges;
  const auto wedge = std::lower_bound(wedges.begin(), wedges.end(), element,
    [](const ReplacedElement& w, int e) { return w.Element < e; });
  return wedge != wedges.end() && wedge->Element == element ? &*wedge : nullptr;
}

Pentahedra TreatPentahedra(const Band& band, const Columns& columns, const NodeMover& mover,
  const std::vector<ExposedPillar>& exposed, const Treatments& treatments, Moves& moves)
{
  Pentahedra result;
  result.Exposed.assign(band.NumberOfElements(), 0);
  result.FlatCorner.assign(band.NumberOfElements(), 0);
  std::vector<char> isWedge(band.NumberOfElements(), 0);
  for (const auto& pillar : exposed)
  {
    const auto& edges = pillar.Edges;
    const auto chosen = ChoiceFor(band, columns, pillar, treatments.Choice);
    for (const auto& edge : edges)
    {
      result.Exposed[columns.Column[edge.Element]] = 1;
    }
    const bool straight =
      AnyLayer(band, edges, moves, [](const CornerShape& shape) { return !IsCorner(shape); });
    const bool twice = std::any_of(edges.begin(), edges.end(),
      [&](const ExposedEdge& edge) { return isWedge[edge.Element] != 0; });
    const bool left = chosen == TreatmentChoice::LeaveCorner;
    if (twice || left || (!straight && chosen == TreatmentChoice::AsAsked))
    {
      continue;
    }
    result.Count += static_cast<int>(edges.size());
    auto treatment = Resolve(treatments.Asked, chosen);
    if (treatment == Optimization::None && AnyLayer(band, edges, moves, IsSpike))
    {
      treatment = Optimization::Degenerate;
    }
    if (treatment == Optimization::Distribute ||
      (treatment != Optimization::None && !pillar.Droppable))
    {
      const bool done = Distribute(band, mover, edges, moves);
      const bool reflex = !done ||
        AnyLayer(
          band, edges, moves, [](const CornerShape& shape) { return shape.Sine < ReflexSine; });
      treatment =
        reflex && chosen != TreatmentChoice::Distribute ? Optimization::Degenerate : treatment;
    }
    const bool drop = treatment == Optimization::Degenerate && pillar.Droppable;
    for (const auto& edge : edges)
    {
      (drop ? isWedge : result.FlatCorner)[edge.Element] = 1;
      if (drop)
      {
        result.Wedges.push_back(MakeWedge(band.Elements[edge.Element], edge));
      }
    }
  }
  SortByElement(result.Wedges);
  return result;
}

std::vector<std::vector<ReplacedElement>> FindDroppable(const Band& band, const Columns& columns,
  const std::vector<char>& kept, const Pentahedra& treated)
{
  std::vector<std::vector<ReplacedElement>> found;
  for (const auto& pillar : FindExposedPillars(band, columns, kept, true))
  {
    const bool flat = std::any_of(pillar.Edges.begin(), pillar.Edges.end(),
      [&](const ExposedEdge& edge) { return treated.FlatCorner[edge.Element] != 0; });
    if (flat || !pillar.Droppable)
    {
      continue;
    }
    found.emplace_back();
    for (const auto& edge : pillar.Edges)
    {
      found.back().push_back(MakeWedge(band.Elements[edge.Element], edge));
    }
  }
  return found;
}

bool DropEdges(const std::vector<ReplacedElement>& wedges, Pentahedra& treated)
{
  if (std::any_of(wedges.begin(), wedges.end(),
        [&treated](const ReplacedElement& wedge) { return FindWedge(treated, wedge.Element); }))
  {
    return false;
  }
  treated.Wedges.insert(treated.Wedges.end(), wedges.begin(), wedges.end());
  treated.Count += static_cast<int>(wedges.size());
  SortByElement(treated.Wedges);
  return true;
}

}
