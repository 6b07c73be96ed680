#include "Checks.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>

namespace judge
{
namespace
{
std::string Where(const Vec3& p)
{
  char text[80];
  std::snprintf(text, sizeof(text), " (%.5g %.5g %.5g)", p[0], p[1], p[2]);
  return text;
}

// The nodes at the other ends of the mesh edges at a node of the input.
std::set<Id> NextNodes(const Evidence& e, Id node)
{
  static const int hex[12][2] = { { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 0 }, { 4, 5 }, { 5, 6 },
    { 6, 7 }, { 7, 4 }, { 0, 4 }, { 1, 5 }, { 2, 6 }, { 3, 7 } };
  static const int wedge[9][2] = { { 0, 1 }, { 1, 2 }, { 2, 0 }, { 3, 4 }, { 4, 5 }, { 5, 3 },
    { 0, 3 }, { 1, 4 }, { 2, 5 } };
  std::set<Id> next;
  for (Id c : e.CellsAt[node])
  {
    const Element& element = e.In.Elements[c];
    const int count = element.Size == 8 ? 12 : 9;
    for (int k = 0; k < count; ++k)
    {
      const Id a = element.Node[element.Size == 8 ? hex[k][0] : wedge[k][0]];
      const Id b = element.Node[element.Size == 8 ? hex[k][1] : wedge[k][1]];
      if (a == node || b == node)
      {
        next.insert(a == node ? b : a);
      }
    }
  }
  return next;
}

// Type III slides along a mesh edge at the node; on a border, and between the layers under a sharp
// bend of the skin, it may go on beyond the next node.
double DistanceToSlides(const Evidence& e, Id node, const Vec3& p)
{
  const bool beyond = e.Border.PlaceOf(node) == Exterior::Place::Inside;
  double best = std::numeric_limits<double>::infinity();
  for (const Id next : NextNodes(e, node))
  {
    best = std::min(best, DistanceToSegment(p, e.In.Points[node], e.In.Points[next]));
    for (const Id other : beyond ? NextNodes(e, next) : std::set<Id>())
    {
      best = std::min(best, DistanceToSegment(p, e.In.Points[next], e.In.Points[other]));
    }
  }
  return best;
}

// Skin: exterior facets of a sheet that do not show its thickness.
bool IsSkin(const Evidence& e, const Facet& facet)
{
  const double thickness = e.Case.Input->Box.LayerThickness;
  const int n = facet.Size();
  int thin = 0;
  for (int i = 0; i < n; ++i)
  {
    const Vec3 edge = e.In.Points[facet.Node[(i + 1) % n]] - e.In.Points[facet.Node[i]];
    thin += edge.norm() < 1.2 * thickness;
  }
  return thin < 2;
}

/// Points on those exterior facets that pass a test.
template <typename Test>
std::vector<char> ExteriorPoints(const Evidence& e, const Test& test)
{
  std::vector<char> points(e.In.Points.size(), 0);
  for (const Facet& facet : e.Border.Facets().Exterior)
  {
    for (int i = 0; test(facet) && i < facet.Size(); ++i)
    {
      points[facet.Node[i]] = 1;
    }
  }
  return points;
}

/// The same of the skin of a sheet.
template <typename Test>
std::vector<char> SkinPoints(const Evidence& e, const Test& test)
{
  return ExteriorPoints(
    e, [&](const Facet& facet) { return e.Case.Input->Sheet && test(facet) && IsSkin(e, facet); });
}

std::vector<char> SkinPoints(const Evidence& e)
{
  return SkinPoints(e, [](const Facet&) { return true; });
}

Vec3 Tuple(vtkDataArray* array, Id i)
{
  return Vec3(array->GetComponent(i, 0), array->GetComponent(i, 1), array->GetComponent(i, 2));
}

/// What is said of the move of a point of port 0 against its coordinates.
void CheckMove(const Evidence& e, Id p, const Vec3& displacement, int correction, Report& report)
{
  const Vec3 real = e.Out.Points[p] - e.In.Points[e.PointOf[p]];
  const double off = (real - displacement).norm();
  const double limit = 1e-6 * real.norm() + 1e-12 * e.Diagonal + 4 * e.Rounding;
  if (!(off <= limit))
  {
    report.Fail("Displacement", Point(p) + " against the coordinates", off, limit);
  }
  if ((real.norm() > 0) != (correction != 0) || (real.norm() == 0 && displacement.norm() != 0))
  {
    report.Fail("CorrectionApplied",
      Point(p) + " moved by " + std::to_string(real.norm()) + " says", correction,
      real.norm() > 0 ? e.Case.Options.CorrectionType : 0);
  }
  if (e.Case.Options.CorrectionType == 1 && real.norm() > 0)
  {
    report.Fail("type I moves nothing", Point(p), real.norm(), 0);
  }
}

/// Points of type III are on mesh edges, unless distribution moved them off by intent, or a layer,
/// whose edges they may slide along.
void CheckSlide(const Evidence& e, Id p, const std::vector<char>& skin, Report& report)
{
  const Id o = e.PointOf[p];
  const auto place = e.Border.PlaceOf(o);
  const bool inner =
    place == Exterior::Place::Inside || (place == Exterior::Place::Face && skin[o]);
  if (e.Case.Options.InsertLayer || e.Case.Options.Optimization != 0 || !inner)
  {
    return;
  }
  const double away = DistanceToSlides(e, o, e.Out.Points[p]);
  if (away > e.Exact)
  {
    report.Fail("type III stays on a mesh edge",
      Point(p) + " of the input's " + std::to_string(o) + Where(e.In.Points[o]) + " now" +
        Where(e.Out.Points[p]),
      away, e.Exact);
  }
}

void CheckWholePoints(const Evidence& e, Report& report)
{
  for (Id o = 0; o < static_cast<Id>(e.In.Points.size()); ++o)
  {
    const Vec3 given(e.Case.Whole->GetPoint(o));
    if (given != e.In.Points[o])
    {
      report.Fail(
        "port 1 has the input's coordinates", Point(o), (given - e.In.Points[o]).norm(), 0);
    }
  }
}
}

void CheckMoves(const Evidence& e, Report& report)
{
  vtkDataArray* displacement = e.Case.Trimmed->GetPointData()->GetArray("Displacement");
  vtkDataArray* whole = e.Case.Whole->GetPointData()->GetArray("Displacement");
  vtkDataArray* applied = e.Case.Trimmed->GetPointData()->GetArray("CorrectionApplied");
  vtkDataArray* status = e.Case.Trimmed->GetPointData()->GetArray("NodeStatus");
  if (!displacement || !whole || !applied || !status ||
    displacement->GetNumberOfComponents() != 3 || whole->GetNumberOfComponents() != 3)
  {
    return; // reported by CheckArrays
  }
  const std::vector<char> skin = SkinPoints(e);
  for (Id p = 0; p < static_cast<Id>(e.Out.Points.size()); ++p)
  {
    const Id o = e.PointOf[p];
    const Vec3 given = Tuple(displacement, p);
    const int correction = static_cast<int>(applied->GetComponent(p, 0));
    CheckMove(e, p, given, correction, report);
    if (correction == 3)
    {
      CheckSlide(e, p, skin, report);
    }
    if (!e.InsertedPoint[p] && (Tuple(whole, o) - given).norm() > 0)
    {
      report.Fail("Displacement", Point(p) + " differs between the ports",
        (Tuple(whole, o) - given).norm(), 0);
    }
    if (status->GetComponent(p, 0) != e.NodeStatus[o])
    {
      report.Fail("NodeStatus", Point(p) + " differs between the ports", status->GetComponent(p, 0),
        e.NodeStatus[o]);
    }
  }
  CheckWholePoints(e, report);
}

namespace
{
/// Points of the input where facets of kept elements meet in a ridge.
std::vector<char> RidgesOfKept(const Evidence& e)
{
  const double cosine = std::cos(Exterior::SureAngle * std::acos(-1.0) / 180);
  std::vector<char> ridge(e.In.Points.size(), 0);
  std::vector<std::vector<Vec3>> normals(e.In.Points.size());
  for (const Facet& facet : e.Border.Facets().Exterior)
  {
    const auto at = [&](int i) { return e.In.Points[facet.Node[i]]; };
    const Vec3 normal = (at(1) - at(0)).cross(at(2) - at(0)).normalized();
    for (int i = 0; e.KeptCell[facet.Owner] && i < facet.Size(); ++i)
    {
      auto& others = normals[facet.Node[i]];
      ridge[facet.Node[i]] |= std::any_of(others.begin(), others.end(),
        [&](const Vec3& other) { return other.dot(normal) < cosine; });
      others.push_back(normal);
    }
  }
  return ridge;
}

void CheckPlaces(const Evidence& e, Report& report)
{
  const auto stays = [&](const Facet& facet)
  {
    const auto end = facet.Node.begin() + facet.Size();
    return e.KeptCell[facet.Owner] &&
      std::any_of(facet.Node.begin(), end, [&](Id node) { return e.NodeStatus[node] != 1; });
  };
  const std::vector<char> skin = SkinPoints(e, stays);
  // A layer divides the facets of the skin, which changes the shape of twisted ones.
  const double exact = e.Case.Options.InsertLayer ? std::max(e.Exact, 1e-4 * e.Diagonal) : e.Exact;
  const std::vector<char> ridges = RidgesOfKept(e);
  const std::vector<char> ofKept =
    ExteriorPoints(e, [&e](const Facet& facet) { return e.KeptCell[facet.Owner] != 0; });
  for (Id p = 0; p < static_cast<Id>(e.Out.Points.size()); ++p)
  {
    const Id o = e.PointOf[p];
    const auto place = e.Border.PlaceOf(o);
    if (!e.Moved(p) || place == Exterior::Place::Inside)
    {
      continue;
    }
    // Under a layer what is kept may touch the skin at a point that it has no facet of the skin at.
    if (e.InsertedPoint[p] && !ofKept[o])
    {
      continue;
    }
    const Vec3& x = e.Out.Points[p];
    // A node on the eliminated side has to leave a lateral border that the surface runs along,
    // but never a skin that stays there: where a sheet is treated as a block a facet of it may
    // go whole.
    const bool free = e.NodeStatus[o] == 1;
    // On the very face, not on another side of the sheet.
    const double away =
      e.Border.Distance(x, place == Exterior::Place::Face ? e.Border.PatchOf(o) : -1);
    if ((!free || skin[o]) && away > exact)
    {
      report.Fail("stays on the exterior",
        Point(p) + " of the input's " + std::to_string(o) + Where(e.In.Points[o]) + " now" +
          Where(x),
        away, exact);
    }
    // What stands on one side of an inner edge ends on that side.
    const bool onRidge = e.InsertedPoint[p] ? ridges[o] != 0 : place == Exterior::Place::Ridge;
    if (!free && onRidge && e.Border.RidgeDistance(x) > exact)
    {
      report.Fail("stays on the ridge", Point(p), e.Border.RidgeDistance(x), exact);
    }
    if (!free && place == Exterior::Place::Corner && !e.InsertedPoint[p])
    {
      report.Fail("corner stays",
        Point(p) + " of the input's " + std::to_string(o) + Where(e.In.Points[o]) + " now" +
          Where(x),
        (x - e.In.Points[o]).norm(), 0);
    }
  }
}

/// Points of port 0 of which all elements hold a cut-out that is not opened, as the filter says.
std::vector<char> InShutHoles(const Evidence& e)
{
  constexpr double NotOpened = 5;
  vtkDataArray* feasibility = e.Case.Trimmed->GetCellData()->GetArray("Feasibility");
  std::vector<char> inside(e.Out.Points.size(), feasibility != nullptr);
  for (Id c = 0; c < static_cast<Id>(e.Out.Elements.size()); ++c)
  {
    const Element& element = e.Out.Elements[c];
    for (int i = 0; i < element.Size && feasibility; ++i)
    {
      inside[element.Node[i]] &= feasibility->GetComponent(c, 0) == NotOpened;
    }
  }
  return inside;
}

/// No node sticks out of the mesh's box to be seen: out of a block, or of a flat sheet by its skin.
void CheckBox(const Evidence& e, Report& report)
{
  const Frame& frame = e.Case.Input->Box;
  const auto turned = [&frame](const Vec3& p) -> Vec3
  { return frame.Axes.transpose() * (p - frame.Centre); };
  Eigen::AlignedBox3d box;
  for (const Vec3& p : e.In.Points)
  {
    box.extend(turned(p));
  }
  const double unseen = 0.02 * frame.ElementSize + e.Exact;
  for (Id p = 0; p < static_cast<Id>(e.Out.Points.size()); ++p)
  {
    const double outside = box.exteriorDistance(turned(e.Out.Points[p]));
    if (outside > unseen)
    {
      report.Fail("in the mesh's box", Point(p) + Where(e.Out.Points[p]), outside, unseen);
    }
  }
}

/// How far points that should be on the surface are off it, against what is said of it.
void CheckDistances(const Evidence& e, Report& report)
{
  const std::vector<char> skin = SkinPoints(e);
  const std::vector<char> shut = InShutHoles(e);
  vtkDataArray* distanceLeft = e.Case.Trimmed->GetPointData()->GetArray("DistanceLeft");
  for (Id p = 0; p < static_cast<Id>(e.Out.Points.size()); ++p)
  {
    const bool beyond = e.NodeStatus[e.PointOf[p]] == 1 && !e.InsertedPoint[p];
    if (!e.OnNewBoundary[p] && !beyond)
    {
      continue;
    }
    const double signedDistance = e.Signed(e.Out.Points[p]);
    const double d = std::abs(signedDistance);
    const auto place = e.Border.PlaceOf(e.PointOf[p]);
    const bool corner =
      place == Exterior::Place::Corner || (place == Exterior::Place::Ridge && !skin[e.PointOf[p]]);
    const double left = distanceLeft ? distanceLeft->GetComponent(p, 0) : 0;
    if (!e.OnNewBoundary[p] && left == 0 && signedDistance < -e.Exact && e.Moved(p))
    {
      continue; // behind the cut: it came to lie inside
    }
    if (!e.OnNewBoundary[p] && left == 0 && shut[p])
    {
      continue; // there is no border
    }
    // Where it was, a node may be as far from the surface as the tolerance says.
    const bool stayed = e.NodeStatus[e.PointOf[p]] == 2 && !e.Moved(p);
    const double exact =
      stayed ? std::max(e.Exact, e.Case.Options.Tolerance * e.Diagonal) : e.Exact;
    if (!(std::abs(left - (d <= exact ? 0 : d)) <= 1e-6 * d + e.Exact))
    {
      report.Fail("DistanceLeft", Point(p), left, d);
    }
    if (!(d <= exact) && left > 0)
    {
      // Corners of the model must stay, even where the surface passes beside them.
      report.Note(corner && !e.Moved(p) ? "corners of the model beside the surface" : NodesLeftOff);
    }
    else if (!(d <= exact))
    {
      report.Fail("new boundary on the surface",
        Point(p) + (beyond ? " (eliminate)" : " (keep)") + (e.Moved(p) ? " moved" : " not moved") +
          (e.OnNewBoundary[p] ? "" : ", not on the new boundary"),
        d, exact);
    }
  }
}

/// The result is a closed manifold if the input is.
void CheckManifold(const Evidence& e, Report& report)
{
  const FacetTable table(e.Out);
  const int came = e.Border.Facets().OverUsed;
  if (table.OverUsed > came)
  {
    report.Fail("manifold", "facets shared by more than two elements", table.OverUsed, came);
  }
  const ManifoldDefects before = FindManifoldDefects(e.Border.Facets());
  const ManifoldDefects after = FindManifoldDefects(table);
  if (before.Edges == 0 && after.Edges > 0)
  {
    report.Fail("manifold", "boundary edges at " + Point(after.EdgePoint), after.Edges, 0);
  }
  if (before.Edges + before.Vertices == 0 && after.Vertices > 0)
  {
    report.Fail("manifold", "boundary vertices at " + Point(after.VertexPoint), after.Vertices, 0);
  }
}
}

void CheckBoundary(const Evidence& e, Report& report)
{
  CheckBox(e, report);
  if (e.Case.Options.CorrectionType != 1)
  {
    CheckDistances(e, report);
    CheckPlaces(e, report);
  }
  CheckManifold(e, report);
}

void CheckNewBoundary(const Evidence& e, Report& report)
{
  vtkDataArray* boundary = e.Case.Trimmed->GetPointData()->GetArray("NewBoundary");
  for (Id p = 0; p < static_cast<Id>(e.Out.Points.size()); ++p)
  {
    const double value = boundary ? boundary->GetComponent(p, 0) : -1.0;
    if (value != e.OnNewBoundary[p])
    {
      report.Fail("NewBoundary", Point(p), value, e.OnNewBoundary[p]);
    }
  }
}

}
