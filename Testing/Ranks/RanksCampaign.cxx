/**
 * @file RanksCampaign.cxx
 * @brief Random trims of grids in pieces against the trim of the whole: mesh x surface x options x
 * partition.
 *
 * RanksCampaign [count [seed [only [meshes]]]]: `only` repeats one trim of the series alone, and
 * shows what the filter says of it, -1: all. "narrow" before the meshes, or alone: other cuts, see
 * NarrowCuts.h.
 */
#include "Draws.h"
#include "NarrowCuts.h"
#include "Partitions.h"
#include "Pieces.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkTrimHexahedralGrid.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <numeric>
#include <set>

using namespace judge;

namespace
{
using Grid = vtkSmartPointer<vtkUnstructuredGrid>;
using Grids = std::vector<Grid>;

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

/// What one trim of the series is, or two in a row.
struct Draw
{
  Mesh Given;
  std::string MeshWords;
  Cut First;
  Extra FirstOptions;
  int Ranks;
  std::string Partition;
  DivideOptions Divide;
  bool Again;     ///< after a run along another surface
  Surface Before; ///< that one
  bool Bits32;    ///< of most pieces
  int Trims;      ///< in a row
  bool UnusedPoints;
  bool Permuted;
  bool Parted; ///< the surface
};

/// What trims are drawn of.
struct Range
{
  std::vector<std::string> Meshes;
  bool Narrow = false;

  Cut DrawCut(Dice& dice, const Frame& box) const
  {
    return this->Narrow ? DrawNarrow(dice, box) : judge::DrawCut(dice, box);
  }
};

Draw DrawTrim(Dice& dice, const Range& range)
{
  Draw draw;
  bool needsIds = false;
  draw.Given = DrawMesh(dice, range.Meshes, draw.MeshWords, needsIds);
  const Frame& box = draw.Given.Box;
  draw.First = range.DrawCut(dice, box);
  draw.FirstOptions = DrawOptions(dice, box);
  if (!range.Narrow && !draw.Given.Sheet && dice.Chance(0.4))
  {
    Extra& extra = draw.FirstOptions;
    draw.First = DrawAslant(dice, box);
    extra.Options.InsertLayer = extra.Options.InsertLayer || dice.Chance(0.6);
    extra.Words += extra.Options.InsertLayer ? " layer" : "";
  }
  draw.Ranks = dice.Pick(std::vector<int>{ 2, 2, 3, 3, 4, 4, 5, 6 });
  draw.Partition = dice.Pick(RandomPartitions());
  draw.Divide = DivideOptions{ draw.Ranks, dice.Chance(0.12), needsIds || dice.Chance(0.2) };
  draw.Again = dice.Chance(0.25);
  draw.Before = MakeSurface("plane", box, DrawPlacement(dice, "plane"));
  draw.Bits32 = dice.Chance(0.2);
  draw.Trims = dice.Chance(0.25) ? 2 : 1;
  draw.UnusedPoints = !draw.Divide.WithGhosts && dice.Chance(0.08);
  draw.Permuted = dice.Chance(0.15);
  draw.Parted = dice.Chance(0.15);
  return draw;
}

std::string WordsOf(const Draw& draw, const Cut& cut, const Extra& extra)
{
  return draw.MeshWords + " | " + cut.Words + " |" + extra.Words + " | " +
    std::to_string(draw.Ranks) + " " + draw.Partition + (draw.Divide.WithGhosts ? " ghosts" : "") +
    (draw.Divide.WithIds ? " ids" : "") + (draw.Again ? " again" : "") +
    (draw.Bits32 ? " 32" : "") + (draw.UnusedPoints ? " unusedpoints" : "") +
    (draw.Permuted ? " permuted" : "") + (draw.Parted ? " parted" : "");
}

/// The rows of the table that a trim counts in.
std::vector<std::string> RowsOf(const Draw& draw, int trim)
{
  const std::string kind = trim > 0 ? "second trims"
    : draw.Again                    ? "only the surface changed"
                                    : "first trims";
  const std::string joined = draw.Divide.WithGhosts ? "with ghosts"
    : draw.Divide.WithIds                           ? "with ids"
                                                    : "by places";
  return { "all", "mesh " + draw.MeshWords.substr(0, draw.MeshWords.find(' ')),
    "ranks " + std::to_string(draw.Ranks), "partition " + draw.Partition, kind, joined };
}

Grid MakeWhole(const Draw& draw)
{
  Grid whole = WithWholeIds(draw.Given.Grid);
  if (draw.Divide.WithIds && !whole->GetPointData()->GetGlobalIds())
  {
    vtkNew<vtkIdTypeArray> ids;
    ids->DeepCopy(whole->GetPointData()->GetArray("WholePoint"));
    ids->SetName("Ids");
    whole->GetPointData()->SetGlobalIds(ids);
  }
  return whole;
}

Grids MakePieces(
  const Draw& draw, vtkUnstructuredGrid* whole, const PiecesOutcome& alone, Dice& dice)
{
  vtkDataArray* statuses = alone.Statuses[0]->GetCellData()->GetArray("ElementStatus");
  Grids pieces = DivideBy(whole,
    DrawPartition(draw.Partition, draw.Given, whole, statuses, draw.Ranks, dice), draw.Divide);
  for (Grid& piece : pieces)
  {
    piece = draw.UnusedPoints ? WithAllPoints(whole, piece) : piece;
    piece = draw.Permuted ? Permuted(piece, dice) : piece;
    if (draw.Bits32 && piece->GetNumberOfCells() > 0 && dice.Chance(0.7))
    {
      piece = Copy(piece);
      piece->GetCells()->ConvertTo32BitStorage();
    }
  }
  return pieces;
}

/// Without what the filter said of the run along the surface before, which is no matter.
PiecesOutcome Forget(const PiecesOutcome& parts, const PiecesOutcome& before)
{
  PiecesOutcome last = parts;
  const auto forget = [](std::vector<std::string>& all, std::size_t count)
  { all.erase(all.begin(), all.begin() + std::min(count, all.size())); };
  forget(last.Errors, before.Errors.size());
  forget(last.Warnings, before.Warnings.size());
  return last;
}

void Print(const std::string& words, const Differences& differences)
{
  for (const auto& difference : differences)
  {
    std::printf(
      "DIFFERENT %s: %s: %s\n", words.c_str(), difference.first.c_str(), difference.second.c_str());
  }
  std::fflush(stdout);
}

void RunDraw(unsigned seed, int number, const Range& range, bool tells)
{
  Dice dice(seed, number);
  const Draw draw = DrawTrim(dice, range);
  Cut cut = draw.First;
  Extra extra = draw.FirstOptions;
  Grid whole = MakeWhole(draw);
  Grids pieces;
  for (int trim = 0; trim < draw.Trims; ++trim)
  {
    if (trim > 0)
    {
      cut = range.DrawCut(dice, draw.Given.Box);
      extra = DrawOptions(dice, draw.Given.Box);
    }
    const PiecesOutcome alone = Run({ whole }, { cut.What.Data }, extra, nullptr, dice);
    if (trim == 0)
    {
      pieces = MakePieces(draw, whole, alone, dice);
    }
    const bool again = draw.Again && trim == 0;
    const PiecesOutcome parts =
      Run(pieces, GiveToRanks(cut.What.Data, draw.Ranks, draw.Parted, dice), extra,
        again ? draw.Before.Data.Get() : nullptr, dice);
    PiecesOutcome last = parts;
    if (again)
    {
      const Surfaces before = GiveToRanks(draw.Before.Data, draw.Ranks, false, dice);
      last = Forget(parts, Run(pieces, before, extra, nullptr, dice));
    }
    const Differences differences = Compare(whole, pieces, alone, last);
    const std::string words = std::to_string(seed) + " " + std::to_string(number) +
      (trim > 0 ? " second trim: " : ": ") + WordsOf(draw, cut, extra);
    if (tells)
    {
      Tell(words, alone);
    }
    Count(RowsOf(draw, trim), alone, differences);
    Print(words, differences);
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
  std::vector<std::string> given(argv + std::min(argc, 4), argv + argc);
  Range range;
  range.Narrow = !given.empty() && given.front() == "narrow";
  given.erase(given.begin(), given.begin() + (range.Narrow ? 1 : 0));
  range.Meshes = given.empty() ? AllMeshNames() : given;
  if (given.empty())
  {
    range.Meshes.insert(range.Meshes.end(), { "zigzag", "fading-ridge", "section" });
  }
  for (int i = 0; i < count; ++i)
  {
    if (only < 0 || i == only)
    {
      RunDraw(seed, i, range, only >= 0);
    }
  }
  return PrintTable() > 0;
}
