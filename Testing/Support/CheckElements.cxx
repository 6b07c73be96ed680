#include "Checks.h"

#include <Eigen/Geometry>

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkMeshQuality.h>
#include <vtkPointData.h>

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/connected_components.hpp>
#include <boost/graph/cuthill_mckee_ordering.hpp>
#include <boost/graph/properties.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace judge
{
namespace
{
std::string Cell(Id c)
{
  return "cell " + std::to_string(c);
}

double Longest(const std::array<Vec3, 8>& corners, int size)
{
  double longest = 0;
  for (int i = 1; i < size; ++i)
  {
    longest = std::max(longest, (corners[i] - corners[0]).norm());
  }
  return longest;
}

void Expect(const Evidence& e, const char* name, double expected, double limit, Report& report)
{
  const double given = e.Number(name);
  if (!(std::abs(given - expected) <= limit))
  {
    report.Fail(
      "summary", std::string(name) + ", recomputed " + std::to_string(expected), given, limit);
  }
}

/// A number for each node of a model, the same for all that elements join.
std::vector<int> PartsOf(const Model& model)
{
  boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS> graph(model.Points.size());
  for (const Element& element : model.Elements)
  {
    for (int i = 1; i < element.Size; ++i)
    {
      boost::add_edge(element.Node[0], element.Node[i], graph);
    }
  }
  std::vector<int> part(model.Points.size());
  boost::connected_components(graph, part.data());
  return part;
}

void CheckCoincidence(const Evidence& e, Report& report)
{
  // Two nodes at one place: closer than a millionth of the shortest element.
  const double tolerance = 1e-9 * e.Diagonal;
  std::vector<Id> order(e.Out.Points.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    order[i] = static_cast<Id>(i);
  }
  std::sort(order.begin(), order.end(),
    [&](Id a, Id b) { return e.Out.Points[a][0] < e.Out.Points[b][0]; });
  // The input may have slits or touching parts: there it is no fault.
  const std::vector<int> part = PartsOf(e.In);
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    for (std::size_t j = i + 1;
         j < order.size() && e.Out.Points[order[j]][0] - e.Out.Points[order[i]][0] <= tolerance;
         ++j)
    {
      const double d = (e.Out.Points[order[j]] - e.Out.Points[order[i]]).norm();
      const bool before =
        (e.In.Points[e.PointOf[order[j]]] - e.In.Points[e.PointOf[order[i]]]).norm() <= tolerance;
      const bool touching = part[e.PointOf[order[j]]] != part[e.PointOf[order[i]]];
      if (d <= tolerance && !before && !touching)
      {
        report.Fail("coincident nodes",
          "points " + std::to_string(order[i]) + " and " + std::to_string(order[j]), d, tolerance);
      }
    }
  }
}

// Neither order of its nodes is the right one.
bool IsTangledWedge(const Model& model, Id e)
{
  const auto bezier = BezierJacobians(model.Corners(e), model.Elements[e].Size);
  return model.Elements[e].Size == 6 && *std::min_element(bezier.begin(), bezier.end()) <= 0;
}
}

void CheckElements(const Evidence& e, Report& report)
{
  std::vector<char> used(e.Out.Points.size(), 0);
  for (Id c = 0; c < static_cast<Id>(e.Out.Elements.size()); ++c)
  {
    const Element& element = e.Out.Elements[c];
    const Element& input = e.In.Elements[e.CellOf[c]];
    std::set<Id> distinct, before;
    for (int i = 0; i < element.Size; ++i)
    {
      distinct.insert(e.PointOf[element.Node[i]]);
      used[element.Node[i]] = 1;
    }
    before.insert(input.Node.begin(), input.Node.begin() + input.Size);
    if (static_cast<int>(distinct.size()) != element.Size)
    {
      report.Fail("distinct nodes", Cell(c), distinct.size(), element.Size);
    }
    if (!std::includes(before.begin(), before.end(), distinct.begin(), distinct.end()))
    {
      report.Fail("nodes of an element are those it had", Cell(c), c, 0);
    }
    if (element.Size != input.Size && e.Case.Options.Optimization == 0 && e.Number("Wedges") == 0)
    {
      report.Fail("no wedge without treatment", Cell(c), element.Size, input.Size);
    }
    const bool touched = e.Touched(c) || element.Size != input.Size;
    if (!touched)
    {
      const auto isSame = [&](Id own, Id node) { return e.PointOf[own] == node; };
      if (!std::equal(element.Node.begin(), element.Node.begin() + element.Size, input.Node.begin(),
            isSame) &&
        !IsTangledWedge(e.In, e.CellOf[c]))
      {
        report.Fail("nodes of an untouched element", Cell(c) + " are in another order");
      }
      continue;
    }
    const auto corners = e.Out.Corners(c);
    const double volume = VolumeOf(corners, element.Size);
    const double longest = Longest(corners, element.Size);
    const auto inputCorners = e.In.Corners(e.CellOf[c]);
    const double was = VolumeOf(inputCorners, input.Size);
    const auto inputBezier = BezierJacobians(inputCorners, input.Size);
    if (was <= 0 || *std::min_element(inputBezier.begin(), inputBezier.end()) <= 0)
    {
      continue; // invalid as it came
    }
    if (!(volume > 1e-6 * was) || longest == 0)
    {
      report.Fail("no element collapses", Cell(c), volume / was, 1e-6);
    }
    const auto gauss = IntegrationPointJacobians(corners, element.Size);
    const double least = *std::min_element(gauss.begin(), gauss.end());
    if (!(least > 0))
    {
      report.Fail("Jacobian at integration points", Cell(c) + (element.Size == 6 ? " wedge" : ""),
        least / std::abs(volume), 0);
    }
    // The wedge treatment promises validity everywhere, distribution only at the points.
    const auto bezier = BezierJacobians(corners, element.Size);
    const double lowest = *std::min_element(bezier.begin(), bezier.end());
    if (e.Case.Options.Optimization == 2 && e.Case.Options.CorrectionType != 1 && !(lowest > 0))
    {
      report.Fail("Bezier certificate", Cell(c) + (element.Size == 6 ? " wedge" : ""),
        lowest / std::abs(volume), 0);
    }
  }
  for (Id p = 0; p < static_cast<Id>(used.size()); ++p)
  {
    if (!used[p])
    {
      report.Fail("unused points", "point " + std::to_string(p), 0, 1);
      break;
    }
  }
  CheckCoincidence(e, report);
}

namespace
{
double ScaledJacobianOf(vtkUnstructuredGrid* grid, Id c)
{
  vtkCell* cell = grid->GetCell(c);
  return cell->GetCellType() == VTK_WEDGE ? vtkMeshQuality::WedgeScaledJacobian(cell)
                                          : vtkMeshQuality::HexScaledJacobian(cell);
}

void CheckQuality(const Evidence& e, Report& report)
{
  vtkDataArray* array = e.Case.Trimmed->GetCellData()->GetArray("ScaledJacobian");
  if (!array)
  {
    return;
  }
  double least = 1e300, leastGauss = 1e300;
  Id touchedCells = 0, certified = 0, doubtful = 0;
  for (Id c = 0; c < static_cast<Id>(e.Out.Elements.size()); ++c)
  {
    const bool moved = e.Touched(c);
    const double given = array->GetComponent(c, 0);
    if (moved || !std::isnan(given))
    {
      const double real = ScaledJacobianOf(e.Case.Trimmed, c);
      if (!(std::abs(real - given) <= 1e-5))
      {
        report.Fail("ScaledJacobian", Cell(c) + ", Verdict's " + std::to_string(real), given, 1e-5);
      }
      least = moved ? std::min(least, real) : least;
    }
    if (!moved)
    {
      continue;
    }
    ++touchedCells;
    const auto corners = e.Out.Corners(c);
    const int size = e.Out.Elements[c].Size;
    const auto gauss = IntegrationPointJacobians(corners, size);
    double mean = 0;
    for (double g : gauss)
    {
      mean += g / gauss.size();
    }
    leastGauss = std::min(leastGauss, *std::min_element(gauss.begin(), gauss.end()) / mean);
    const auto bezier = BezierJacobians(corners, size);
    const double lowest = *std::min_element(bezier.begin(), bezier.end()) / std::abs(mean);
    certified += lowest > 0;
    doubtful += std::abs(lowest) < 1e-7;
  }
  Expect(e, "TouchedElements", touchedCells, 0, report);
  Expect(e, "CertifiedElements", certified, doubtful, report);
  if (touchedCells > 0)
  {
    Expect(e, "MinimumScaledJacobian", least, 1e-5, report);
    Expect(e, "MinimumIntegrationPointJacobian", leastGauss, 1e-4, report);
  }
}
}

void CheckFloor(const Evidence& e, Report& report)
{
  const double floor = e.Case.Options.MinimumScaledJacobian;
  if (floor <= 0 || e.Case.Options.CorrectionType == 1)
  {
    return;
  }
  std::vector<int> cutFacets(e.Out.Elements.size(), 0);
  for (const Facet& facet : e.NewBoundary)
  {
    ++cutFacets[facet.Owner];
  }
  for (Id c = 0; c < static_cast<Id>(e.Out.Elements.size()); ++c)
  {
    const bool touched = e.Touched(c) || e.Out.Elements[c].Size != e.In.Elements[e.CellOf[c]].Size;
    const bool straight = e.Case.Options.Optimization != 2 && cutFacets[c] > 1;
    if (!touched || straight)
    {
      continue;
    }
    // What came below the floor keeps 0.2, if it had that. Rounded as the filter's own measure may
    // be.
    const double before = ScaledJacobianOf(e.Case.Input->Grid, e.CellOf[c]);
    const double least = before < floor * (1 + 1e-9) ? 0.2 : floor;
    if (least > floor || before < least * (1 + 1e-9))
    {
      continue;
    }
    const double quality = ScaledJacobianOf(e.Case.Trimmed, c);
    if (!(quality >= least * (1 - 1e-9)))
    {
      report.Fail("quality floor", Cell(c), quality, least);
    }
  }
}

void CheckSummary(const Evidence& e, Report& report)
{
  const double kept = static_cast<double>(e.Out.Elements.size());
  Expect(e, "Kept", kept, 0, report);
  Expect(e, "Eliminated", static_cast<double>(e.In.Elements.size()) - kept, 0, report);
  Expect(e, "Treated",
    static_cast<double>(std::count(e.ElementStatus.begin(), e.ElementStatus.end(), 2)), 0, report);
  double moved = 0, farthest = 0, volume = 0, wedges = 0;
  for (Id p = 0; p < static_cast<Id>(e.Out.Points.size()); ++p)
  {
    moved += e.Moved(p);
    if (e.OnNewBoundary[p])
    {
      farthest = std::max(farthest, std::abs(e.Signed(e.Out.Points[p])));
    }
  }
  for (Id c = 0; c < static_cast<Id>(e.Out.Elements.size()); ++c)
  {
    volume += VolumeOf(e.Out.Corners(c), e.Out.Elements[c].Size);
    wedges += e.Out.Elements[c].Size == 6 && e.In.Elements[e.CellOf[c]].Size == 8;
  }
  Expect(e, "MovedNodes", moved, 0, report);
  // Single precision: rounded after it was summed.
  const double skin = e.Rounding / e.Case.Input->Box.ElementSize;
  Expect(e, "Volume", volume, (1e-9 + 10 * skin) * volume, report);
  Expect(e, "Wedges", wedges, 0, report);
  // Type I leaves the staircase, whose nodes lie about an element away.
  const double size = e.Case.Input->Box.ElementSize;
  if (farthest < 2.5 * size)
  {
    Expect(e, "MaximumDistanceToSurface", farthest, 1e-6 * size + 1.1 * e.Exact, report);
  }
  Expect(e, "NodeBandwidth", static_cast<double>(Bandwidth(e.Out.Elements)), 0, report);
  CheckQuality(e, report);
}

Id Bandwidth(const std::vector<Element>& elements)
{
  Id widest = 0;
  for (const Element& element : elements)
  {
    const auto ends =
      std::minmax_element(element.Node.begin(), element.Node.begin() + element.Size);
    widest = std::max(widest, *ends.second - *ends.first);
  }
  return widest;
}

Id ReverseCuthillMcKeeBandwidth(const Model& model)
{
  using namespace boost;
  using Graph = adjacency_list<setS, vecS, undirectedS,
    property<vertex_color_t, default_color_type, property<vertex_degree_t, int>>>;
  Graph graph(model.Points.size());
  for (const Element& element : model.Elements)
  {
    for (int i = 0; i < element.Size; ++i)
    {
      for (int j = 0; j < i; ++j)
      {
        add_edge(element.Node[i], element.Node[j], graph);
      }
    }
  }
  std::vector<graph_traits<Graph>::vertex_descriptor> order(num_vertices(graph));
  cuthill_mckee_ordering(graph, order.rbegin(), get(vertex_color, graph), make_degree_map(graph));
  std::vector<Id> number(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    number[order[i]] = static_cast<Id>(i);
  }
  std::vector<Element> elements = model.Elements;
  for (Element& element : elements)
  {
    for (int i = 0; i < element.Size; ++i)
    {
      element.Node[i] = number[element.Node[i]];
    }
  }
  return Bandwidth(elements);
}

void CheckNumbering(const Evidence& e, Report& report)
{
  // As it came: the kept nodes in the input's order.
  std::vector<Id> sorted = e.PointOf;
  std::sort(sorted.begin(), sorted.end());
  std::vector<Element> elements = e.Out.Elements;
  for (Element& element : elements)
  {
    for (int i = 0; i < element.Size; ++i)
    {
      element.Node[i] =
        std::lower_bound(sorted.begin(), sorted.end(), e.PointOf[element.Node[i]]) - sorted.begin();
    }
  }
  const Id now = Bandwidth(e.Out.Elements), came = Bandwidth(elements);
  if (!e.Case.Options.RenumberNodes)
  {
    if (!std::is_sorted(e.PointOf.begin(), e.PointOf.end()))
    {
      report.Fail("numbering", "nodes are not in the input's order", 0, 0);
    }
    return;
  }
  if (now > came)
  {
    report.Fail("numbering", "bandwidth worse than as it came", now, came);
  }
  Model before = e.Out;
  before.Elements = elements;
  const Id rcm = ReverseCuthillMcKeeBandwidth(before);
  if (now > rcm)
  {
    report.Fail("numbering", "bandwidth worse than reverse Cuthill-McKee", now, rcm);
  }
  // Its ties fall by the numbering it starts from.
  if (now > ReverseCuthillMcKeeBandwidth(e.Out))
  {
    report.Note("bandwidth that reverse Cuthill-McKee of the result betters");
  }
}

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

/// Whether nodes of the new boundary are off the surface; CheckMoves judges whether rightly.
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
  double expected = 0, given = 0;
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
  for (Id c = 0; c < static_cast<Id>(e.Out.Elements.size()); ++c)
  {
    given += VolumeOf(e.Out.Corners(c), e.Out.Elements[c].Size);
  }
  const double limit = (1e-9 + 10 * e.Rounding / e.Case.Input->Box.ElementSize) * expected +
    BorderAllowance(*e.Case.Input);
  if (!(std::abs(given - expected) <= limit))
  {
    report.Fail("volume cut by a plane", "exactly " + std::to_string(expected), given, limit);
  }
}

namespace
{
bool IsRelaxed(const Evidence& e, Id point)
{
  vtkDataArray* applied = e.Case.Trimmed->GetPointData()->GetArray("CorrectionApplied");
  return applied && applied->GetComponent(point, 0) == 4;
}
}

namespace
{
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
      report.Fail("kept part or offcut", "input " + Cell(c) + " is in that many", 2, 1);
    }
  }
}
}

void CheckPair(const Evidence& kept, const Evidence& offcut, Report& report)
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
  if (kept.Case.Options.CorrectionType == 1 || HasNodesLeft(kept) || HasNodesLeft(offcut))
  {
    return;
  }
  double parts = 0, whole = 0;
  for (const Evidence* e : { &kept, &offcut })
  {
    for (Id c = 0; c < static_cast<Id>(e->Out.Elements.size()); ++c)
    {
      parts += VolumeOf(e->Out.Corners(c), e->Out.Elements[c].Size);
    }
  }
  for (Id c = 0; c < static_cast<Id>(kept.In.Elements.size()); ++c)
  {
    whole += VolumeOf(kept.In.Corners(c), kept.In.Elements[c].Size);
  }
  // Where one part has a chord (a dropped or distributed node), the other has a corner: on a
  // plane the same, on a curved surface a triangle of area L^3 / 16 R between them.
  const Frame& box = kept.Case.Input->Box;
  const double chord = 2 * box.ElementSize;
  const double depth = box.LayerThickness > 0 ? box.LayerThickness : box.ElementSize;
  const double pentahedra = kept.Number("Pentahedra") + offcut.Number("Pentahedra");
  const double limit = (1e-9 + 10 * kept.Rounding / box.ElementSize) * whole +
    BorderAllowance(*kept.Case.Input) +
    pentahedra * depth * chord * chord * chord / (16 * kept.Case.Cut->MinimumRadius);
  const bool comparable = kept.Case.Input->Flat && !kept.HasOrphans() && !offcut.HasOrphans();
  if (comparable && !(std::abs(parts - whole) <= limit))
  {
    report.Fail(
      "kept part and offcut add up", "volume against " + std::to_string(whole), parts, limit);
  }
  if (kept.Case.Options.Optimization == 1 || !kept.Case.Cut->HasPlane || kept.Rescued() ||
    offcut.Rescued() || tie || !comparable)
  {
    return; // a node may be distributed in one part alone
  }
  // Along the cut: a node that both parts have is at the same place in both.
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
      report.Fail("parts fit node by node", "input point " + std::to_string(kept.PointOf[p]), gap,
        kept.Exact);
    }
  }
}

}
