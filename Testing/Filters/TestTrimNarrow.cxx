/**
 * @file TestTrimNarrow.cxx
 * @brief What the surface cuts out or leaves between two walls that are less than an element apart:
 * of what is lost the filter tells, and of nothing else.
 */
#include "Expect.h"
#include "SplineData.h"
#include "WarnedFindings.h"

#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkStaticCellLocator.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

using namespace judge;

namespace
{
constexpr double Degree = 0.017453292519943295;

/// Distance in the plane from the nearest node of a grid.
double DistanceToNode(vtkUnstructuredGrid* grid, const Vec2& place)
{
  double nearest = std::numeric_limits<double>::infinity();
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    nearest = std::min(nearest, (Vec3(grid->GetPoint(i)).head<2>() - place).norm());
  }
  return nearest;
}

/// Whether an element in which, or beside which, a place is has a Feasibility.
bool IsToldAt(vtkUnstructuredGrid* whole, const Vec2& place)
{
  vtkDataArray* const found = whole->GetCellData()->GetArray("Feasibility");
  for (vtkIdType c = 0; c < whole->GetNumberOfCells(); ++c)
  {
    double box[6];
    whole->GetCellBounds(c, box);
    if (found->GetComponent(c, 0) > 0 && box[0] - 1 < place.x() && place.x() < box[1] + 1 &&
      box[2] - 1 < place.y() && place.y() < box[3] + 1)
    {
      return true;
    }
  }
  return false;
}

// The inner corners of a relief notch that are cut off are told of, also where nodes went to the
// outer ones right beside them; where all corners are followed nothing is.
void TestNotches()
{
  const Mesh sheet = Sheet(30, 30, 2, Vec3(1, 1, 0.4));
  int missed = 0, followed = 0;
  for (int k = 0; k < 120; ++k)
  {
    const double x = 20.0 + 0.1 * (k % 10), y = 14.0 + 0.17 * (k % 6), width = 1.3 + 0.1 * (k % 11),
                 depth = 1.2 + 0.11 * (k % 9);
    const std::vector<Vec2> inner{ Vec2(x - depth, y), Vec2(x - depth, y + width) };
    const std::vector<Vec2> outer{ Vec2(x, y), Vec2(x, y + width) };
    const Surface contour = Polyline({ Vec2(x, 4.3), outer[0], inner[0], inner[1], outer[1],
      Vec2(x, 26.2), Vec2(5.4, 26.2), Vec2(5.4, 4.3) });
    TrimOptions options;
    options.InvertSide = k % 2 != 0; // a notch, or a tab in its place
    const Outcome outcome = RunTrim(sheet, contour, options);
    const std::string name = "notch " + std::to_string(k);
    const auto found = ExpectWarned(name, outcome);
    bool all = true;
    for (const std::vector<Vec2>& corners : { inner, outer })
    {
      for (const Vec2& corner : corners)
      {
        const bool isMissed = DistanceToNode(outcome.Case.Trimmed, corner) > 0.1;
        all &= !isMissed;
        missed += isMissed;
        Expect(!isMissed || IsToldAt(outcome.Case.Whole, corner),
          name + ": nothing is told of a corner that is cut off");
      }
    }
    followed += all;
    Expect(!all || found.count(Curved) == 0, name + ": an edge is told of that is followed");
  }
  std::printf("notches: %d corners missed, %d whole\n", missed, followed);
  Expect(missed > 5 && followed > 5,
    "notches: " + std::to_string(missed) + " corners missed, " + std::to_string(followed) +
      " whole");
}

// A groove along the border, whose edge lies within the thickness: where no layer has nodes at it
// the border cuts it off, and that is told of from a tenth of an element on.
void TestGroove()
{
  const Mesh one = Sheet(14, 8, 1, Vec3(1, 1, 1)), two = Sheet(14, 8, 2, Vec3(1, 1, 0.5)),
             five = Sheet(14, 8, 5, Vec3(1, 1, 0.2));
  const auto groove = [](const Mesh& mesh, double lean)
  {
    const Vec3 edge = mesh.Box.Centre + Vec3(0.3, 0, 0);
    const double side = 20 * std::tan(lean * Degree);
    SplineSurface wall = Wall({ Vec2(side, 20), Vec2(0, 0), Vec2(side, -20) });
    for (Eigen::Vector4d& corner : wall.Control)
    {
      const Vec3 place = edge + Vec3(corner[0], -2 * corner[2], corner[1]);
      corner.head<3>() = place;
    }
    Surface surface;
    surface.Data = ToPolyData(wall);
    return surface;
  };
  ExpectOnly("groove of 30 degrees", one, groove(one, 15), Curved, 8);
  ExpectOnly("groove of 80 degrees", one, groove(one, 40), Curved, 8);
  ExpectNothing("groove of 10 degrees", one, groove(one, 5), {});
  ExpectNothing("groove with nodes at its edge", two, groove(two, 40), {});
  ExpectNothing("groove in thin layers", five, groove(five, 40), {});
}

// A tongue of what is kept, narrower than an element, that reaches into a square hole: of one that
// is lost its tip is told of, also where nodes went to the sharp edges at its root, and where it
// holds nodes of the mesh; of one that is there nothing is.
void TestTongues()
{
  int lost = 0, there = 0;
  for (const int layers : { 2, 8 })
  {
    const Mesh mesh = Sheet(14, 14, layers, Vec3(1, 1, layers == 2 ? 0.4 : 1.0));
    const double height = layers == 2 ? 0.8 : 8.0;
    for (int k = 0; k < 24; ++k)
    {
      const double width = 0.3 + 0.2 * (k % 4), length = k % 8 < 4 ? 2.0 : 4.0;
      const Vec2 at = k < 8 ? Vec2(7, 7) : k < 16 ? Vec2(7.5, 7.5) : Vec2(7.25, 7.1);
      const double w = 0.5 * width;
      std::vector<Vec2> line{ Vec2(-4, -4), Vec2(4, -4), Vec2(4, 4), Vec2(w, 4),
        Vec2(w, 4 - length), Vec2(-w, 4 - length), Vec2(-w, 4), Vec2(-4, 4) };
      std::for_each(line.begin(), line.end(), [&at](Vec2& corner) { corner += at; });
      TrimOptions options;
      options.InvertSide = true;
      const Outcome outcome = RunTrim(mesh, Polyline(line), options);
      const std::string name = "tongue " + std::to_string(k) + " of " + std::to_string(layers);
      auto found = ExpectWarned(name, outcome);
      const double tongue = width * length;
      const double is = Number(outcome.Case.Trimmed, "Volume") / height - (14 * 14 - 8 * 8);
      const bool isLost = is < 0.5 * tongue;
      ++(isLost ? lost : there);
      Expect(isLost == (found[CrossedTwice] > 0),
        name + (isLost ? ": nothing is told of it" : ": told of as lost"));
      Expect(!isLost || IsToldAt(outcome.Case.Whole, at + Vec2(0, 5.0 - length)),
        name + ": nothing is told of its tip");
    }
  }
  Expect(lost > 20 && there > 5,
    "tongues: " + std::to_string(lost) + " lost, " + std::to_string(there) + " there");
}

// Through the whole sheet, with straight walls; what is between them goes.
Surface Slot(const Mesh& sheet, double width, double angle = 0.02)
{
  Frame box = sheet.Box;
  box.ElementSize = width / 3.4;
  Placement at;
  at.X = 0.013;
  at.Angle = angle;
  Surface slot = MakeSurface("slot", box, at);
  const double inside = slot.Signed(sheet.Box.Centre + Vec3(0.013 * sheet.Box.HalfX, 0, 0));
  at.Reversed = inside < 0;
  return MakeSurface("slot", box, at);
}

/// Share of an element of an upright sheet beyond a surface that goes straight through it.
double SampleShare(vtkCell* element, const Surface& surface)
{
  constexpr int count = 40;
  double box[6];
  element->GetBounds(box);
  int beyond = 0;
  for (int i = 0; i < count * count; ++i)
  {
    const double u = (i % count + 0.5) / count, v = (i / count + 0.5) / count;
    beyond += surface.Signed(Vec3(box[0] + u * (box[1] - box[0]), box[2] + v * (box[3] - box[2]),
                0.5 * (box[4] + box[5]))) > 0;
  }
  return static_cast<double>(beyond) / (count * count);
}

/// EliminatedFraction of elements with a face that the surface crosses twice.
void ExpectShares(const std::string& name, vtkUnstructuredGrid* whole, const Surface& surface)
{
  vtkDataArray* found = whole->GetCellData()->GetArray("Feasibility");
  vtkDataArray* shares = whole->GetCellData()->GetArray("EliminatedFraction");
  for (vtkIdType c = 0; c < whole->GetNumberOfCells(); ++c)
  {
    if (found->GetComponent(c, 0) == CrossedTwice)
    {
      const double share = shares->GetComponent(c, 0);
      const double sampled = SampleShare(whole->GetCell(c), surface);
      Expect(std::abs(share - sampled) < 0.02,
        name + ": a share of " + std::to_string(share) + " for " + std::to_string(sampled));
    }
  }
}

void TestSlots()
{
  const Mesh sheet = Sheet(30, 30, 1, Vec3(1, 1, 0.4));
  ExpectNothing("slot of width 3.4", sheet, Slot(sheet, 3.4), TrimOptions());
  ExpectOnly("slot of width 2", sheet, Slot(sheet, 2), Narrow, 2 * 30);
  // Between two rows of nodes for most of its way: each edge across is crossed twice.
  const auto thin = ExpectWarned("thin slot", RunTrim(sheet, Slot(sheet, 0.2), {}));
  const int lost = thin.count(NotOpened) ? thin.at(NotOpened) : 0;
  Expect(lost > 10, "thin slot: not opened in " + std::to_string(lost) + " elements");
  // Along the diagonals of elements, whose other two nodes lie beside it: no edge is crossed twice,
  // but faces are.
  for (const double angle : { 45.0, 135.0 })
  {
    const std::string name = "strip at " + std::to_string(angle);
    const Surface strip = Slot(sheet, 0.8, angle * Degree);
    const Outcome outcome = RunTrim(sheet, strip, {});
    auto mixed = ExpectWarned(name, outcome);
    Expect(mixed[CrossedTwice] > 10,
      name + ": crossed twice in " + std::to_string(mixed[CrossedTwice]) + " elements");
    ExpectShares(name, outcome.Case.Whole, strip);
  }
}

const char* const StripPhrase = "The volume of 6 cut elements is lost";

// Of the second sheet a strip is spared, of which no element is made.
void TestStripLost()
{
  const Mesh sheets = TwoSheets(8, 10, 2, 0.4, Vec3(9, 0, 0));
  const Vec3 first(sheets.Grid->GetPoint(0));
  const Surface plane = PlaneThrough(first + Vec3(9.3, 0, 0), Vec3::UnitX(), 100);
  const Outcome outcome = RunTrim(sheets, plane, {});
  Expect(IsTold(outcome, StripPhrase) && outcome.Warnings.size() == 1,
    "strip lost: " +
      (outcome.Warnings.empty() ? std::string("nothing told") : outcome.Warnings.front()));
  TrimOptions rest;
  rest.InvertSide = true;
  const Outcome other = RunTrim(sheets, plane, rest);
  Expect(other.Warnings.empty(), "the other side of a strip: something is told");
}

// The same, where the cut goes on through ten more sheets, and where a hole in the first one is
// told of: neither makes up for the strip.
void TestStripLostAmongOthers()
{
  std::vector<Vec3> shifts{ Vec3::Zero(), Vec3(9, 0, 0) };
  for (int i = 1; i <= 10; ++i)
  {
    shifts.emplace_back(5.0, 20.0 * i, 0.0);
  }
  const Mesh many = Sheets(8, 10, 2, 0.4, shifts);
  const Vec3 first(many.Grid->GetPoint(0));
  const Surface plane = PlaneThrough(first + Vec3(9.3, 0, 0), Vec3::UnitX(), 1000);
  Expect(IsTold(RunTrim(many, plane, {}), StripPhrase), "strip lost beside a long cut");

  const Mesh sheets = TwoSheets(8, 10, 2, 0.4, Vec3(9, 0, 0));
  const Outcome outcome = RunTrim(sheets, StripAndHole(sheets), {});
  Expect(ExpectWarned("strip and hole", outcome)[NotOpened] == 8 && IsTold(outcome, StripPhrase),
    "strip lost beside a hole that is not opened");
}

// Columns follow a plane that leans by several elements: kept elements come to lie where others
// went, and nothing is lost.
void TestNothingLostByLeaning()
{
  const Mesh sheet = Sheet(24, 10, 16, Vec3(1, 1, 0.1));
  const Vec3 first(sheet.Grid->GetPoint(0));
  for (const double angle : { 30.0, 55.0, 60.0, 65.0 })
  {
    const double lean = angle * std::acos(-1.0) / 180.0;
    const Vec3 normal(std::cos(lean), 0.1, std::sin(lean));
    const Vec3 middle(12.3, 5.0, 0.8);
    const Outcome outcome = RunTrim(sheet, PlaneThrough(first + middle, normal, 200), {});
    const std::string name = "leaning by " + std::to_string(static_cast<int>(angle));
    vtkFieldData* summary = outcome.Case.Trimmed->GetFieldData();
    const double volume = summary->GetArray("Volume")->GetComponent(0, 0);
    Expect(std::abs(volume - middle[0] * 10.0 * 1.6) < 1e-6, name + ": volume of the half");
    Expect(!IsTold(outcome, "cut elements is lost"), name + ": volume told as lost that is there");
  }
}

/// A hole each on both sides of a place, with a strip of the given width between them.
Surface TwoHoles(const Mesh& mesh, const Vec3& place, double angle, double radius, double width)
{
  const Vec3 way = (radius + 0.5 * width) * Vec3(std::cos(angle), std::sin(angle), 0);
  return Together(RoundHole(mesh, place.x() + way.x(), place.y() + way.y(), radius).Data,
    RoundHole(mesh, place.x() - way.x(), place.y() - way.y(), radius).Data);
}

/// Whether a grid holds all of a straight line.
bool HoldsLine(vtkUnstructuredGrid* grid, const Vec3& from, const Vec3& to)
{
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(grid);
  locator->BuildLocator();
  constexpr int Count = 40;
  for (int i = 0; i <= Count; ++i)
  {
    Vec3 p = from + (to - from) * (static_cast<double>(i) / Count);
    if (locator->FindCell(p.data()) < 0)
    {
      return false;
    }
  }
  return true;
}

// Two holes that become one, as the strip between them goes, are told of; others are not.
void TestStripParted()
{
  const Mesh sheet = Sheet(40, 30, 2, Vec3(1, 1, 0.5));
  int parted = 0;
  for (int k = 0; k < 120; ++k)
  {
    const double angle = 0.7 * k, radius = 2.0 + 0.03 * k, width = 0.7 + 0.3 * (k % 3);
    const Vec3 place(19.5 + 0.37 * (k % 7), 14.6 + 0.29 * (k % 5), 0.1);
    const Outcome outcome = RunTrim(sheet, TwoHoles(sheet, place, angle, radius, width), {});
    const std::string name = "strip " + std::to_string(k) + " of " + std::to_string(width);
    const bool told = ExpectWarned(name, outcome).count(CrossedTwice) > 0;
    const Vec3 along(-std::sin(angle), std::cos(angle), 0);
    if (!HoldsLine(outcome.Case.Trimmed, place - 1.5 * along, place + 1.5 * along))
    {
      ++parted;
      Expect(told, name + " is parted: nothing is told");
    }
  }
  Expect(parted > 5 && parted < 60, "strips parted: " + std::to_string(parted));
  // Broader ones stay.
  for (int k = 0; k < 40; ++k)
  {
    const Vec3 place(19.5 + 0.37 * (k % 7), 14.6 + 0.29 * (k % 5), 0.1);
    const Outcome outcome = RunTrim(sheet, TwoHoles(sheet, place, 0.7 * k, 4.5, 1.7), {});
    Expect(ExpectWarned("broad strip", outcome).count(CrossedTwice) == 0,
      "broad strip " + std::to_string(k) + ": something is told");
  }
}
}

int main()
{
  TestNotches();
  TestTongues();
  TestGroove();
  TestSlots();
  TestStripLost();
  TestStripLostAmongOthers();
  TestNothingLostByLeaning();
  TestStripParted();
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
