#include "Checks.h"

#include <Eigen/Geometry>

#include <vtkDataArray.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace judge
{
namespace
{
// A node that slides past a vertex of a polygonal border cuts it off: up to two vertices a cut
// and part.
double BorderAllowance(const Mesh& mesh)
{
  const double h = mesh.Box.ElementSize;
  return 2 * mesh.BorderTurn * h * h * 2 * mesh.Box.HalfZ;
}

// Volume of a tetrahedron where the linear function f is negative.
double NegativePart(const std::array<Vec3, 4>& p, const std::array<double, 4>& f)
{
  const double volume = std::abs((p[1] - p[0]).dot((p[2] - p[0]).cross(p[3] - p[0]))) / 6;
  std::array<int, 4> order{ { 0, 1, 2, 3 } };
  std::sort(order.begin(), order.end(), [&f](int a, int b) { return f[a] < f[b]; });
  std::array<double, 4> g;
  for (int i = 0; i < 4; ++i)
  {
    g[i] = f[order[i]];
  }
  if (g[0] >= 0)
  {
    return 0;
  }
  if (g[3] <= 0)
  {
    return volume;
  }
  const auto share = [&g](int from, int to) { return g[from] / (g[from] - g[to]); };
  if (g[1] >= 0)
  {
    return volume * share(0, 1) * share(0, 2) * share(0, 3);
  }
  if (g[2] <= 0)
  {
    return volume * (1 - share(3, 0) * share(3, 1) * share(3, 2));
  }
  // Two and two: a wedge, as three tetrahedra.
  const double a = share(0, 2), b = share(0, 3), c = share(1, 2), d = share(1, 3);
  return volume * (a * b + b * c * (1 - a) + c * d * (1 - b));
}

/// Whether nodes of the new boundary are off the surface; CheckBoundary judges whether rightly.
bool HasNodesLeft(const Evidence& e)
{
  vtkDataArray* left = e.Case.Trimmed->GetPointData()->GetArray("DistanceLeft");
  return e.Number("RescuedByLeaving") > 0 || (left && left->GetRange()[1] > 0);
}
}

void CheckPlaneVolume(const Evidence& e, const Vec3& point, const Vec3& normal, Report& report)
{
  if (HasNodesLeft(e))
  {
    return;
  }
  static const int hex[6][4] = { { 0, 1, 2, 6 }, { 0, 2, 3, 6 }, { 0, 3, 7, 6 }, { 0, 7, 4, 6 },
    { 0, 4, 5, 6 }, { 0, 5, 1, 6 } };
  static const int wedge[3][4] = { { 0, 1, 2, 5 }, { 0, 1, 5, 4 }, { 0, 4, 5, 3 } };
  double expected = 0;
  for (Id c = 0; c < static_cast<Id>(e.In.Elements.size()); ++c)
  {
    const auto corners = e.In.Corners(c);
    const int size = e.In.Elements[c].Size;
    for (int t = 0; t < (size == 8 ? 6 : 3); ++t)
    {
      std::array<Vec3, 4> p;
      std::array<double, 4> f;
      for (int i = 0; i < 4; ++i)
      {
        p[i] = corners[size == 8 ? hex[t][i] : wedge[t][i]];
        f[i] = (p[i] - point).dot(normal);
      }
      expected += NegativePart(p, f);
    }
  }
  const double given = VolumeOf(e.Out);
  const double limit = (1e-9 + 10 * e.Rounding / e.Case.Input->Box.ElementSize) * expected +
    BorderAllowance(*e.Case.Input);
  if (!(std::abs(given - expected) <= limit))
  {
    report.Fail("volume cut by a plane", "exactly " + std::to_string(expected), given, limit);
  }
}

void CheckKeptVolume(const Evidence& e, double share, Report& report)
{
  constexpr double elements = 2; // of which a few may all be corners
  double due = 0, given = 0, cut = 0;
  int count = 0;
  for (Id c = 0; c < static_cast<Id>(e.In.Elements.size()); ++c)
  {
    const double volume = std::abs(VolumeOf(e.In.Corners(c), e.In.Elements[c].Size));
    due += volume * (1 - e.Fraction[c]);
    cut += e.ElementStatus[c] == 2 ? volume : 0;
    count += e.ElementStatus[c] == 2;
  }
  for (Id c = 0; c < static_cast<Id>(e.Out.Elements.size()); ++c)
  {
    given += std::abs(VolumeOf(e.Out.Corners(c), e.Out.Elements[c].Size));
  }
  const double limit = count > 0 ? (share + elements / count) * cut : 0;
  if (count > 0 && !(std::abs(given - due) <= limit))
  {
    report.Fail("volume kept", std::to_string(due) + " is to be kept", given, limit);
  }
}

void CheckNothingKept(const Evidence& e, Report& report)
{
  const auto whole = std::count(e.ElementStatus.begin(), e.ElementStatus.end(), 0);
  if (e.Out.Elements.empty() && whole > 0)
  {
    report.Fail("nothing kept", "of the elements that lie whole on the kept side",
      static_cast<double>(whole), 0);
  }
}

namespace
{
bool IsRelaxed(const Evidence& e, Id point)
{
  constexpr double Relaxed = 4; // of CorrectionApplied
  vtkDataArray* applied = e.Case.Trimmed->GetPointData()->GetArray("CorrectionApplied");
  return applied && applied->GetComponent(point, 0) == Relaxed;
}

/// Whether some place where a part without the elements that both have hangs together by an edge or
/// a node only is at an element.
class Bridges
{
public:
  Bridges(const Evidence& part, const Evidence& other)
    : In(part.In)
  {
    Model without = part.In;
    without.Elements.clear();
    for (Id c = 0; c < static_cast<Id>(part.In.Elements.size()); ++c)
    {
      if (part.KeptCell[c] && !other.KeptCell[c])
      {
        without.Elements.push_back(part.In.Elements[c]);
      }
    }
    this->Defects = FindManifoldDefects(FacetTable(without));
  }

  bool At(Id element) const
  {
    const auto& points = this->In.Elements[element];
    return std::any_of(points.Node.begin(), points.Node.begin() + points.Size,
      [this](Id p) { return this->Defects.Points.count(p) > 0; });
  }

private:
  const Model& In;
  ManifoldDefects Defects;
};

/// Elements that both parts have must hold one of them together.
void CheckInBoth(
  const Evidence& kept, const Evidence& offcut, const std::vector<Id>& inBoth, Report& report)
{
  if (inBoth.empty())
  {
    return;
  }
  const Bridges inKept(kept, offcut), inOffcut(offcut, kept);
  for (const Id c : inBoth)
  {
    if (inKept.At(c) || inOffcut.At(c))
    {
      report.Note("elements in both parts that hold one together");
    }
    else
    {
      report.Fail("kept part or offcut", "input's " + Cell(c) + " is in that many", 2, 1);
    }
  }
}

/// Each element is in one part; where a rescue says otherwise, or its share is the limit itself, it
/// may be in both or none.
/// @return whether there is such a share.
bool CheckFates(const Evidence& kept, const Evidence& offcut, Report& report)
{
  // An element in neither part went from both for the sake of its shape: its neighbours have to
  // fill its place. In both: the parts overlap.
  std::vector<Id> inBoth;
  bool tie = false;
  for (Id c = 0; c < static_cast<Id>(kept.In.Elements.size()); ++c)
  {
    const int parts = kept.KeptCell[c] + offcut.KeptCell[c];
    if (parts == 0 && kept.Case.Options.CorrectionType != 1)
    {
      report.Note("elements in neither part");
    }
    else if (parts != 1 && (kept.Rescued() || offcut.Rescued()))
    {
      report.Note("elements that a rescue gave to both parts or to none");
    }
    else if (parts == 2 &&
      std::abs(kept.Fraction[c] - kept.Case.Options.EliminationFraction) < 1e-6)
    {
      tie = true; // "more than this share" is true of neither side
    }
    else if (parts == 2)
    {
      inBoth.push_back(c);
    }
  }
  CheckInBoth(kept, offcut, inBoth, report);
  return tie;
}

/// The volumes of both parts are that of the input, but for the corners of curved surfaces.
void CheckSum(const Evidence& kept, const Evidence& offcut, Report& report)
{
  const double parts = VolumeOf(kept.Out) + VolumeOf(offcut.Out), whole = VolumeOf(kept.In);
  // Where one part has a chord (a dropped or distributed node), the other has a corner: on a
  // plane the same, on a curved surface a triangle of area L^3 / 16 R between them.
  const Frame& box = kept.Case.Input->Box;
  const double chord = 2 * box.ElementSize;
  const double depth = box.LayerThickness > 0 ? box.LayerThickness : box.ElementSize;
  const double pentahedra = kept.Number("Pentahedra") + offcut.Number("Pentahedra");
  const double limit = (1e-9 + 10 * kept.Rounding / box.ElementSize) * whole +
    BorderAllowance(*kept.Case.Input) +
    pentahedra * depth * chord * chord * chord / (16 * kept.Case.Cut->MinimumRadius);
  if (!(std::abs(parts - whole) <= limit))
  {
    report.Fail(
      "kept part and offcut add up", "volume against " + std::to_string(whole), parts, limit);
  }
}

/// A node that both parts have is at the same place in both.
void CheckFit(const Evidence& kept, const Evidence& offcut, Report& report)
{
  std::map<Id, Id> other;
  for (Id p = 0; p < static_cast<Id>(offcut.Out.Points.size()); ++p)
  {
    other[offcut.PointOf[p]] = p;
  }
  for (Id p = 0; p < static_cast<Id>(kept.Out.Points.size()); ++p)
  {
    const auto twin = other.find(kept.PointOf[p]);
    if (twin == other.end())
    {
      continue;
    }
    const double gap = (kept.Out.Points[p] - offcut.Out.Points[twin->second]).norm();
    if (gap > kept.Exact && (IsRelaxed(kept, p) || IsRelaxed(offcut, twin->second)))
    {
      report.Note("nodes on the cut that were relaxed in one part");
    }
    else if (gap > kept.Exact)
    {
      report.Fail("parts fit node by node", "input's " + Point(kept.PointOf[p]), gap, kept.Exact);
    }
  }
}
}

void CheckPair(const Evidence& kept, const Evidence& offcut, Report& report)
{
  const bool tie = CheckFates(kept, offcut, report);
  const bool comparable = kept.Case.Input->Flat && !kept.HasOrphans() && !offcut.HasOrphans();
  if (kept.Case.Options.CorrectionType == 1 || HasNodesLeft(kept) || HasNodesLeft(offcut) ||
    !comparable)
  {
    return;
  }
  CheckSum(kept, offcut, report);
  // With distribution a node may be elsewhere in one part alone.
  const bool fits = kept.Case.Options.Optimization != 1 && kept.Case.Cut->HasPlane &&
    !kept.Rescued() && !offcut.Rescued() && !tie;
  if (fits)
  {
    CheckFit(kept, offcut, report);
  }
}

}
