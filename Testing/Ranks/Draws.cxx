#include "Draws.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include <cmath>
#include <cstdio>
#include <map>

namespace judge
{
namespace
{
/// Faces a little apart, as CAD programs leave them.
vtkSmartPointer<vtkDataObject> WithGaps(Dice& dice, vtkDataObject* shell, double gap)
{
  auto* blocks = vtkMultiBlockDataSet::SafeDownCast(shell);
  if (!blocks)
  {
    return shell;
  }
  auto parted = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (unsigned i = 0; i < blocks->GetNumberOfBlocks(); ++i)
  {
    vtkNew<vtkPolyData> face;
    face->DeepCopy(blocks->GetBlock(i));
    const Vec3 shift = gap * Vec3(dice.Any() - 0.5, dice.Any() - 0.5, dice.Any() - 0.5);
    MovePoints(face, [&shift](const Vec3& p) { return Vec3(p + shift); });
    auto* control = face->GetFieldData()->GetArray("NURBSControlPoints");
    for (vtkIdType k = 0; control && k < control->GetNumberOfTuples(); ++k)
    {
      for (int c = 0; c < 3; ++c)
      {
        control->SetComponent(k, c, control->GetComponent(k, c) + shift[c]);
      }
    }
    vtkNew<vtkDoubleArray> tolerance;
    tolerance->SetName("NURBSTolerance");
    tolerance->InsertNextValue(gap);
    face->GetFieldData()->AddArray(tolerance);
    parted->SetBlock(i, face);
  }
  return parted;
}

std::string PlacementWords(const std::string& kind, const Placement& at)
{
  char text[200];
  std::snprintf(text, sizeof(text), "%s x %.4f y %.4f angle %.4f lean %.4f size %.4f seed %u%s",
    kind.c_str(), at.X, at.Y, at.Angle, at.Lean, at.Size, at.Seed, at.Reversed ? " reversed" : "");
  return text;
}

/// A round hole and a plane that touches it.
Cut DrawTouching(Dice& dice, const Frame& box)
{
  Placement at = DrawPlacement(dice, "cylinder");
  at.Lean = 0;
  at.Angle = dice.Chance(0.5) ? 0 : at.Angle;
  at.Reversed = false;
  const double radius = at.Size * std::min(box.HalfX, box.HalfY);
  const double way = dice.Chance(0.5) ? 0.5 * M_PI * dice.Below(4) : 2 * M_PI * dice.Any();
  const Vec3 normal = box.Axes * Vec3(std::cos(way), std::sin(way), 0);
  const Vec3 centre = box.Centre + box.Axes * Vec3(at.X * box.HalfX, at.Y * box.HalfY, 0);
  const double side = dice.Chance(0.5) ? 1 : -1;
  return { "touching " + PlacementWords("cylinder", at),
    Together(MakeSurface("cylinder", box, at).Data,
      PlaneThrough(centre + radius * normal, side * normal, 100 * box.HalfX).Data) };
}

Cut DrawOne(Dice& dice, const Frame& box)
{
  const double which = dice.Any();
  if (which < 0.02)
  {
    const Placement at = DrawPlacement(dice, "plane");
    return which < 0.01 ? Cut{ PlacementWords("ending", at), EndingPlane(box, at) }
                        : Cut{ PlacementWords("endingloop", at), EndingTrimLoop(box, at) };
  }
  if (which < 0.04)
  {
    const Vec3 local((2 * dice.Any() - 1) * box.HalfX, (2 * dice.Any() - 1) * box.HalfY,
      (2 * dice.Any() - 1) * box.HalfZ);
    const Vec3 normal = Vec3(dice.Any() - 0.5, dice.Any() - 0.5, dice.Any() - 0.5).normalized();
    const double size = box.ElementSize * (0.2 + 3 * dice.Any());
    return { "patch", PlaneThrough(box.Centre + box.Axes * local, normal, size) };
  }
  if (which < 0.06)
  {
    return DrawTouching(dice, box);
  }
  const std::string kind = dice.Pick(AllSurfaceKinds());
  const Placement at = DrawPlacement(dice, kind);
  Cut cut{ PlacementWords(kind, at), MakeSurface(kind, box, at) };
  if ((kind == "roundrect" || kind == "rectangle") && dice.Chance(0.6))
  {
    cut.Words += " with gaps";
    const double gap = 1e-3 * std::max(box.HalfX, box.HalfY) * dice.Any();
    cut.What.Data = WithGaps(dice, cut.What.Data, gap);
  }
  return cut;
}

}

//------------------------------------------------------------------------------
Placement DrawPlacement(Dice& dice, const std::string& kind)
{
  Placement at;
  at.X = 1.4 * dice.Any() - 0.7;
  at.Y = 1.4 * dice.Any() - 0.7;
  at.Angle = 2 * M_PI * dice.Any();
  const double lean = (kind == "cone" || kind == "wavy" ? 0.25 : 0.78) * dice.Any();
  at.Lean = dice.Chance(0.5) ? 0 : lean;
  at.Size = dice.Chance(0.15) ? 0.02 + 0.15 * dice.Any() : 0.35 + 0.4 * dice.Any();
  at.Seed = 1 + static_cast<unsigned>(1e6 * dice.Any());
  at.Reversed = dice.Chance(0.5);
  return at;
}

//------------------------------------------------------------------------------
Cut DrawAslant(Dice& dice, const Frame& box)
{
  const std::string kind =
    dice.Pick(std::vector<std::string>{ "plane", "wavy", "cylinder", "arc" });
  Placement at = DrawPlacement(dice, kind);
  at.Lean = 0.4 + 0.4 * dice.Any();
  at.Angle = 0.4 + 0.8 * dice.Any();
  return { "aslant " + PlacementWords(kind, at), MakeSurface(kind, box, at) };
}

//------------------------------------------------------------------------------
Cut DrawCut(Dice& dice, const Frame& box)
{
  const double number = dice.Any();
  Cut cut = DrawOne(dice, box);
  for (double more = 0.88; number > more; more += 0.09)
  {
    const Cut other = DrawOne(dice, box);
    cut.Words += " + " + other.Words;
    cut.What = Together(cut.What.Data, other.What.Data);
  }
  return cut;
}

//------------------------------------------------------------------------------
Extra DrawOptions(Dice& dice, const Frame& box)
{
  Extra extra;
  TrimOptions& o = extra.Options;
  o.CorrectionType = dice.Chance(0.07) ? 1 : dice.Chance(0.5) ? 2 : 3;
  o.Optimization = dice.Chance(0.5) ? 2 : dice.Below(3);
  o.InvertSide = dice.Chance(0.5);
  o.MinimumScaledJacobian =
    dice.Chance(0.7) ? 0.2 : dice.Pick(std::vector<double>{ 0, 0.3, 0.5, 0.7 });
  o.EliminationFraction = dice.Chance(0.8) ? 0.5 : dice.Any();
  o.Tolerance = dice.Chance(0.8) ? 1e-9
    : dice.Chance(0.5)           ? 0
                                 : std::pow(10.0, -12 + 10 * dice.Any());
  o.ProduceOffcut = dice.Chance(0.45);
  o.InsertLayer = dice.Chance(o.ProduceOffcut ? 0.1 : 0.4);
  o.MapValues = dice.Chance(0.5);
  o.RenumberNodes = dice.Chance(0.5);
  o.UseKeepPoint = dice.Chance(0.12);
  o.KeepPoint = box.Centre +
    box.Axes *
      Vec3(1.3 * (2 * dice.Any() - 1) * box.HalfX, 1.3 * (2 * dice.Any() - 1) * box.HalfY,
        (2 * dice.Any() - 1) * box.HalfZ);
  extra.Quality = dice.Chance(0.2);
  char text[300];
  std::snprintf(text, sizeof(text),
    " type %d opt %d floor %g fraction %.3f tolerance %.2g%s%s%s%s%s%s%s", o.CorrectionType,
    o.Optimization, o.MinimumScaledJacobian, o.EliminationFraction, o.Tolerance,
    o.InvertSide ? " inverted" : "", o.ProduceOffcut ? " offcut" : "",
    o.InsertLayer ? " layer" : "", o.MapValues ? " map" : "", o.RenumberNodes ? "" : " unnumbered",
    o.UseKeepPoint ? " keeppoint" : "", extra.Quality ? " quality" : "");
  extra.Words = text;
  return extra;
}

//------------------------------------------------------------------------------
Mesh WithOddCells(const Mesh& mesh, double insideOut, bool wedgesAsHexahedra, Dice& dice)
{
  Mesh odd = mesh;
  odd.Grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  odd.Grid->ShallowCopy(mesh.Grid);
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> types;
  vtkNew<vtkIdList> nodes;
  for (vtkIdType c = 0; c < mesh.Grid->GetNumberOfCells(); ++c)
  {
    mesh.Grid->GetCellPoints(c, nodes);
    int type = mesh.Grid->GetCellType(c);
    if (type == VTK_WEDGE && wedgesAsHexahedra)
    {
      const vtkIdType n[8] = { nodes->GetId(0), nodes->GetId(1), nodes->GetId(2), nodes->GetId(2),
        nodes->GetId(3), nodes->GetId(4), nodes->GetId(5), nodes->GetId(5) };
      nodes->SetNumberOfIds(8);
      std::copy(n, n + 8, nodes->GetPointer(0));
      type = VTK_HEXAHEDRON;
    }
    else if (type == VTK_HEXAHEDRON && dice.Chance(insideOut))
    {
      std::swap_ranges(nodes->GetPointer(0), nodes->GetPointer(4), nodes->GetPointer(4));
    }
    cells->InsertNextCell(nodes);
    types->InsertNextValue(static_cast<unsigned char>(type));
  }
  odd.Grid->SetCells(types, cells);
  return odd;
}

//------------------------------------------------------------------------------
Mesh DrawMesh(Dice& dice, const std::vector<std::string>& names, std::string& words, bool& needsIds)
{
  needsIds = false;
  const double which = dice.Any();
  if (names.size() > 1 && which < 0.04)
  {
    needsIds = true;
    words = which < 0.02 ? "slit" : "stack";
    return which < 0.02 ? TwoSheets(8, 10, 2, 0.4, Vec3(8, 0, 0))
                        : TwoSheets(10, 10, 2, 0.4, Vec3(0, 0, 0.8));
  }
  if (names.size() > 1 && which < 0.06)
  {
    needsIds = which < 0.05;
    words = needsIds ? "joined" : "segment";
    return which < 0.05 ? BlocksJoinedAtEdges(4) : Segment(10, 20, 0.05);
  }
  if (names.size() > 1 && which < 0.08)
  {
    words = which < 0.07 ? "large" : "largeblock";
    return which < 0.07 ? Sheet(90, 80, 2, Vec3(1, 1, 0.4)) : Block(26, 24, 22);
  }
  words = dice.Pick(names);
  static std::map<std::string, Mesh> made;
  if (!made.count(words))
  {
    made[words] = MakeMesh(words);
  }
  Mesh mesh = made[words];
  if (dice.Chance(0.1))
  {
    const double share = dice.Pick(std::vector<double>{ 0.01, 0.04, 0.06, 0.3, 1 });
    words += " insideout " + std::to_string(share);
    mesh = WithOddCells(mesh, share, true, dice);
  }
  return mesh;
}
}
