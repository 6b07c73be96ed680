#include "Checks.h"

#include <Eigen/Geometry>

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkMeshQuality.h>
#include <vtkPointData.h>

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/connected_components.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace judge
{
namespace
{
double Longest(const std::array<Vec3, 8>& corners, int size)
{
  double longest = 0;
  for (int i = 1; i < size; ++i)
  {
    longest = std::max(longest, (corners[i] - corners[0]).norm());
  }
  return longest;
}

void ExpectNumber(
  const Evidence& e, const char* name, double expected, double limit, Report& report)
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
  // Two nodes at one place.
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
        report.Fail("coincident nodes", Point(order[i]) + " and " + Point(order[j]), d, tolerance);
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

/// Whether a hexahedron has its nodes in the right order where it had them in the other one.
bool IsTurned(const Evidence& e, Id c)
{
  const Element &element = e.Out.Elements[c], &input = e.In.Elements[e.CellOf[c]];
  const auto corners = e.In.Corners(e.CellOf[c]);
  bool turned = element.Size == 8;
  for (int i = 0; i < 8 && turned; ++i)
  {
    const Vec3 corner(i % 2, i / 2 % 2, i / 4);
    turned =
      e.PointOf[element.Node[i]] == input.Node[(i + 4) % 8] && JacobianAt(corners, 8, corner) <= 0;
  }
  return turned;
}

/// An element has nodes of that which it was; an untouched one all of them, in their order.
void CheckNodesOf(const Evidence& e, Id c, bool touched, Report& report)
{
  const Element& element = e.Out.Elements[c];
  const Element& input = e.In.Elements[e.CellOf[c]];
  std::set<Id> distinct;
  for (int i = 0; i < element.Size; ++i)
  {
    distinct.insert(e.PointOf[element.Node[i]]);
  }
  const std::set<Id> before(input.Node.begin(), input.Node.begin() + input.Size);
  if (!e.InsertedCell[c] && static_cast<int>(distinct.size()) != element.Size)
  {
    report.Fail("distinct nodes", Cell(c), distinct.size(), element.Size);
  }
  if (!std::includes(before.begin(), before.end(), distinct.begin(), distinct.end()))
  {
    report.Fail("nodes of an element are those it had", Cell(c), c, 0);
  }
  if (!e.InsertedCell[c] && element.Size != input.Size && e.Case.Options.Optimization == 0 &&
    e.Number("Wedges") == 0)
  {
    report.Fail("no wedge without treatment", Cell(c), element.Size, input.Size);
  }
  const auto isSame = [&](Id own, Id node) { return e.PointOf[own] == node; };
  if (!touched &&
    !std::equal(
      element.Node.begin(), element.Node.begin() + element.Size, input.Node.begin(), isSame) &&
    !IsTangledWedge(e.In, e.CellOf[c]) && !IsTurned(e, c))
  {
    report.Fail("nodes of an untouched element", Cell(c) + " are in another order");
  }
}

/// A touched element is valid if it came so.
void CheckShapeOf(const Evidence& e, Id c, Report& report)
{
  const int size = e.Out.Elements[c].Size, inputSize = e.In.Elements[e.CellOf[c]].Size;
  const auto corners = e.Out.Corners(c);
  const double volume = VolumeOf(corners, size);
  const auto inputCorners = e.In.Corners(e.CellOf[c]);
  const double was = VolumeOf(inputCorners, inputSize);
  const auto inputBezier = BezierJacobians(inputCorners, inputSize);
  if (was <= 0 || *std::min_element(inputBezier.begin(), inputBezier.end()) <= 0)
  {
    return; // invalid as it came
  }
  if (!(volume > 1e-6 * was) || Longest(corners, size) == 0)
  {
    report.Fail("no element collapses", Cell(c), volume / was, 1e-6);
  }
  const std::string what = Cell(c) + (size == 6 ? " wedge" : "");
  const auto gauss = IntegrationPointJacobians(corners, size);
  const double least = *std::min_element(gauss.begin(), gauss.end());
  if (!(least > 0))
  {
    report.Fail("Jacobian at integration points", what, least / std::abs(volume), 0);
  }
  // Wedges are valid everywhere, and with their treatment hexahedra too; else only at the points.
  const auto bezier = BezierJacobians(corners, size);
  const double lowest = *std::min_element(bezier.begin(), bezier.end());
  if ((e.Case.Options.Optimization == 2 || size == 6) && e.Case.Options.CorrectionType != 1 &&
    !(lowest > 0))
  {
    report.Fail("Bezier certificate", what, lowest / std::abs(volume), 0);
  }
}

/// False for points that no element has.
std::vector<char> FindUsed(const Model& model)
{
  std::vector<char> used(model.Points.size(), 0);
  for (const Element& element : model.Elements)
  {
    for (int i = 0; i < element.Size; ++i)
    {
      used[element.Node[i]] = 1;
    }
  }
  return used;
}
}

void CheckElements(const Evidence& e, Report& report)
{
  for (Id c = 0; c < static_cast<Id>(e.Out.Elements.size()); ++c)
  {
    const bool touched = e.Touched(c) || e.Out.Elements[c].Size != e.In.Elements[e.CellOf[c]].Size;
    CheckNodesOf(e, c, touched, report);
    if (touched)
    {
      CheckShapeOf(e, c, report);
    }
  }
  const std::vector<char> used = FindUsed(e.Out);
  const auto unused = std::find(used.begin(), used.end(), 0);
  if (unused != used.end())
  {
    report.Fail("unused points", Point(unused - used.begin()), 0, 1);
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
  ExpectNumber(e, "TouchedElements", touchedCells, 0, report);
  ExpectNumber(e, "CertifiedElements", certified, doubtful, report);
  if (touchedCells > 0)
  {
    ExpectNumber(e, "MinimumScaledJacobian", least, 1e-5, report);
    ExpectNumber(e, "MinimumIntegrationPointJacobian", leastGauss, 1e-4, report);
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
  const auto inserted =
    static_cast<double>(std::count(e.InsertedCell.begin(), e.InsertedCell.end(), 1));
  const double kept = static_cast<double>(e.Out.Elements.size()) - inserted;
  ExpectNumber(e, "InsertedElements", inserted, 0, report);
  ExpectNumber(e, "Kept", kept, 0, report);
  ExpectNumber(e, "Eliminated", static_cast<double>(e.In.Elements.size()) - kept, 0, report);
  ExpectNumber(e, "Treated",
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
  ExpectNumber(e, "MovedNodes", moved, 0, report);
  // Single precision: rounded after it was summed.
  const double skin = e.Rounding / e.Case.Input->Box.ElementSize;
  ExpectNumber(e, "Volume", volume, (1e-9 + 10 * skin) * volume, report);
  ExpectNumber(e, "Wedges", wedges, 0, report);
  // Type I leaves the staircase, whose nodes lie about an element away.
  const double size = e.Case.Input->Box.ElementSize;
  if (farthest < 2.5 * size)
  {
    ExpectNumber(e, "MaximumDistanceToSurface", farthest, 1e-6 * size + 1.1 * e.Exact, report);
  }
  ExpectNumber(e, "NodeBandwidth", static_cast<double>(Bandwidth(e.Out.Elements)), 0, report);
  CheckQuality(e, report);
}

}
