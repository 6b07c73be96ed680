/**
 * @file TestRanksBadInput.cxx
 * @brief What is wrong on one rank ends the trim on all: one error, empty outputs, nobody waits.
 */
#include "Draws.h"
#include "Pieces.h"
#include "SplineData.h"

#include <vtkCallbackCommand.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSphereSource.h>
#include <vtkTetra.h>
#include <vtkTrimHexahedralGrid.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cstdio>

using namespace judge;

namespace
{
using Grids = std::vector<vtkSmartPointer<vtkUnstructuredGrid>>;
using Surfaces = std::vector<vtkSmartPointer<vtkDataObject>>;
int Wrong = 0;

void Check(bool holds, const std::string& text)
{
  if (!holds)
  {
    std::printf("FAIL %s\n", text.c_str());
    ++Wrong;
  }
}

const Mesh& TheMesh()
{
  static const Mesh mesh = MakeMesh("sheet2");
  return mesh;
}

/// Fresh pieces, which a test may spoil.
Grids Pieces(int ranks = 3)
{
  Grids pieces = Divide(TheMesh(), WithWholeIds(TheMesh().Grid), "slabs", ranks);
  for (auto& piece : pieces)
  {
    vtkNew<vtkUnstructuredGrid> copy;
    copy->DeepCopy(piece);
    piece = copy;
  }
  return pieces;
}

Surfaces SurfacesOf(const std::vector<Surface>& list)
{
  Surfaces surfaces;
  for (const Surface& surface : list)
  {
    surfaces.push_back(surface.Data);
  }
  return surfaces;
}

Surfaces Planes(int ranks = 3)
{
  std::vector<Surface> planes;
  for (int i = 0; i < ranks; ++i)
  {
    planes.push_back(MakeSurface("plane", TheMesh().Box, Placement()));
  }
  return SurfacesOf(planes);
}

bool IsEmpty(const Grids& grids)
{
  for (const auto& grid : grids)
  {
    if (grid->GetNumberOfCells() > 0 || grid->GetNumberOfPoints() > 0)
    {
      return false;
    }
  }
  return true;
}

/// One error that holds these words, and nothing comes out anywhere.
void ExpectError(
  const std::string& what, const Grids& pieces, const Surfaces& surfaces, const std::string& words)
{
  const PiecesOutcome outcome = TrimPieces(pieces, surfaces, TrimOptions());
  Check(outcome.Errors.size() == 1,
    what + ": " + std::to_string(outcome.Errors.size()) + " errors instead of one");
  Check(!outcome.Errors.empty() && outcome.Errors[0].find(words) != std::string::npos,
    what + ": no \"" + words + "\" in: " + (outcome.Errors.empty() ? "" : outcome.Errors[0]));
  Check(IsEmpty(outcome.Trimmed) && IsEmpty(outcome.Statuses), what + ": outputs are not empty");
}

void TestBadGrids()
{
  auto pieces = Pieces();
  vtkNew<vtkTetra> tetra;
  pieces[1]->InsertNextCell(VTK_TETRA, tetra->GetPointIds());
  ExpectError("a tetrahedron on rank 1", pieces, Planes(), "Rank 1: Cell");

  pieces = Pieces();
  pieces[2]->GetPoints()->SetPoint(5, 0.0, std::numeric_limits<double>::quiet_NaN(), 0.0);
  ExpectError("a NaN on rank 2", pieces, Planes(), "Rank 2: Point 5");

  const auto nothing = vtkSmartPointer<vtkUnstructuredGrid>::New();
  ExpectError("empty pieces", { nothing, nothing, nothing }, Planes(), "has no cells");

  pieces = Pieces(1);
  ExpectError("the whole grid on each rank", { pieces[0], pieces[0], pieces[0] }, Planes(),
    "Several ranks have the same cell");

  // Files have them in other types than VTK's own, too.
  for (const int type : { VTK_ID_TYPE, VTK_INT, VTK_UNSIGNED_CHAR })
  {
    pieces = Pieces();
    for (auto& piece : pieces)
    {
      auto ids = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
      ids->SetName("Ids");
      for (vtkIdType i = 0; i < piece->GetNumberOfPoints(); ++i)
      {
        ids->InsertNextTuple1(static_cast<double>(i % 256));
      }
      piece->GetPointData()->SetGlobalIds(ids);
    }
    ExpectError("global ids that are not", pieces, Planes(), "stands for two places");
  }
}

/// A node of the border of rank 0 with another at the same place: which one is rank 1's?
void TestCoincidentNodes()
{
  auto pieces = Pieces(2);
  for (auto& piece : pieces)
  {
    piece->GetPointData()->SetActiveAttribute(-1, vtkDataSetAttributes::GLOBALIDS);
  }
  vtkUnstructuredGrid* grid = pieces[0];
  const vtkIdType points = grid->GetNumberOfPoints();
  vtkNew<vtkUnstructuredGrid> doubled;
  doubled->Allocate();
  vtkNew<vtkPoints> places;
  places->SetDataType(grid->GetPoints()->GetDataType());
  for (int copy = 0; copy < 2; ++copy)
  {
    for (vtkIdType i = 0; i < points; ++i)
    {
      places->InsertNextPoint(grid->GetPoint(i));
    }
    for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
    {
      vtkNew<vtkIdList> nodes;
      grid->GetCellPoints(c, nodes);
      for (vtkIdType i = 0; i < nodes->GetNumberOfIds(); ++i)
      {
        nodes->SetId(i, nodes->GetId(i) + copy * points);
      }
      doubled->InsertNextCell(grid->GetCellType(c), nodes);
    }
  }
  doubled->SetPoints(places);
  pieces[0] = doubled;
  ExpectError("nodes at one place", pieces, Planes(2), "Several nodes of one rank's piece");
}

void TestBadSurfaces()
{
  const auto nothing = vtkSmartPointer<vtkPolyData>::New();
  ExpectError("no surface", Pieces(), { nothing, nothing, nothing }, "surface is empty");

  auto surfaces = Planes();
  vtkNew<vtkSphereSource> sphere;
  sphere->Update();
  surfaces[1] = sphere->GetOutput();
  ExpectError("no NURBS on rank 1", Pieces(), surfaces, "Rank 1: ");

  const std::vector<Surface> ending(3, EndingPlane(TheMesh().Box, Placement()));
  ExpectError("a surface that ends", Pieces(), SurfacesOf(ending), "ends inside the grid");
}

/// The blocks from `begin` on, and nothing in place of the others.
vtkSmartPointer<vtkDataObject> SomeBlocks(vtkMultiBlockDataSet* all, unsigned begin, unsigned end)
{
  auto some = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  some->SetNumberOfBlocks(all->GetNumberOfBlocks());
  for (unsigned i = begin; i < end; ++i)
  {
    some->SetBlock(i, all->GetBlock(i));
  }
  return some;
}

/// A surface on one rank, or in parts on several, is as good as the whole on each.
void TestScatteredSurfaces()
{
  const auto nothing = vtkSmartPointer<vtkPolyData>::New();
  const auto planes = Planes();
  const auto shell = MakeSurface("roundrect", TheMesh().Box, Placement()).Data;
  auto* blocks = vtkMultiBlockDataSet::SafeDownCast(shell);
  const unsigned count = blocks->GetNumberOfBlocks();
  // The order of faces decides what is a matter of rounding: it is that of the blocks.
  const auto walls = MakeSurface("rectangle", TheMesh().Box, Placement()).Data;
  auto* four = vtkMultiBlockDataSet::SafeDownCast(walls);
  const std::pair<Surfaces, Surfaces> cases[] = {
    { planes, { nothing, planes[1], nothing } },
    { { shell, shell, shell },
      { SomeBlocks(blocks, 0, 3), SomeBlocks(blocks, 3, 4), SomeBlocks(blocks, 4, count) } },
    { { walls, walls, walls },
      { SomeBlocks(four, 2, 3), SomeBlocks(four, 3, 4), SomeBlocks(four, 0, 2) } },
  };
  for (const auto& item : cases)
  {
    const PiecesOutcome whole = TrimPieces(Pieces(), item.first, TrimOptions());
    const PiecesOutcome parts = TrimPieces(Pieces(), item.second, TrimOptions());
    Check(whole.Errors.empty() && parts.Errors.empty(), "scattered surface: errors");
    for (std::size_t i = 0; i < whole.Trimmed.size(); ++i)
    {
      const std::string difference = FirstDifference(whole.Trimmed[i], parts.Trimmed[i]);
      Check(difference.empty(), "scattered surface: " + difference);
    }
    Check(!IsEmpty(parts.Trimmed), "scattered surface: nothing comes out");
  }
}

/// Two sheets, one for each rank, and a wall across the first one that ends at an x.
struct SheetsAndWall
{
  Grids Pieces;
  Surfaces Walls;
};

SheetsAndWall WithWallTo(double end)
{
  const Mesh sheets = TwoSheets(8, 10, 2, 0.4, Vec3(9, 0, 0));
  const Vec3 first(sheets.Grid->GetPoint(0));
  const SplineSurface wall = Wall({ { -9.0, 4.3 }, { end, 4.3 } }, first);
  return { Divide(sheets, WithWholeIds(sheets.Grid), "slabs", 2),
    { ToPolyData(wall), ToPolyData(wall) } };
}

/// What ends in a part of the mesh that one rank has alone is an error of all.
void TestEndInOnePart()
{
  const SheetsAndWall given = WithWallTo(13.2);
  ExpectError(
    "a surface that ends in one rank's part", given.Pieces, given.Walls, "ends inside the grid");
}

/// One warning, which holds these words, and a result.
void ExpectWarning(
  const std::string& what, const Grids& pieces, const Surfaces& surfaces, const std::string& words)
{
  const PiecesOutcome outcome = TrimPieces(pieces, surfaces, TrimOptions());
  Check(outcome.Errors.empty() && !IsEmpty(outcome.Trimmed), what + ": an error");
  Check(outcome.Warnings.size() == 1 && outcome.Warnings[0].find(words) != std::string::npos,
    what + ": not one warning with \"" + words + "\" but " +
      std::to_string(outcome.Warnings.size()) +
      (outcome.Warnings.empty() ? "" : ": " + outcome.Warnings[0]));
}

/// What one rank alone sees amiss is told of once, by the first.
void TestRemarks()
{
  auto pieces = Pieces();
  vtkNew<vtkUnsignedCharArray> flags;
  flags->SetName(vtkDataSetAttributes::GhostArrayName());
  flags->SetNumberOfValues(pieces[1]->GetNumberOfCells());
  flags->FillValue(0);
  flags->SetValue(0, vtkDataSetAttributes::HIDDENCELL);
  flags->SetValue(1, vtkDataSetAttributes::HIDDENCELL);
  pieces[1]->GetCellData()->AddArray(flags);
  ExpectWarning("hidden cells on rank 1", pieces, Planes(), "): 2 cells of the grid are flagged");

  pieces = Divide(TheMesh(), WithWholeIds(TheMesh().Grid), "ids", 3);
  Check(pieces[2]->GetPointData()->GetGlobalIds() != nullptr, "no ids to take away");
  pieces[2]->GetPointData()->SetActiveAttribute(-1, vtkDataSetAttributes::GLOBALIDS);
  ExpectWarning("no global ids on rank 2", pieces, Planes(), "others have none");

  const SheetsAndWall given = WithWallTo(8.5);
  ExpectWarning("a part beside the end on rank 1", given.Pieces, given.Walls,
    "): 1 part of the grid lies beyond the end");

  // Copies of what other ranks have are nothing to tell of.
  const PiecesOutcome copies =
    TrimPieces(Divide(TheMesh(), WithWholeIds(TheMesh().Grid), "ghosts", 3), Planes(), {});
  Check(copies.Errors.empty() && copies.Warnings.empty(), "ghost cells are told of");

  pieces = Pieces();
  vtkNew<vtkFloatArray> more;
  more->SetName("More");
  more->SetNumberOfValues(pieces[1]->GetNumberOfCells() + 1);
  more->FillValue(0);
  pieces[1]->GetCellData()->AddArray(more);
  ExpectWarning("a longer array on rank 1", pieces, Planes(), "more tuples than it has");

  const Surfaces planes = Planes();
  vtkNew<vtkPolyData> moved;
  moved->DeepCopy(planes[1]);
  MovePoints(moved, [](const Vec3& p) { return Vec3(p[0] + 1.0, p[1], p[2]); });
  ExpectWarning("moved polygons on rank 1", Pieces(), { planes[0], moved, planes[2] },
    "polygons of the trimming surface do not lie on it");

  // Numbers of cells are those of one piece: of several none is named.
  pieces = Pieces();
  for (auto& piece : pieces)
  {
    FoldElements(piece);
  }
  Placement onFirst;
  onFirst.X = -0.8;
  const std::vector<Surface> cuts(3, MakeSurface("plane", TheMesh().Box, onFirst));
  const PiecesOutcome folded = TrimPieces(pieces, SurfacesOf(cuts), TrimOptions());
  const auto told = std::find_if(folded.Warnings.begin(), folded.Warnings.end(),
    [](const std::string& text) { return text.find("were inside out") != std::string::npos; });
  Check(told != folded.Warnings.end() && told->find("(cell") == std::string::npos,
    "a folded mesh: a cell is named, or no word of it");

  // Numbers that are not whole are no ids: nodes are known by their places.
  pieces = Pieces();
  for (auto& piece : pieces)
  {
    vtkNew<vtkFloatArray> numbers;
    numbers->SetName("Numbers");
    for (vtkIdType i = 0; i < piece->GetNumberOfPoints(); ++i)
    {
      numbers->InsertNextValue(0.001f * static_cast<float>(i));
    }
    vtkPointData* const data = piece->GetPointData();
    data->SetActiveAttribute(data->AddArray(numbers), vtkDataSetAttributes::GLOBALIDS);
    Check(data->GetGlobalIds() == numbers, "the numbers are no ids");
  }
  const PiecesOutcome outcome = TrimPieces(pieces, Planes(), TrimOptions());
  Check(outcome.Errors.empty() && outcome.Warnings.empty(), "ids that are no whole numbers");
}

/// Hexahedra that are wedges are told of once each, however many ranks have copies of them.
void TestCopiesOfWedges()
{
  Dice dice(1, 1);
  const Mesh mesh = WithOddCells(SheetWithWedges(8, 6, 2), 0.0, true, dice);
  const auto whole = WithWholeIds(mesh.Grid);
  const std::vector<Surface> planes(3, MakeSurface("plane", mesh.Box, Placement()));
  const PiecesOutcome alone = TrimPieces({ whole }, { planes[0].Data }, TrimOptions());
  Check(alone.Warnings.size() == 1 &&
      alone.Warnings[0].find("two pairs of corners in one node") != std::string::npos,
    "wedges as hexahedra: not one warning of them");
  const PiecesOutcome parts =
    TrimPieces(Divide(mesh, whole, "ghosts", 3), SurfacesOf(planes), TrimOptions());
  Check(parts.Errors.empty(), "copies of wedges as hexahedra: errors");
  const std::string difference = DifferenceOfTexts(alone.Warnings, parts.Warnings);
  Check(difference.empty(), "copies of wedges as hexahedra: " + difference);
}

/// Options that differ from rank to rank, as a script may set them, are an error of all: nobody
/// waits, and no rank trims in its own way.
void TestOptionsApart()
{
  using Setter = void (*)(vtkTrimHexahedralGrid*);
  const std::pair<const char*, Setter> cases[] = {
    { "values of CorrectionType", [](vtkTrimHexahedralGrid* f) { f->SetCorrectionType(3); } },
    { "CorrectionType is 7", [](vtkTrimHexahedralGrid* f) { f->SetCorrectionType(7); } },
    { "values of InvertSide", [](vtkTrimHexahedralGrid* f) { f->SetInvertSide(true); } },
    { "values of KeepPoint", [](vtkTrimHexahedralGrid* f) { f->SetKeepPoint(1, 2, 3); } },
    { "values of ProduceOffcut", [](vtkTrimHexahedralGrid* f) { f->SetProduceOffcut(true); } },
    { "values of MapValues", [](vtkTrimHexahedralGrid* f) { f->SetMapValues(true); } },
    { "values of Tolerance", [](vtkTrimHexahedralGrid* f) { f->SetTolerance(1e-4); } },
  };
  for (const auto& [words, set] : cases)
  {
    const PiecesOutcome outcome = TrimPieces(Pieces(), Planes(), TrimOptions(),
      [set = set](int rank, vtkTrimHexahedralGrid* filter)
      {
        filter->SetUseKeepPoint(true);
        if (rank == 1)
        {
          set(filter);
        }
      });
    Check(outcome.Errors.size() == 1 && outcome.Errors[0].find(words) != std::string::npos &&
        IsEmpty(outcome.Trimmed) && IsEmpty(outcome.Statuses),
      std::string("options of ranks: not one error with \"") + words + '"');
  }
}

/// Points on a rank that has no cells, as some programs write them, are no matter: neither what
/// they are stored as, nor that they have no ids.
void TestLonePoints()
{
  const Mesh slit = TwoSheets(8, 10, 2, 0.4, Vec3(8, 0, 0));
  const auto whole = WithWholeIds(slit.Grid);
  vtkNew<vtkIdTypeArray> ids;
  ids->DeepCopy(whole->GetPointData()->GetArray("WholePoint"));
  ids->SetName("Ids");
  whole->GetPointData()->SetGlobalIds(ids);
  Placement at;
  at.Angle = 1.2;
  const auto plane = MakeSurface("plane", slit.Box, at).Data;
  const PiecesOutcome alone = TrimPieces({ whole }, { plane }, TrimOptions());
  Grids pieces = Divide(slit, whole, "ids", 2);
  auto points = vtkSmartPointer<vtkUnstructuredGrid>::New();
  vtkNew<vtkPoints> places; // of single precision
  places->InsertNextPoint(100, 2, 0);
  points->SetPoints(places);
  pieces.push_back(points);
  const PiecesOutcome parts = TrimPieces(pieces, { plane, plane, plane }, TrimOptions());
  Check(alone.Errors.empty() && parts.Errors.empty(), "points alone on rank 2: an error");
  const std::string difference = DifferenceFromWhole(alone.Trimmed[0], parts.Trimmed) +
    DifferenceFromWhole(alone.Statuses[0], parts.Statuses) +
    DifferenceOfTexts(alone.Warnings, parts.Warnings);
  Check(difference.empty(), "points alone on rank 2: " + difference);
}

/// Sheets that lie in one another, with elements at the same places: with global ids of their nodes
/// they are trimmed on several ranks, as on one. Without, a rank may have another's elements once
/// more.
void TestOverlap()
{
  const Mesh sheets = TwoSheets(10, 10, 2, 0.4, Vec3(4, 0, 0));
  const auto whole = WithWholeIds(sheets.Grid);
  vtkNew<vtkIdTypeArray> ids;
  ids->DeepCopy(whole->GetPointData()->GetArray("WholePoint"));
  ids->SetName("Ids");
  whole->GetPointData()->SetGlobalIds(ids);
  const auto plane = PlaneThrough(Vec3(7.2, 5, 0), Vec3(1, 0.2, 0), 800).Data;
  const PiecesOutcome alone = TrimPieces({ whole }, { plane }, TrimOptions());
  const auto rankOf = [&whole](bool bySheet)
  {
    std::vector<int> ranks;
    const vtkIdType count = whole->GetNumberOfCells();
    for (vtkIdType c = 0; c < count; ++c)
    {
      ranks.push_back(bySheet ? (2 * c < count ? 0 : 1) : static_cast<int>(c % 2));
    }
    return ranks;
  };
  for (const bool bySheet : { true, false })
  {
    const Grids pieces = DivideBy(whole, rankOf(bySheet), { 2, false, true });
    const PiecesOutcome parts = TrimPieces(pieces, { plane, plane }, TrimOptions());
    const std::string difference = DifferenceOfTexts(alone.Errors, parts.Errors) +
      DifferenceOfTexts(alone.Warnings, parts.Warnings) +
      DifferenceFromWhole(alone.Trimmed[0], parts.Trimmed);
    Check(difference.empty() && !IsEmpty(alone.Trimmed), "overlap: " + difference);
  }
  ExpectError("overlap without ids", DivideBy(whole, rankOf(true), { 2, false, false }),
    { plane, plane }, "Several ranks have the same cell");
}

/// Arrays that flag no ghosts, as one of several pieces may have them, are in no output: those of
/// the other pieces are not either.
void TestFlagsOfNothing()
{
  auto pieces = Pieces();
  vtkNew<vtkUnsignedCharArray> flags;
  flags->SetName(vtkDataSetAttributes::GhostArrayName());
  flags->SetNumberOfValues(pieces[1]->GetNumberOfCells());
  flags->FillValue(0);
  pieces[1]->GetCellData()->AddArray(flags);
  const PiecesOutcome outcome = TrimPieces(pieces, Planes(), TrimOptions());
  Check(outcome.Errors.empty() && !IsEmpty(outcome.Trimmed), "flags of nothing: an error");
  for (const auto& output : { outcome.Trimmed[1], outcome.Statuses[1] })
  {
    Check(!output->GetCellData()->HasArray(flags->GetName()), "flags of nothing are in an output");
  }
}

void TestMissingSurface()
{
  Placement outside;
  outside.X = 3.0;
  const std::vector<Surface> away(3, MakeSurface("plane", TheMesh().Box, outside));
  const PiecesOutcome outcome = TrimPieces(Pieces(), SurfacesOf(away), TrimOptions());
  Check(outcome.Errors.empty() && outcome.Warnings.size() == 1 &&
      outcome.Warnings[0].find("misses the grid") != std::string::npos,
    "a surface that misses the grid: not one warning");
}

struct Stop
{
  double At;
  int Rank;
};

/// Aborts one rank's filter once it has got so far.
void AbortAt(vtkObject* caller, unsigned long, void* client, void* progress)
{
  if (*static_cast<double*>(progress) >= static_cast<Stop*>(client)->At)
  {
    vtkTrimHexahedralGrid::SafeDownCast(caller)->SetAbortExecute(1);
  }
}

/// Has a filter stopped, if it is on that rank.
FilterAction StopAt(Stop& stop)
{
  return [&stop](int rank, vtkTrimHexahedralGrid* filter)
  {
    vtkNew<vtkCallbackCommand> observer;
    observer->SetCallback(AbortAt);
    observer->SetClientData(&stop);
    if (rank == stop.Rank)
    {
      filter->AddObserver(vtkCommand::ProgressEvent, observer);
    }
  };
}

void TestAborts()
{
  const PiecesOutcome whole = TrimPieces(Pieces(), Planes(), TrimOptions());
  for (Stop stop :
    { Stop{ 0.05, 1 }, Stop{ 0.3, 0 }, Stop{ 0.4, 2 }, Stop{ 0.6, 1 }, Stop{ 0.9, 0 } })
  {
    const std::string what =
      "rank " + std::to_string(stop.Rank) + " stopped at " + std::to_string(stop.At);
    const PiecesOutcome outcome = TrimPieces(Pieces(), Planes(), TrimOptions(), StopAt(stop));
    Check(IsEmpty(outcome.Trimmed) && IsEmpty(outcome.Statuses), what + ": not empty");
    Check(outcome.Errors.empty(), what + ": errors");

    // At the next update all run again, not that rank alone, which would wait for ever.
    const PiecesOutcome again = TrimPieces(Pieces(), Planes(), TrimOptions(), StopAt(stop),
      [&stop](int rank, vtkTrimHexahedralGrid* filter)
      {
        if (rank == stop.Rank)
        {
          filter->RemoveObservers(vtkCommand::ProgressEvent);
          filter->SetAbortExecute(0);
        }
      });
    for (std::size_t i = 0; i < whole.Trimmed.size(); ++i)
    {
      const std::string difference = FirstDifference(whole.Trimmed[i], again.Trimmed[i]);
      Check(difference.empty(), what + " and run again: " + difference);
    }
  }
}

/// An array that one rank's piece does not have, or has as another type or with other components,
/// is no matter for the rest.
void TestPartialArrays()
{
  for (const int components : { 0, 1, 2 })
  {
    const auto pieces = Pieces();
    constexpr int odd = 1; // the cut goes through its piece
    vtkPointData* data = pieces[odd]->GetPointData();
    std::string name;
    for (int i = 0; i < data->GetNumberOfArrays() && name.empty(); ++i)
    {
      if (data->GetArray(i) && data->GetArray(i)->GetDataType() == VTK_DOUBLE)
      {
        name = data->GetArrayName(i);
      }
    }
    Check(!name.empty(), "no array to take away");
    data->RemoveArray(name.c_str());
    if (components > 0)
    {
      auto other = vtkSmartPointer<vtkDataArray>::Take(
        vtkDataArray::CreateDataArray(components == 1 ? VTK_ID_TYPE : VTK_DOUBLE));
      other->SetName(name.c_str());
      other->SetNumberOfComponents(components);
      other->SetNumberOfTuples(pieces[odd]->GetNumberOfPoints());
      other->Fill(3);
      data->AddArray(other);
    }
    TrimOptions options;
    options.MapValues = true;
    const PiecesOutcome outcome = TrimPieces(pieces, Planes(), options);
    Check(outcome.Errors.empty(), "an array on two ranks of three: errors");
    vtkDataArray* const own = outcome.Trimmed[odd]->GetPointData()->GetArray(name.c_str());
    Check((own != nullptr) == (components > 0) &&
        outcome.Trimmed[2]->GetPointData()->GetArray(name.c_str()) != nullptr,
      "an array on two ranks of three: not where it was");
    for (vtkIdType i = 0; own && i < own->GetNumberOfTuples(); ++i)
    {
      Check(own->GetNumberOfComponents() == components && own->GetComponent(i, 0) == 3,
        "an array of another kind on one rank: it is not what it was");
    }
  }
}

/// What was far off on one rank is forgotten by the others when it is mended.
void TestMended()
{
  const auto pieces = Pieces();
  double place[3];
  pieces[1]->GetPoint(0, place);
  pieces[1]->GetPoints()->SetPoint(0, 1e200, 0.0, 0.0);
  const PiecesOutcome outcome = TrimPieces(pieces, Planes(), TrimOptions(), {},
    [&](int rank, vtkTrimHexahedralGrid* filter)
    {
      filter->Modified();
      if (rank == 1)
      {
        pieces[1]->GetPoints()->SetPoint(0, place);
        pieces[1]->GetPoints()->Modified();
      }
    });
  Check(outcome.Errors.size() == 1 && !IsEmpty(outcome.Trimmed),
    "mended: " + std::to_string(outcome.Errors.size()) + " errors, not the first one alone");
}

/// Kept from run to run, and made anew on all ranks when one rank's piece or surface changes.
void TestRerun(int port)
{
  const auto pieces = Pieces();
  const auto surfaces = Planes();
  const PiecesOutcome first = TrimPieces(pieces, surfaces, TrimOptions());
  TrimOptions inverted;
  inverted.InvertSide = true;
  int run = 0;
  const PiecesOutcome again = TrimPieces(pieces, surfaces, inverted, {},
    [&run, port](int rank, vtkTrimHexahedralGrid* filter)
    {
      filter->SetInvertSide(false);
      if (rank == 1)
      {
        filter->GetInputDataObject(port, 0)->Modified();
        ++run;
      }
    });
  Check(run == 1, "the second run did not happen");
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    const std::string difference = FirstDifference(first.Trimmed[i], again.Trimmed[i]);
    Check(difference.empty(), "rerun on rank " + std::to_string(i) + ": " + difference);
  }
}
}

int main()
{
  TestBadGrids();
  TestCoincidentNodes();
  TestBadSurfaces();
  TestScatteredSurfaces();
  TestOptionsApart();
  TestLonePoints();
  TestFlagsOfNothing();
  TestOverlap();
  TestMissingSurface();
  TestAborts();
  TestRerun(0);
  TestRerun(1);
  TestMended();
  TestRemarks();
  TestCopiesOfWedges();
  TestEndInOnePart();
  TestPartialArrays();
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
