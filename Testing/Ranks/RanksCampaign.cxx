/**
 * @file RanksCampaign.cxx
 * @brief Random trims of grids in pieces against the trim of the whole: mesh x surface x options x
 * partition.
 *
 * RanksCampaign [count [seed [only [meshes]]]]: `only` repeats one trim of the series alone, and
 * shows what the filter says of it, -1: all.
 */
#include "Pieces.h"
#include "SplineData.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkTrimHexahedralGrid.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <numeric>
#include <random>
#include <set>

using namespace judge;

namespace
{
using Grid = vtkSmartPointer<vtkUnstructuredGrid>;
using Grids = std::vector<Grid>;

class Dice
{
public:
  Dice(unsigned seed, unsigned number)
  {
    std::seed_seq sequence{ seed, number };
    this->Random.seed(sequence);
  }
  double Any() { return std::uniform_real_distribution<double>(0, 1)(this->Random); }
  bool Chance(double share) { return this->Any() < share; }
  int Below(int count) { return std::min(count - 1, static_cast<int>(this->Any() * count)); }
  template <typename T>
  const T& Pick(const std::vector<T>& from)
  {
    return from[this->Below(static_cast<int>(from.size()))];
  }

private:
  std::mt19937 Random;
};

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

struct Cut
{
  std::string Words;
  Surface What;
};

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

/// Aslant to all elements of a block, or nearly.
Cut DrawAslant(Dice& dice, const Frame& box)
{
  const std::string kind =
    dice.Pick(std::vector<std::string>{ "plane", "wavy", "cylinder", "arc" });
  Placement at = DrawPlacement(dice, kind);
  at.Lean = 0.4 + 0.4 * dice.Any();
  at.Angle = 0.4 + 0.8 * dice.Any();
  return { "aslant " + PlacementWords(kind, at), MakeSurface(kind, box, at) };
}

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

struct Extra
{
  TrimOptions Options;
  bool Quality = false;
  std::string Words;
};

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

/// Some cells with their nodes in the other order, or as hexahedra with two pairs of equal corners.
Mesh WithOddCells(const Mesh& mesh, double insideOut, bool wedgesAsHexahedra, Dice& dice)
{
  Mesh odd = mesh;
  odd.Grid = Grid::New();
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

const std::vector<std::string> Partitions{ "slabs", "scattered", "checkerboard", "voronoi",
  "singles", "few", "sides", "cut", "last", "columns" };

/// @param statuses of the elements; empty: not known.
std::vector<int> DrawPartition(const std::string& name, const Mesh& mesh, vtkUnstructuredGrid* grid,
  vtkDataArray* statuses, int ranks, Dice& dice)
{
  const vtkIdType count = grid->GetNumberOfCells();
  std::vector<int> rank(count, 0);
  const auto setAll = [&](const auto& of)
  {
    for (vtkIdType c = 0; c < count; ++c)
    {
      rank[c] = of(c);
    }
  };
  const auto any = [&](vtkIdType) { return dice.Below(ranks); };
  const auto localOf = [&](vtkIdType c)
  { return Vec3(mesh.Box.Axes.transpose() * (CentreOf(grid, c) - mesh.Box.Centre)); };
  const auto statusOf = [&](vtkIdType c)
  { return statuses ? static_cast<int>(statuses->GetComponent(c, 0)) : dice.Below(3); };
  if (name == "slabs")
  {
    const Vec3 axis = Vec3(dice.Any() - 0.5, dice.Any() - 0.5, dice.Any() - 0.5);
    std::vector<std::pair<double, vtkIdType>> places;
    for (vtkIdType c = 0; c < count; ++c)
    {
      places.emplace_back(localOf(c).dot(axis), c);
    }
    std::sort(places.begin(), places.end());
    for (vtkIdType i = 0; i < count; ++i)
    {
      rank[places[i].second] = static_cast<int>(i * ranks / count);
    }
  }
  else if (name == "checkerboard")
  {
    const double size = mesh.Box.ElementSize;
    const double layer = mesh.Box.LayerThickness > 0 ? mesh.Box.LayerThickness : size;
    setAll(
      [&](vtkIdType c)
      {
        const Vec3 p = localOf(c);
        const long sum = std::lround(std::floor(p[0] / size)) +
          std::lround(std::floor(p[1] / size)) + std::lround(std::floor(p[2] / layer));
        return static_cast<int>(((sum % ranks) + ranks) % ranks);
      });
  }
  else if (name == "columns")
  {
    std::map<std::pair<long, long>, int> of;
    setAll(
      [&](vtkIdType c)
      {
        const Vec3 p = localOf(c) / mesh.Box.ElementSize;
        const auto key =
          std::make_pair(std::lround(std::floor(p[0])), std::lround(std::floor(p[1])));
        return of.emplace(key, dice.Below(ranks)).first->second;
      });
  }
  else if (name == "voronoi")
  {
    std::vector<Vec3> seeds;
    for (int i = 0; i < 3 * ranks; ++i)
    {
      seeds.push_back(CentreOf(grid, dice.Below(static_cast<int>(count))));
    }
    setAll(
      [&](vtkIdType c)
      {
        const Vec3 p = CentreOf(grid, c);
        const auto nearest = std::min_element(seeds.begin(), seeds.end(),
          [&p](const Vec3& a, const Vec3& b) { return (a - p).norm() < (b - p).norm(); });
        return static_cast<int>(nearest - seeds.begin()) % ranks;
      });
  }
  else if (name == "singles" || name == "few")
  {
    std::vector<vtkIdType> cut;
    for (vtkIdType c = 0; c < count; ++c)
    {
      if (statusOf(c) == 2)
      {
        cut.push_back(c);
      }
    }
    for (int r = 1; r < ranks; ++r)
    {
      for (int i = 0; i < (name == "few" ? 5 : 1); ++i)
      {
        rank[cut.empty() ? dice.Below(static_cast<int>(count)) : dice.Pick(cut)] = r;
      }
    }
  }
  else if (name == "sides")
  {
    setAll([&](vtkIdType c) { return std::min(ranks - 1, statusOf(c)); });
  }
  else if (name == "cut")
  {
    setAll([&](vtkIdType c) { return statusOf(c) == 2 ? dice.Below(ranks) : 0; });
  }
  else if (name == "last")
  {
    setAll([&](vtkIdType) { return ranks - 1; });
  }
  else
  {
    setAll(any);
  }
  return rank;
}

std::string DescribeArrays(vtkDataSetAttributes* data)
{
  std::set<std::string> words;
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* array = data->GetAbstractArray(i);
    if (std::string(array->GetName()) == vtkDataSetAttributes::GhostArrayName())
    {
      continue; // the whole has none
    }
    words.insert(std::string(array->GetName()) + ":" + array->GetDataTypeAsString() +
      std::to_string(array->GetNumberOfComponents()));
  }
  std::string all;
  for (const auto& word : words)
  {
    all += word + " ";
  }
  return all;
}

std::string DifferenceOfArrays(vtkUnstructuredGrid* whole, const Grids& pieces)
{
  for (const auto& piece : pieces)
  {
    if (piece->GetNumberOfCells() > 0 &&
      (DescribeArrays(whole->GetPointData()) != DescribeArrays(piece->GetPointData()) ||
        DescribeArrays(whole->GetCellData()) != DescribeArrays(piece->GetCellData())))
    {
      return "\n      " + DescribeArrays(whole->GetPointData()) + " | " +
        DescribeArrays(whole->GetCellData()) + "\n      " + DescribeArrays(piece->GetPointData()) +
        " | " + DescribeArrays(piece->GetCellData());
    }
  }
  return {};
}

Grid Copy(vtkUnstructuredGrid* grid)
{
  auto copy = Grid::New();
  copy->DeepCopy(grid);
  return copy;
}

/// A grid of some points and cells of another.
/// @param points ids of these, and cells.
Grid Select(vtkUnstructuredGrid* grid, const std::vector<vtkIdType>& points,
  const std::vector<vtkIdType>& cells)
{
  auto selected = Grid::New();
  vtkNew<vtkIdList> pointIds, cellIds, nodes;
  std::vector<vtkIdType> number(grid->GetNumberOfPoints(), -1);
  for (const vtkIdType p : points)
  {
    number[p] = pointIds->InsertNextId(p);
  }
  vtkNew<vtkPoints> places;
  places->SetDataType(grid->GetPoints()->GetDataType());
  places->SetNumberOfPoints(pointIds->GetNumberOfIds());
  grid->GetPoints()->GetData()->GetTuples(pointIds, places->GetData());
  selected->SetPoints(places);
  selected->Allocate();
  for (const vtkIdType c : cells)
  {
    cellIds->InsertNextId(c);
    grid->GetCellPoints(c, nodes);
    for (vtkIdType i = 0; i < nodes->GetNumberOfIds(); ++i)
    {
      nodes->SetId(i, number[nodes->GetId(i)]);
    }
    selected->InsertNextCell(grid->GetCellType(c), nodes);
  }
  const auto copy = [](vtkDataSetAttributes* from, vtkIdList* ids, vtkDataSetAttributes* to)
  {
    to->CopyAllOn();
    to->CopyGlobalIdsOn();
    to->CopyAllocate(from, ids->GetNumberOfIds());
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      to->CopyData(from, ids->GetId(i), i);
    }
  };
  copy(grid->GetPointData(), pointIds, selected->GetPointData());
  copy(grid->GetCellData(), cellIds, selected->GetCellData());
  selected->GetFieldData()->ShallowCopy(grid->GetFieldData());
  return selected;
}

std::vector<vtkIdType> Ids(vtkIdType count)
{
  std::vector<vtkIdType> ids(count);
  std::iota(ids.begin(), ids.end(), vtkIdType(0));
  return ids;
}

Grid WithoutUnusedPoints(vtkUnstructuredGrid* grid)
{
  std::set<vtkIdType> used;
  vtkNew<vtkIdList> nodes;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    grid->GetCellPoints(c, nodes);
    used.insert(nodes->begin(), nodes->end());
  }
  return static_cast<vtkIdType>(used.size()) == grid->GetNumberOfPoints()
    ? Grid(grid)
    : Select(grid, { used.begin(), used.end() }, Ids(grid->GetNumberOfCells()));
}

Grid Permuted(vtkUnstructuredGrid* grid, Dice& dice)
{
  if (grid->GetNumberOfCells() == 0)
  {
    return grid;
  }
  const auto shuffled = [&dice](vtkIdType count)
  {
    auto ids = Ids(count);
    for (vtkIdType i = count - 1; i > 0; --i)
    {
      std::swap(ids[i], ids[dice.Below(static_cast<int>(i + 1))]);
    }
    return ids;
  };
  return Select(grid, shuffled(grid->GetNumberOfPoints()), shuffled(grid->GetNumberOfCells()));
}

/// A piece with all points of the whole, as some programs write them.
Grid WithAllPoints(vtkUnstructuredGrid* whole, vtkUnstructuredGrid* piece)
{
  std::vector<vtkIdType> cells;
  for (vtkIdType c = 0; c < piece->GetNumberOfCells(); ++c)
  {
    cells.push_back(
      static_cast<vtkIdType>(piece->GetCellData()->GetArray("WholeCell")->GetComponent(c, 0)));
  }
  return cells.empty() && whole->GetNumberOfCells() % 2
    ? Grid(piece)
    : Select(whole, Ids(whole->GetNumberOfPoints()), cells);
}

using Differences = std::vector<std::pair<std::string, std::string>>;

Differences Compare(vtkUnstructuredGrid* input, const Grids& pieces, const PiecesOutcome& whole,
  const PiecesOutcome& parts)
{
  Differences found;
  const auto filled = [](const auto& piece) { return piece->GetNumberOfPoints() > 0; };
  const auto add = [&found](const std::string& what, const std::string& difference)
  {
    if (!difference.empty())
    {
      found.emplace_back(what, difference);
    }
  };
  if (whole.Errors.size() != parts.Errors.size())
  {
    add("errors", DifferenceOfTexts(whole.Errors, parts.Errors));
    return found;
  }
  add("text of errors", DifferenceOfTexts(whole.Errors, parts.Errors));
  add(whole.Warnings.size() == parts.Warnings.size() ? "text of warnings" : "warnings",
    DifferenceOfTexts(whole.Warnings, parts.Warnings));
  if (!whole.Errors.empty())
  {
    add("no error, but output",
      std::any_of(parts.Trimmed.begin(), parts.Trimmed.end(), filled) ? "some" : "");
    return found;
  }
  add("trimmed", DifferenceFromWhole(whole.Trimmed[0], parts.Trimmed));
  Grids statuses = parts.Statuses;
  for (auto& status : statuses)
  {
    status = WithoutUnusedPoints(status);
  }
  add("statuses", DifferenceFromWhole(whole.Statuses[0], statuses));
  add("summary", DifferenceOfSummaries(input, whole.Trimmed[0], parts.Trimmed));
  add("summary of statuses", DifferenceOfSummaries(input, whole.Statuses[0], parts.Statuses));
  if (whole.Offcuts[0]->GetNumberOfCells() > 0)
  {
    add("offcut", DifferenceFromWhole(whole.Offcuts[0], parts.Offcuts));
    add("summary of offcut", DifferenceOfSummaries(input, whole.Offcuts[0], parts.Offcuts));
    add("arrays of offcut", DifferenceOfArrays(whole.Offcuts[0], parts.Offcuts));
  }
  else
  {
    add("offcut",
      std::any_of(parts.Offcuts.begin(), parts.Offcuts.end(), filled) ? "one that the whole has not"
                                                                      : "");
  }
  add("ids", DifferenceOfOriginalIds(pieces, parts.Trimmed));
  add("ids", DifferenceOfOriginalIds(pieces, parts.Offcuts));
  add("arrays", DifferenceOfArrays(whole.Trimmed[0], parts.Trimmed));
  add("arrays of statuses", DifferenceOfArrays(whole.Statuses[0], parts.Statuses));
  return found;
}

void SetIds(vtkDataSetAttributes* data, const char* name, const std::vector<vtkIdType>& ids)
{
  vtkNew<vtkIdTypeArray> array;
  array->SetName(name);
  for (const vtkIdType id : ids)
  {
    array->InsertNextValue(id);
  }
  data->AddArray(array);
}

std::vector<vtkIdType> PointKeys(vtkUnstructuredGrid* grid)
{
  std::vector<vtkIdType> keys;
  vtkDataArray* ids = grid->GetPointData()->GetArray("WholePoint");
  vtkDataArray* inserted = grid->GetPointData()->GetArray("Inserted");
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
  {
    keys.push_back(2 * static_cast<vtkIdType>(ids->GetComponent(i, 0)) +
      (inserted && inserted->GetComponent(i, 0) > 0));
  }
  return keys;
}

/// Parts of one cell come in the same order in the whole and in a piece.
std::vector<std::pair<vtkIdType, int>> CellKeys(vtkUnstructuredGrid* grid)
{
  std::vector<std::pair<vtkIdType, int>> keys;
  std::map<vtkIdType, int> parts;
  vtkDataArray* ids = grid->GetCellData()->GetArray("WholeCell");
  for (vtkIdType i = 0; i < grid->GetNumberOfCells(); ++i)
  {
    const auto id = static_cast<vtkIdType>(ids->GetComponent(i, 0));
    keys.emplace_back(id, parts[id]++);
  }
  return keys;
}

/// Results as the input of another trim: ids of points and cells in the whole result.
void MarkAnew(Grid& whole, Grids& pieces)
{
  std::map<vtkIdType, vtkIdType> points;
  std::map<std::pair<vtkIdType, int>, vtkIdType> cells;
  for (const vtkIdType key : PointKeys(whole))
  {
    const auto id = static_cast<vtkIdType>(points.size());
    points[key] = id;
  }
  for (const auto& key : CellKeys(whole))
  {
    const auto id = static_cast<vtkIdType>(cells.size());
    cells[key] = id;
  }
  Grids all = pieces;
  all.push_back(whole);
  for (auto& grid : all)
  {
    grid = Copy(grid);
    if (grid->GetNumberOfCells() == 0)
    {
      continue;
    }
    std::vector<vtkIdType> pointIds, cellIds;
    for (const vtkIdType key : PointKeys(grid))
    {
      pointIds.push_back(points.at(key));
    }
    for (const auto& key : CellKeys(grid))
    {
      cellIds.push_back(cells.at(key));
    }
    SetIds(grid->GetPointData(), "WholePoint", pointIds);
    SetIds(grid->GetCellData(), "WholeCell", cellIds);
  }
  whole = all.back();
  all.pop_back();
  pieces = all;
}

using Surfaces = std::vector<vtkSmartPointer<vtkDataObject>>;

/// The surface whole on each rank, or each of its faces on one of them.
Surfaces GiveToRanks(vtkDataObject* data, int count, bool parted, Dice& dice)
{
  Surfaces given(count);
  auto* blocks = vtkMultiBlockDataSet::SafeDownCast(data);
  for (auto& own : given)
  {
    own.TakeReference(data->NewInstance());
    if (!blocks || !parted)
    {
      own->DeepCopy(data);
    }
  }
  for (unsigned i = 0; blocks && parted && i < blocks->GetNumberOfBlocks(); ++i)
  {
    auto* own = vtkMultiBlockDataSet::SafeDownCast(given[dice.Below(count)]);
    own->SetBlock(i, blocks->GetBlock(i)); // as a reader of many files leaves them
  }
  return given;
}

/// Runs a trim of pieces; with a first surface another run before, along that.
PiecesOutcome Run(const Grids& pieces, const Surfaces& surfaces, const Extra& extra,
  vtkDataObject* first, Dice& dice)
{
  const auto before = [&extra](int, vtkTrimHexahedralGrid* filter)
  { filter->SetQualityOfAllElements(extra.Quality); };
  if (!first)
  {
    return TrimPieces(pieces, surfaces, extra.Options, before);
  }
  return TrimPieces(pieces, GiveToRanks(first, static_cast<int>(pieces.size()), false, dice),
    extra.Options, before,
    [&surfaces](int rank, vtkTrimHexahedralGrid* filter)
    { filter->SetInputDataObject(1, surfaces[rank]); });
}

struct Tally
{
  int Trims = 0, Different = 0, Errors = 0, Warned = 0, Rescued = 0, Offcuts = 0, Layers = 0;
};
std::map<std::string, Tally> Table;
std::map<std::string, int> Kinds;

void Count(
  const std::vector<std::string>& keys, const PiecesOutcome& whole, const Differences& differences)
{
  for (const std::string& key : keys)
  {
    Tally& tally = Table[key];
    ++tally.Trims;
    tally.Different += !differences.empty();
    tally.Errors += !whole.Errors.empty();
    tally.Warned += !whole.Warnings.empty();
    if (whole.Errors.empty())
    {
      tally.Rescued += !Rescues(whole.Trimmed[0]).empty();
      tally.Offcuts += whole.Offcuts[0]->GetNumberOfCells() > 0;
      tally.Layers += Number(whole.Trimmed[0], "InsertedElements") > 0;
    }
  }
  for (const auto& difference : differences)
  {
    ++Kinds[difference.first];
  }
}

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

void Tell(const std::string& words, const PiecesOutcome& outcome)
{
  std::printf("%s\n", words.c_str());
  for (const auto& texts : { outcome.Errors, outcome.Warnings })
  {
    for (const std::string& text : texts)
    {
      std::printf("   %s\n", text.c_str());
    }
  }
}

void RunDraw(unsigned seed, int number, const std::vector<std::string>& names, bool tells)
{
  Dice dice(seed, number);
  std::string meshWords;
  bool needsIds = false;
  const Mesh mesh = DrawMesh(dice, names, meshWords, needsIds);
  Cut cut = DrawCut(dice, mesh.Box);
  Extra extra = DrawOptions(dice, mesh.Box);
  if (!mesh.Sheet && dice.Chance(0.4))
  {
    cut = DrawAslant(dice, mesh.Box);
    extra.Options.InsertLayer = extra.Options.InsertLayer || dice.Chance(0.6);
    extra.Words += extra.Options.InsertLayer ? " layer" : "";
  }
  const int ranks = dice.Pick(std::vector<int>{ 2, 2, 3, 3, 4, 4, 5, 6 });
  const std::string partition = dice.Pick(Partitions);
  DivideOptions divide{ ranks, dice.Chance(0.12), needsIds || dice.Chance(0.2) };
  const bool again = dice.Chance(0.25);
  const Surface first = MakeSurface("plane", mesh.Box, DrawPlacement(dice, "plane"));
  const bool bits32 = dice.Chance(0.2);
  const int trims = dice.Chance(0.25) ? 2 : 1;
  const bool unusedPoints = !divide.WithGhosts && dice.Chance(0.08);
  const bool permuted = dice.Chance(0.15);
  const bool parted = dice.Chance(0.15);

  Grid whole = WithWholeIds(mesh.Grid);
  if (divide.WithIds && !whole->GetPointData()->GetGlobalIds())
  {
    vtkNew<vtkIdTypeArray> ids;
    ids->DeepCopy(whole->GetPointData()->GetArray("WholePoint"));
    ids->SetName("Ids");
    whole->GetPointData()->SetGlobalIds(ids);
  }
  Grids pieces;
  for (int trim = 0; trim < trims; ++trim)
  {
    if (trim > 0)
    {
      cut = DrawCut(dice, mesh.Box);
      extra = DrawOptions(dice, mesh.Box);
    }
    const PiecesOutcome alone = Run({ whole }, { cut.What.Data }, extra, nullptr, dice);
    if (trim == 0)
    {
      vtkDataArray* statuses = alone.Statuses[0]->GetCellData()->GetArray("ElementStatus");
      pieces =
        DivideBy(whole, DrawPartition(partition, mesh, whole, statuses, ranks, dice), divide);
      for (auto& piece : pieces)
      {
        piece = unusedPoints ? WithAllPoints(whole, piece) : piece;
        piece = permuted ? Permuted(piece, dice) : piece;
        if (bits32 && piece->GetNumberOfCells() > 0 && dice.Chance(0.7))
        {
          piece = Copy(piece);
          piece->GetCells()->ConvertTo32BitStorage();
        }
      }
    }
    const PiecesOutcome parts = Run(pieces, GiveToRanks(cut.What.Data, ranks, parted, dice), extra,
      again && trim == 0 ? first.Data.Get() : nullptr, dice);
    PiecesOutcome last = parts;
    if (again && trim == 0)
    {
      // What the first run said is no matter.
      const PiecesOutcome plainly =
        Run(pieces, GiveToRanks(first.Data, ranks, false, dice), extra, nullptr, dice);
      const auto forget = [](std::vector<std::string>& all, std::size_t count)
      { all.erase(all.begin(), all.begin() + std::min(count, all.size())); };
      forget(last.Errors, plainly.Errors.size());
      forget(last.Warnings, plainly.Warnings.size());
    }
    const Differences differences = Compare(whole, pieces, alone, last);
    const std::string words = std::to_string(seed) + " " + std::to_string(number) +
      (trim > 0 ? " second trim: " : ": ") + meshWords + " | " + cut.Words + " |" + extra.Words +
      " | " + std::to_string(ranks) + " " + partition + (divide.WithGhosts ? " ghosts" : "") +
      (divide.WithIds ? " ids" : "") + (again ? " again" : "") + (bits32 ? " 32" : "") +
      (unusedPoints ? " unusedpoints" : "") + (permuted ? " permuted" : "") +
      (parted ? " parted" : "");
    if (tells)
    {
      Tell(words, alone);
    }
    Count({ "all", "mesh " + meshWords.substr(0, meshWords.find(' ')),
            "ranks " + std::to_string(ranks), "partition " + partition,
            trim > 0  ? "second trims"
              : again ? "only the surface changed"
                      : "first trims",
            divide.WithGhosts  ? "with ghosts"
              : divide.WithIds ? "with ids"
                               : "by places" },
      alone, differences);
    for (const auto& difference : differences)
    {
      std::printf("DIFFERENT %s: %s: %s\n", words.c_str(), difference.first.c_str(),
        difference.second.c_str());
    }
    std::fflush(stdout);
    if (!differences.empty() || !alone.Errors.empty() || alone.Trimmed[0]->GetNumberOfCells() == 0)
    {
      return;
    }
    whole = alone.Trimmed[0];
    pieces = parts.Trimmed;
    MarkAnew(whole, pieces);
  }
}

int PrintTable()
{
  std::printf("%-30s %6s %9s %7s %7s %8s %8s %7s\n", "", "trims", "different", "errors", "warned",
    "rescued", "offcuts", "layers");
  for (const auto& [key, tally] : Table)
  {
    std::printf("%-30s %6d %9d %7d %7d %8d %8d %7d\n", key.c_str(), tally.Trims, tally.Different,
      tally.Errors, tally.Warned, tally.Rescued, tally.Offcuts, tally.Layers);
  }
  for (const auto& [kind, count] : Kinds)
  {
    std::printf("difference: %-30s %d\n", kind.c_str(), count);
  }
  return Table["all"].Different;
}
}

int main(int argc, char* argv[])
{
  const int count = argc > 1 ? std::atoi(argv[1]) : 60;
  const unsigned seed = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 1;
  const int only = argc > 3 ? std::atoi(argv[3]) : -1;
  const std::vector<std::string> given(argv + std::min(argc, 4), argv + argc);
  std::vector<std::string> names = AllMeshNames();
  names.insert(names.end(), { "zigzag", "fading-ridge", "section" });
  for (int i = 0; i < count; ++i)
  {
    if (only < 0 || i == only)
    {
      RunDraw(seed, i, given.empty() ? names : given, only >= 0);
    }
  }
  return PrintTable() > 0;
}
