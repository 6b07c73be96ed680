#include "Pieces.h"

#include "ThreadRanks.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkExtractCells.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkTrimHexahedralGrid.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <stdexcept>

namespace judge
{
namespace
{
constexpr const char* WholeCell = "WholeCell";
constexpr const char* WholePoint = "WholePoint";

vtkSmartPointer<vtkIdTypeArray> Count(const char* name, vtkIdType count)
{
  auto ids = vtkSmartPointer<vtkIdTypeArray>::New();
  ids->SetName(name);
  ids->SetNumberOfValues(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    ids->SetValue(i, i);
  }
  return ids;
}

}

Vec3 CentreOf(vtkUnstructuredGrid* grid, vtkIdType cell)
{
  vtkNew<vtkIdList> nodes;
  grid->GetCellPoints(cell, nodes);
  Vec3 sum = Vec3::Zero();
  for (vtkIdType i = 0; i < nodes->GetNumberOfIds(); ++i)
  {
    double p[3];
    grid->GetPoint(nodes->GetId(i), p);
    sum += Vec3(p[0], p[1], p[2]);
  }
  return sum / nodes->GetNumberOfIds();
}

namespace
{
/// Rank of each cell by its place along an axis of the mesh, in slabs of equal numbers.
std::vector<int> Slabs(vtkUnstructuredGrid* whole, const Vec3& axis, int first, int ranks)
{
  const vtkIdType count = whole->GetNumberOfCells();
  std::vector<std::pair<double, vtkIdType>> places;
  for (vtkIdType c = 0; c < count; ++c)
  {
    places.emplace_back(std::round(1e6 * CentreOf(whole, c).dot(axis)), c);
  }
  std::sort(places.begin(), places.end());
  std::vector<int> rank(count);
  for (vtkIdType i = 0; i < count; ++i)
  {
    rank[places[i].second] = first + static_cast<int>(i * (ranks - first) / count);
  }
  return rank;
}

std::vector<int> RankOfCells(
  const Mesh& mesh, vtkUnstructuredGrid* whole, const std::string& partition, int ranks)
{
  if (partition == "slabs" || partition == "ghosts")
  {
    return Slabs(whole, mesh.Box.Axes.col(0), 0, ranks);
  }
  if (partition == "empty")
  {
    return Slabs(whole, mesh.Box.Axes.col(0), ranks > 1 ? 1 : 0, ranks);
  }
  if (partition == "layers")
  {
    return Slabs(whole, mesh.Box.Axes.col(2), 0, ranks);
  }
  if (partition != "scattered" && partition != "ids")
  {
    throw std::invalid_argument("no partition " + partition);
  }
  std::mt19937 random(7);
  std::vector<int> rank(whole->GetNumberOfCells());
  for (int& r : rank)
  {
    r = static_cast<int>(random() % ranks);
  }
  return rank;
}

vtkSmartPointer<vtkUnstructuredGrid> Extract(
  vtkUnstructuredGrid* whole, const std::vector<vtkIdType>& cells)
{
  if (cells.empty())
  {
    return vtkSmartPointer<vtkUnstructuredGrid>::New();
  }
  vtkNew<vtkIdList> ids;
  for (const vtkIdType c : cells)
  {
    ids->InsertNextId(c);
  }
  vtkNew<vtkExtractCells> extract;
  extract->SetInputData(whole);
  extract->SetCellList(ids);
  extract->Update();
  vtkSmartPointer<vtkUnstructuredGrid> piece = extract->GetOutput();
  piece->GetCellData()->RemoveArray("vtkOriginalCellIds");
  return piece;
}

/// The cells of one rank and, as ghosts, those of others that share a node with them.
vtkSmartPointer<vtkUnstructuredGrid> ExtractWithGhosts(
  vtkUnstructuredGrid* whole, const std::vector<int>& rankOf, int rank)
{
  std::set<vtkIdType> nodes;
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < whole->GetNumberOfCells(); ++c)
  {
    whole->GetCellPoints(c, ids);
    for (vtkIdType i = 0; rankOf[c] == rank && i < ids->GetNumberOfIds(); ++i)
    {
      nodes.insert(ids->GetId(i));
    }
  }
  std::vector<vtkIdType> cells;
  vtkNew<vtkUnsignedCharArray> ghosts;
  ghosts->SetName(vtkDataSetAttributes::GhostArrayName());
  for (vtkIdType c = 0; c < whole->GetNumberOfCells(); ++c)
  {
    whole->GetCellPoints(c, ids);
    bool near = false;
    for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
    {
      near |= nodes.count(ids->GetId(i)) > 0;
    }
    if (near)
    {
      cells.push_back(c);
      ghosts->InsertNextValue(rankOf[c] == rank ? 0 : vtkDataSetAttributes::DUPLICATECELL);
    }
  }
  auto piece = Extract(whole, cells);
  piece->GetCellData()->AddArray(ghosts);
  return piece;
}

bool SameTuple(vtkAbstractArray* a, vtkIdType i, vtkAbstractArray* b, vtkIdType j)
{
  const int components = a->GetNumberOfComponents();
  auto* x = vtkDataArray::SafeDownCast(a);
  auto* y = vtkDataArray::SafeDownCast(b);
  for (int k = 0; k < components; ++k)
  {
    if (x && y)
    {
      const double u = x->GetComponent(i, k);
      const double v = y->GetComponent(j, k);
      if (std::memcmp(&u, &v, sizeof(double)) != 0)
      {
        return false;
      }
    }
    else if (a->GetVariantValue(i * components + k) != b->GetVariantValue(j * components + k))
    {
      return false;
    }
  }
  return true;
}

bool IsLocal(const std::string& name)
{
  return name == "vtkOriginalPointIds" || name == "vtkOriginalCellIds";
}

std::string CompareTuples(
  vtkDataSetAttributes* whole, vtkIdType i, vtkDataSetAttributes* piece, vtkIdType j)
{
  for (int k = 0; k < whole->GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray* expected = whole->GetAbstractArray(k);
    const std::string name = expected->GetName();
    vtkAbstractArray* found = piece->GetAbstractArray(name.c_str());
    if (!found)
    {
      return "no array " + name;
    }
    if (!IsLocal(name) && !SameTuple(expected, i, found, j))
    {
      return name + " differs";
    }
  }
  return {};
}

/// One piece against the whole; counts its cells and collects its points.
class PieceComparison
{
public:
  PieceComparison(vtkUnstructuredGrid* whole)
    : Whole(whole)
    , Cells(PartsOf(whole))
    , Points(PlacesOf(KeysOf(whole)))
  {
  }

  std::string Compare(vtkUnstructuredGrid* piece)
  {
    auto* cellIds = vtkIdTypeArray::SafeDownCast(piece->GetCellData()->GetArray(WholeCell));
    const std::vector<vtkIdType> keys = KeysOf(piece);
    for (vtkIdType i = 0; i < piece->GetNumberOfPoints(); ++i)
    {
      const std::string difference = this->ComparePoint(piece, i, keys[i]);
      if (!difference.empty())
      {
        return "point " + std::to_string(keys[i] / 2) + ": " + difference;
      }
    }
    std::map<vtkIdType, std::size_t> parts;
    for (vtkIdType i = 0; i < piece->GetNumberOfCells(); ++i)
    {
      const vtkIdType id = cellIds->GetValue(i);
      const std::string difference = this->CompareCell(piece, i, id, parts[id]++, keys);
      if (!difference.empty())
      {
        return "cell " + std::to_string(id) + ": " + difference;
      }
    }
    return {};
  }

  std::string CompareCounts() const
  {
    const auto cells = static_cast<vtkIdType>(this->CellsSeen.size());
    const auto points = static_cast<vtkIdType>(this->PointsSeen.size());
    if (cells != this->Whole->GetNumberOfCells() || points != this->Whole->GetNumberOfPoints())
    {
      return std::to_string(cells) + " cells and " + std::to_string(points) +
        " points instead of " + std::to_string(this->Whole->GetNumberOfCells()) + " and " +
        std::to_string(this->Whole->GetNumberOfPoints());
    }
    return {};
  }

private:
  /// Of each point: its id in the input and whether it was inserted, as one number.
  static std::vector<vtkIdType> KeysOf(vtkUnstructuredGrid* grid)
  {
    auto* ids = vtkIdTypeArray::SafeDownCast(grid->GetPointData()->GetArray(WholePoint));
    vtkDataArray* inserted = grid->GetPointData()->GetArray("Inserted");
    std::vector<vtkIdType> keys;
    for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
    {
      keys.push_back(2 * ids->GetValue(i) + (inserted && inserted->GetComponent(i, 0) > 0));
    }
    return keys;
  }

  static std::vector<vtkIdType> PlacesOf(const std::vector<vtkIdType>& keys)
  {
    std::vector<vtkIdType> places;
    for (std::size_t i = 0; i < keys.size(); ++i)
    {
      places.resize(std::max(places.size(), static_cast<std::size_t>(keys[i]) + 1), -1);
      places[keys[i]] = static_cast<vtkIdType>(i);
    }
    return places;
  }

  std::string ComparePoint(vtkUnstructuredGrid* piece, vtkIdType i, vtkIdType key)
  {
    if (key >= static_cast<vtkIdType>(this->Points.size()) || this->Points[key] < 0)
    {
      return "the whole does not have it";
    }
    this->PointsSeen.insert(key);
    double p[3], q[3];
    piece->GetPoint(i, p);
    this->Whole->GetPoint(this->Points[key], q);
    if (std::memcmp(p, q, sizeof(p)) != 0)
    {
      return "another place";
    }
    return CompareTuples(this->Whole->GetPointData(), this->Points[key], piece->GetPointData(), i);
  }

  /// Each cell of the whole, by its id in the input; in an offcut there may be two parts of one.
  static std::map<vtkIdType, std::vector<vtkIdType>> PartsOf(vtkUnstructuredGrid* whole)
  {
    std::map<vtkIdType, std::vector<vtkIdType>> parts;
    auto* ids = vtkIdTypeArray::SafeDownCast(whole->GetCellData()->GetArray(WholeCell));
    for (vtkIdType i = 0; i < whole->GetNumberOfCells(); ++i)
    {
      parts[ids->GetValue(i)].push_back(i);
    }
    return parts;
  }

  std::string CompareCell(vtkUnstructuredGrid* piece, vtkIdType i, vtkIdType id, std::size_t part,
    const std::vector<vtkIdType>& keys)
  {
    const auto parts = this->Cells.find(id);
    if (parts == this->Cells.end() || part >= parts->second.size())
    {
      return "the whole does not have it";
    }
    const vtkIdType place = parts->second[part];
    if (!this->CellsSeen.insert(place).second)
    {
      return "it is there twice";
    }
    vtkNew<vtkIdList> nodes, expected;
    piece->GetCellPoints(i, nodes);
    this->Whole->GetCellPoints(place, expected);
    if (piece->GetCellType(i) != this->Whole->GetCellType(place))
    {
      return "another type";
    }
    for (vtkIdType k = 0; k < nodes->GetNumberOfIds(); ++k)
    {
      if (this->Points[keys[nodes->GetId(k)]] != expected->GetId(k))
      {
        return "other nodes";
      }
    }
    return CompareTuples(this->Whole->GetCellData(), place, piece->GetCellData(), i);
  }

  vtkUnstructuredGrid* Whole;
  std::map<vtkIdType, std::vector<vtkIdType>> Cells;
  std::vector<vtkIdType> Points;
  std::set<vtkIdType> CellsSeen, PointsSeen;
};

/// Whether ids name the items of a piece that those of a result came from, by their ids in the
/// whole.
bool NameOrigins(vtkDataSetAttributes* piece, vtkDataSetAttributes* result, const char* original,
  const char* inWhole)
{
  auto* ids = vtkIdTypeArray::SafeDownCast(result->GetAbstractArray(original));
  auto* found = vtkIdTypeArray::SafeDownCast(result->GetAbstractArray(inWhole));
  auto* expected = vtkIdTypeArray::SafeDownCast(piece->GetAbstractArray(inWhole));
  if (!ids || !found || !expected)
  {
    return !found || found->GetNumberOfValues() == 0;
  }
  for (vtkIdType i = 0; i < found->GetNumberOfValues(); ++i)
  {
    const vtkIdType id = ids->GetValue(i);
    if (id < 0 || id >= expected->GetNumberOfValues() ||
      expected->GetValue(id) != found->GetValue(i))
    {
      return false;
    }
  }
  return true;
}
}

vtkSmartPointer<vtkUnstructuredGrid> WithWholeIds(vtkUnstructuredGrid* grid)
{
  auto whole = vtkSmartPointer<vtkUnstructuredGrid>::New();
  whole->ShallowCopy(grid);
  whole->GetPointData()->AddArray(Count(WholePoint, grid->GetNumberOfPoints()));
  whole->GetCellData()->AddArray(Count(WholeCell, grid->GetNumberOfCells()));
  return whole;
}

std::vector<std::string> PartitionNames()
{
  return { "slabs", "scattered", "layers", "empty", "ghosts", "ids" };
}

std::vector<vtkSmartPointer<vtkUnstructuredGrid>> DivideBy(
  vtkUnstructuredGrid* whole, const std::vector<int>& rankOf, const DivideOptions& options)
{
  vtkNew<vtkUnstructuredGrid> source;
  source->ShallowCopy(whole);
  if (!options.WithIds)
  {
    source->GetPointData()->SetActiveAttribute(-1, vtkDataSetAttributes::GLOBALIDS);
  }
  std::vector<vtkSmartPointer<vtkUnstructuredGrid>> pieces;
  for (int rank = 0; rank < options.Ranks; ++rank)
  {
    std::vector<vtkIdType> cells;
    for (vtkIdType c = 0; c < whole->GetNumberOfCells(); ++c)
    {
      if (rankOf[c] == rank)
      {
        cells.push_back(c);
      }
    }
    pieces.push_back(
      options.WithGhosts ? ExtractWithGhosts(source, rankOf, rank) : Extract(source, cells));
  }
  return pieces;
}

std::vector<vtkSmartPointer<vtkUnstructuredGrid>> Divide(
  const Mesh& mesh, vtkUnstructuredGrid* whole, const std::string& partition, int ranks)
{
  return DivideBy(whole, RankOfCells(mesh, whole, partition, ranks),
    { ranks, partition == "ghosts", partition == "ids" });
}

namespace
{
/// What several ranks are given alike each has for itself: VTK's data objects are not to be read by
/// several threads at once, and ranks share no memory.
template <typename Data>
std::vector<vtkSmartPointer<Data>> ForEachRank(const std::vector<vtkSmartPointer<Data>>& given)
{
  std::vector<vtkSmartPointer<Data>> own;
  for (auto data = given.begin(); data != given.end(); ++data)
  {
    own.push_back(*data);
    if (std::find(given.begin(), data, *data) != data)
    {
      own.back().TakeReference((*data)->NewInstance());
      own.back()->DeepCopy(*data);
    }
  }
  return own;
}
}

PiecesOutcome TrimPieces(const std::vector<vtkSmartPointer<vtkUnstructuredGrid>>& pieces,
  const std::vector<vtkSmartPointer<vtkDataObject>>& surfaces, const TrimOptions& options,
  const FilterAction& before, const FilterAction& again)
{
  const int ranks = static_cast<int>(pieces.size());
  const auto controllers = MakeThreadRanks(ranks);
  const auto ownPieces = ForEachRank(pieces);
  const auto ownSurfaces = ForEachRank(surfaces);
  std::vector<vtkSmartPointer<vtkTrimHexahedralGrid>> filters;
  for (int rank = 0; rank < ranks; ++rank)
  {
    auto filter = vtkSmartPointer<vtkTrimHexahedralGrid>::New();
    SetOptions(filter, options);
    filter->SetController(controllers[rank]);
    filter->SetInputDataObject(0, ownPieces[rank]);
    filter->SetInputDataObject(1, ownSurfaces[rank]);
    if (before)
    {
      before(rank, filter);
    }
    filters.push_back(filter);
  }
  PiecesOutcome outcome;
  const Listener listener;
  const auto update = [&filters](int rank) { filters[rank]->Update(); };
  RunRanks(ranks, update);
  for (int rank = 0; again && rank < ranks; ++rank)
  {
    again(rank, filters[rank]);
  }
  if (again)
  {
    RunRanks(ranks, update);
  }
  for (const auto& filter : filters)
  {
    outcome.Trimmed.emplace_back(filter->GetOutput());
    outcome.Statuses.emplace_back(
      vtkUnstructuredGrid::SafeDownCast(filter->GetOutputDataObject(1)));
    outcome.Offcuts.emplace_back(vtkUnstructuredGrid::SafeDownCast(filter->GetOutputDataObject(2)));
  }
  outcome.Errors = listener.Errors();
  outcome.Warnings = listener.Warnings();
  return outcome;
}

std::string DifferenceFromWhole(
  vtkUnstructuredGrid* whole, const std::vector<vtkSmartPointer<vtkUnstructuredGrid>>& pieces)
{
  PieceComparison comparison(whole);
  for (std::size_t rank = 0; rank < pieces.size(); ++rank)
  {
    const std::string difference = comparison.Compare(pieces[rank]);
    if (!difference.empty())
    {
      return "rank " + std::to_string(rank) + ", " + difference;
    }
  }
  return comparison.CompareCounts();
}

std::string DifferenceOfOriginalIds(const std::vector<vtkSmartPointer<vtkUnstructuredGrid>>& pieces,
  const std::vector<vtkSmartPointer<vtkUnstructuredGrid>>& results)
{
  for (std::size_t rank = 0; rank < pieces.size(); ++rank)
  {
    vtkUnstructuredGrid* from = pieces[rank];
    vtkUnstructuredGrid* to = results[rank];
    if (!NameOrigins(from->GetPointData(), to->GetPointData(), "vtkOriginalPointIds", WholePoint) ||
      !NameOrigins(from->GetCellData(), to->GetCellData(), "vtkOriginalCellIds", WholeCell))
    {
      return "rank " + std::to_string(rank) + ": original ids of other nodes or cells";
    }
  }
  return {};
}

std::string DifferenceOfSummaries(vtkUnstructuredGrid* input, vtkUnstructuredGrid* whole,
  const std::vector<vtkSmartPointer<vtkUnstructuredGrid>>& pieces)
{
  std::set<std::string> fromInput;
  for (int k = 0; k < input->GetFieldData()->GetNumberOfArrays(); ++k)
  {
    fromInput.insert(input->GetFieldData()->GetArrayName(k));
  }
  for (int k = 0; k < whole->GetFieldData()->GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray* expected = whole->GetFieldData()->GetAbstractArray(k);
    const std::string name = expected->GetName();
    for (const auto& piece : pieces)
    {
      vtkAbstractArray* found = piece->GetFieldData()->GetAbstractArray(name.c_str());
      const bool same = found && SameTuple(expected, 0, found, 0);
      if (!same && name != "NodeBandwidth" && !fromInput.count(name))
      {
        return name + " differs";
      }
    }
  }
  return {};
}

namespace
{
/// Without the filter's address and the number of a cell, which pieces have none of.
std::string PlainText(const std::string& text)
{
  const std::size_t start = text.find("): ");
  std::string plain = start == std::string::npos ? text : text.substr(start + 3);
  const std::string ending = " of the input) ";
  const std::size_t cell = plain.find("(cell ");
  const std::size_t end = plain.find(ending);
  if (cell != std::string::npos && end != std::string::npos)
  {
    plain.erase(cell, end + ending.size() - cell);
  }
  plain.erase(plain.find_last_not_of('\n') + 1);
  return plain;
}
}

std::string DifferenceOfTexts(
  const std::vector<std::string>& whole, const std::vector<std::string>& pieces)
{
  for (std::size_t i = 0; i < std::max(whole.size(), pieces.size()); ++i)
  {
    const std::string expected = i < whole.size() ? PlainText(whole[i]) : "nothing";
    const std::string found = i < pieces.size() ? PlainText(pieces[i]) : "nothing";
    if (expected != found)
    {
      return "it says: " + found + "\n     instead of: " + expected;
    }
  }
  return {};
}
}
