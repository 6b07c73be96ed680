#include "Checks.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <random>

namespace judge
{
namespace
{
void RequireArray(vtkDataSetAttributes* data, const char* port, const char* name, int type,
  int components, Report& report)
{
  vtkDataArray* array = data->GetArray(name);
  const std::string where = std::string(port) + " " + name;
  if (!array)
  {
    report.Fail("arrays", where + " is missing");
    return;
  }
  if (type >= 0 && array->GetDataType() != type)
  {
    report.Fail("arrays", where + " has type", array->GetDataType(), type);
  }
  if (array->GetNumberOfComponents() != components)
  {
    report.Fail("arrays", where + " has components", array->GetNumberOfComponents(), components);
  }
}

void CheckNodes(const Evidence& e, Report& report)
{
  const double tolerance = e.Case.Options.Tolerance * e.Diagonal;
  const double size = e.Case.Input->Box.ElementSize;
  // What the oracle itself may be wrong by.
  const double doubt = 1e-13 * e.Diagonal + e.Rounding;
  std::vector<char> needed(e.In.Points.size(), 0);
  for (std::size_t c = 0; c < e.In.Elements.size(); ++c)
  {
    for (int i = 0; e.ElementStatus[c] == 2 && i < e.In.Elements[c].Size; ++i)
    {
      needed[e.In.Elements[c].Node[i]] = 1;
    }
  }
  for (Id p = 0; p < static_cast<Id>(e.In.Points.size()); ++p)
  {
    double s = e.Roughly(e.In.Points[p]);
    const bool near = std::abs(s) < 2.5 * size;
    s = near ? e.Signed(e.In.Points[p]) : s;
    const int status = e.NodeStatus[p];
    const bool mayBeOn = std::abs(s) <= tolerance * 1.001 + doubt;
    const bool mustBeOn = std::abs(s) < tolerance * 0.999 - doubt;
    const int side = s > 0 ? 1 : 0;
    if (!(status == side && !mustBeOn) && !(status == 2 && mayBeOn) &&
      !(status != 2 && std::abs(s) <= doubt && tolerance <= doubt))
    {
      report.Fail("NodeStatus",
        Point(p) + " status " + std::to_string(status) + ", signed distance by the oracle", s,
        tolerance);
    }
    const float given = e.SignedDistance[p];
    if (std::isnan(given))
    {
      if (needed[p])
      {
        report.Fail("SignedDistance", Point(p) + " of an element to treat is NaN", given, 0);
      }
    }
    else if (near && !(std::abs(given - s) <= 1e-6 * std::abs(s) + 1e-6 * size + doubt))
    {
      report.Fail("SignedDistance", Point(p) + " against the oracle's " + std::to_string(s), given,
        1e-6 * size);
    }
    else if (!near && (given > 0) != (s > 0))
    {
      report.Fail("SignedDistance", Point(p) + " has the wrong sign", given, s);
    }
  }
}

void CheckElementStatuses(const Evidence& e, Report& report)
{
  for (Id c = 0; c < static_cast<Id>(e.In.Elements.size()); ++c)
  {
    int count[3] = { 0, 0, 0 };
    for (int i = 0; i < e.In.Elements[c].Size; ++i)
    {
      ++count[std::min<int>(e.NodeStatus[e.In.Elements[c].Node[i]], 2)];
    }
    const int expected = count[1] == 0 ? 0 : count[0] == 0 ? 1 : 2;
    if (e.ElementStatus[c] != expected)
    {
      report.Fail("ElementStatus", Cell(c), e.ElementStatus[c], expected);
    }
    if ((expected == 0 && e.Fraction[c] != 0) || (expected == 1 && e.Fraction[c] != 1))
    {
      report.Fail("EliminatedFraction", Cell(c) + " that is not cut", e.Fraction[c], expected);
    }
    if (!(e.Fraction[c] >= 0 && e.Fraction[c] <= 1))
    {
      report.Fail("EliminatedFraction", Cell(c) + " out of 0..1", e.Fraction[c], 1);
    }
  }
}
}

void CheckArrays(const Trial& trial, Report& report)
{
  const struct
  {
    const char* Name;
    vtkUnstructuredGrid* Grid;
  } ports[2] = { { "port 0", trial.Trimmed }, { "port 1", trial.Whole } };
  for (const auto& port : ports)
  {
    vtkPointData* pd = port.Grid->GetPointData();
    vtkCellData* cd = port.Grid->GetCellData();
    RequireArray(pd, port.Name, "NodeStatus", VTK_UNSIGNED_CHAR, 1, report);
    RequireArray(pd, port.Name, "SignedDistance", VTK_FLOAT, 1, report);
    RequireArray(pd, port.Name, "Displacement", VTK_FLOAT, 3, report);
    RequireArray(pd, port.Name, "CorrectionApplied", VTK_UNSIGNED_CHAR, 1, report);
    RequireArray(cd, port.Name, "ElementStatus", VTK_UNSIGNED_CHAR, 1, report);
    RequireArray(cd, port.Name, "EliminatedFraction", VTK_FLOAT, 1, report);
    if (!trial.MayDivide)
    {
      RequireArray(cd, port.Name, "Rescue", VTK_UNSIGNED_CHAR, 1, report);
    }
  }
  RequireArray(trial.Trimmed->GetPointData(), "port 0", "vtkOriginalPointIds", -1, 1, report);
  RequireArray(trial.Trimmed->GetCellData(), "port 0", "vtkOriginalCellIds", -1, 1, report);
  RequireArray(trial.Trimmed->GetCellData(), "port 0", "ScaledJacobian", VTK_FLOAT, 1, report);
  for (const char* name : { "Kept", "Eliminated", "InsertedElements", "Treated", "MovedNodes",
         "Pentahedra", "Wedges", "CertifiedElements", "TouchedElements", "MinimumScaledJacobian",
         "MinimumIntegrationPointJacobian", "MaximumDistanceToSurface", "Volume", "NodeBandwidth" })
  {
    vtkDataArray* array = trial.Trimmed->GetFieldData()->GetArray(name);
    if (!array || array->GetNumberOfTuples() != 1 || array->GetNumberOfComponents() != 1)
    {
      report.Fail("arrays", std::string("summary ") + name + " is missing or not one value");
    }
  }
}

void CheckRescues(const Evidence& e, Report& report)
{
  vtkDataArray* kept = e.Case.Trimmed->GetCellData()->GetArray("Rescue");
  vtkDataArray* whole = e.Case.Whole->GetCellData()->GetArray("Rescue");
  if (!kept || !whole)
  {
    report.Fail("Rescue", "missing on a port");
    return;
  }
  for (Id c = 0; c < kept->GetNumberOfTuples(); ++c)
  {
    if (!e.InsertedCell[c] && kept->GetComponent(c, 0) != whole->GetComponent(e.CellOf[c], 0))
    {
      report.Fail("Rescue", Cell(e.CellOf[c]) + ": the ports differ", kept->GetComponent(c, 0),
        whole->GetComponent(e.CellOf[c], 0));
    }
  }
  Id count[6] = { 0, 0, 0, 0, 0, 0 };
  for (Id c = 0; c < whole->GetNumberOfTuples(); ++c)
  {
    ++count[std::min(5, static_cast<int>(whole->GetComponent(c, 0)))];
  }
  // The summary counts elements where nodes were relaxed, columns elsewhere.
  const char* const names[6] = { "", "RescuedByRelaxation", "RescuedByTreatment",
    "RescuedByCorrection", "RescuedByFate", "RescuedByLeaving" };
  for (int rung = 1; rung < 6; ++rung)
  {
    const double told = e.Number(names[rung]);
    const bool agree =
      rung == 1 ? told == static_cast<double>(count[rung]) : (told > 0) == (count[rung] > 0);
    if (!agree)
    {
      report.Fail("Rescue", std::string("against ") + names[rung] + " of the summary",
        static_cast<double>(count[rung]), told);
    }
  }
}

void CheckStatuses(const Evidence& e, Report& report)
{
  CheckNodes(e, report);
  CheckElementStatuses(e, report);
}

namespace
{
// The largest cross-section of an element by planes across a direction, over its volume: one over
// its width if it stands along the direction, more if it is aslant to it.
double LargestSection(
  const std::array<Vec3, 8>& corners, int size, const Vec3& direction, double low, double high)
{
  constexpr int slices = 10, samples = 12;
  std::array<double, slices> slice{};
  double all = 0;
  for (int i = 0; i < samples * samples * samples; ++i)
  {
    const Vec3 at =
      (Vec3(i % samples, (i / samples) % samples, i / (samples * samples)) + Vec3::Constant(0.5)) /
      samples;
    if (size == 6 && at[0] + at[1] > 1)
    {
      continue;
    }
    const double share = (direction.dot(PositionAt(corners, size, at)) - low) / (high - low);
    const double weight = std::abs(JacobianAt(corners, size, at));
    slice[std::clamp(static_cast<int>(slices * share), 0, slices - 1)] += weight;
    all += weight;
  }
  return *std::max_element(slice.begin(), slice.end()) / all * slices / (high - low);
}

// The estimate takes the surface as plane within a tetrahedron; its error is the sagitta over
// the element times the element's section along the surface.
double ChordError(const Evidence& e, const std::array<Vec3, 8>& corners, int size)
{
  const Vec3 middle = PositionAt(corners, size, Vec3(1.0 / 3, 1.0 / 3, 0.5));
  const double step = 1e-3 * e.Case.Input->Box.ElementSize;
  Vec3 gradient;
  for (int k = 0; k < 3; ++k)
  {
    gradient[k] = e.Signed(middle + step * Vec3::Unit(k)) - e.Signed(middle - step * Vec3::Unit(k));
  }
  gradient.normalize();
  double low = 1e300, high = -1e300, longest = 0;
  for (int i = 0; i < size; ++i)
  {
    low = std::min(low, gradient.dot(corners[i] - middle));
    high = std::max(high, gradient.dot(corners[i] - middle));
    longest = std::max(longest, (corners[i] - corners[0]).norm());
  }
  const double radius = e.Case.Cut->MinimumRadius, half = longest / 2;
  if (half >= radius)
  {
    return 1;
  }
  const double middleAt = gradient.dot(middle);
  return half * half / (radius + std::sqrt(radius * radius - half * half)) *
    LargestSection(corners, size, gradient, low + middleAt, high + middleAt);
}

// The estimate takes the faces of its tetrahedra for those of the element. Between a twisted face
// and either pair of triangles lies half of the tetrahedron of its four corners: the largest of
// them, as a share of the element.
double TwistError(const Evidence& e, Id cell, const std::array<Vec3, 8>& corners, int size)
{
  double largest = 0;
  for (const Facet& facet : FacetsOf(e.In.Elements[cell], cell))
  {
    if (facet.Size() == 4)
    {
      const auto at = [&](int i) -> const Vec3& { return e.In.Points[facet.Node[i]]; };
      const Vec3 u = at(1) - at(0), v = at(2) - at(0), w = at(3) - at(0);
      largest = std::max(largest, std::abs(u.cross(v).dot(w)) / 12);
    }
  }
  const double third = 1.0 / 3;
  const Vec3 middle = size == 8 ? Vec3(0.5, 0.5, 0.5) : Vec3(third, third, 0.5);
  const double volume = std::abs(JacobianAt(corners, size, middle)) * (size == 8 ? 1 : 0.5);
  return largest / volume;
}
}

void CheckFractions(const Evidence& e, Report& report, int maximumCells)
{
  std::vector<Id> cut;
  for (Id c = 0; c < static_cast<Id>(e.In.Elements.size()); ++c)
  {
    if (e.ElementStatus[c] == 2)
    {
      cut.push_back(c);
    }
  }
  const std::size_t stride = std::max<std::size_t>(1, cut.size() / maximumCells);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(0, 1);
  for (std::size_t k = 0; k < cut.size(); k += stride)
  {
    const auto corners = e.In.Corners(cut[k]);
    const int size = e.In.Elements[cut[k]].Size;
    const double chord = ChordError(e, corners, size);
    if (chord > 0.22)
    {
      continue;
    }
    const double limit = 0.03 + chord + TwistError(e, cut[k], corners, size);
    double beyond = 0, all = 0;
    for (int i = 0; i < 1000; ++i)
    {
      Vec3 at =
        (Vec3(i % 10, (i / 10) % 10, i / 100) + Vec3(any(random), any(random), any(random))) / 10;
      if (size == 6 && at[0] + at[1] > 1)
      {
        at[0] = 1 - at[0];
        at[1] = 1 - at[1];
      }
      const double weight = std::abs(JacobianAt(corners, size, at));
      all += weight;
      beyond += e.Roughly(PositionAt(corners, size, at)) > 0 ? weight : 0;
    }
    if (!(std::abs(beyond / all - e.Fraction[cut[k]]) <= limit))
    {
      report.Fail("EliminatedFraction",
        Cell(cut[k]) + " differs from the sampled " + std::to_string(beyond / all),
        e.Fraction[cut[k]], limit);
    }
  }
}

}
