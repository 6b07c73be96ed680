#include "TrimPipeline.h"

#include "CountBytes.h"
#include "CutColumns.h"
#include "ElementClassification.h"
#include "EndInside.h"
#include "FeasibilityCheck.h"
#include "GatherBand.h"
#include "InputScale.h"
#include "KeptSide.h"
#include "LooseParts.h"
#include "Runs.h"
#include "Shortfalls.h"
#include "Status.h"
#include "StretchTrims.h"
#include "SurfaceEnds.h"
#include "Team.h"
#include "TrimWarnings.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <utility>

namespace trim
{
namespace
{

/// Rings of elements round the cut: those that may change, and one halo.
constexpr int BandRings = 4;
/// Rings where columns reach farther, in a sheet of many layers under an inclined surface, or there
/// are none; of all places alike if it is so at one.
constexpr int DeepBandRings = 12;
/// Nodes are placed on the surface to this share of the diagonal of the grid's box, or where the
/// grid is far from the origin to this share of the largest coordinate.
constexpr double PlacePrecision = 1e-9;
constexpr double FarPlacePrecision = 64.0 * std::numeric_limits<double>::epsilon();
/// Rounding of a distance, in units of the largest coordinate: what is nearer than that is on the
/// surface, whatever tolerance is asked for. Nodes that a trim moved there and that were stored as
/// float are off by up to 0.87 of that epsilon, and have to be on it for the next trim.
constexpr double DistanceRounding = 16.0 * std::numeric_limits<double>::epsilon();
constexpr double DistanceRoundingOfFloats = std::numeric_limits<float>::epsilon();
/// A smaller tolerance leaves no node where it can be seen.
constexpr double FinestCoarseTolerance = 1e-6;
/// A stretch with more of the band than this is decided before the others, not beside them.
constexpr double MostSideBySide = 0.75;

/// Distances that count as none, absolute.
struct Precisions
{
  bool Single;      ///< some places are stored as float
  double Place;     ///< of nodes that are put on the surface
  double Rounding;  ///< of distances
  double Tolerance; ///< of nodes that are on the surface where they are
};

Precisions PrecisionsOf(
  const HexMesh& mesh, const MeshBlocks& blocks, const Piece& piece, double tolerance)
{
  const double diagonal = blocks.Bounds.diagonal().norm();
  const double largest = LargestCoordinateOf(blocks.Bounds);
  const bool single = piece.All.Any(mesh.PointsFloat != nullptr);
  const double rounding = (single ? DistanceRoundingOfFloats : DistanceRounding) * largest;
  return { single, std::max(PlacePrecision * diagonal, FarPlacePrecision * largest), rounding,
    std::max(tolerance * diagonal, rounding) };
}

/// Whether the surface has to be turned round for its normal to point to what goes.
bool MustTurn(const HexMesh& mesh, const MeshBlocks& blocks, const Piece& piece,
  const nurbs::TrimmingSurface& surface, const TrimOptions& options, double tolerance,
  TrimResult& result)
{
  if (!options.UseKeepPoint)
  {
    return options.InvertSide;
  }
  if (surface.ClosestPoint(options.KeepPoint).Distance <= tolerance)
  {
    result.Warnings.emplace_back(
      "KeepPoint lies on the surface and tells no side, so the normal of the surface does: give a "
      "point in the part that is to stay.");
    return options.InvertSide;
  }
  return options.InvertSide !=
    LiesBeyond(mesh, blocks, piece, surface, result.Nodes, options.KeepPoint);
}

/// Cells that the surface cuts or touches with a node.
std::vector<Id> FindSeeds(const HexMesh& mesh, const TrimResult& result)
{
  std::vector<Id> seeds;
  std::array<Id, 8> nodes;
  for (const Id c : result.Nodes.CandidateCells)
  {
    bool seed = result.ElementStatus[c] == ElementToTreat;
    const int count = mesh.Cell(c, nodes);
    for (int i = 0; i < count && !seed; ++i)
    {
      seed = result.Nodes.Status[nodes[i]] == NodeOnSurface;
    }
    if (seed)
    {
      seeds.push_back(c);
    }
  }
  return seeds;
}

/// Runs of cells within so many of the largest elements of those that the surface comes to within
/// the tolerance: all rings lie among them, as cells of one ring share nodes with the ring before,
/// and those that the surface meets, or has nodes of, are the first.
std::vector<Id> FindNearRuns(
  const MeshBlocks& blocks, const nurbs::TrimmingSurface& surface, int rings, double tolerance)
{
  const Vec3 slack = Vec3::Constant(1e-6 * blocks.LargestDiagonal + tolerance);
  const Vec3 margin = rings * blocks.LargestCell + slack;
  return FindRuns(
    blocks, [&](const Box3& box) { return surface.MayIntersect(Grown(box, margin)); });
}

/// What is wrong where two elements have the same nodes; empty: there are none.
std::string FindRepeatedElement(const Band& band, const Piece& piece)
{
  // Elements are in the order of their nodes.
  for (int e = 1; e < band.NumberOfElements(); ++e)
  {
    const BandElement& one = band.Elements[e - 1];
    const BandElement& other = band.Elements[e];
    if (one.Count == other.Count && std::is_permutation(one.begin(), one.end(), other.begin()))
    {
      return "Cells " + std::to_string(piece.InputCell(one.Global)) + " and " +
        std::to_string(piece.InputCell(other.Global)) +
        " of the grid have the same nodes: remove one of them.";
    }
  }
  return "";
}

/// The same band on all ranks; false with an error if there can be none.
bool BuildBand(const HexMesh& mesh, const MeshBlocks& blocks, const Piece& piece,
  const nurbs::TrimmingSurface& surface, const Precisions& within, std::vector<Id> nearRuns,
  const std::vector<Id>& seeds, TrimResult& result)
{
  auto& near = result.Near;
  for (const int rings : { BandRings, DeepBandRings })
  {
    if (rings > BandRings)
    {
      nearRuns = FindNearRuns(blocks, surface, rings, within.Tolerance);
    }
    auto cells = CollectBandCells(mesh, seeds, CellsOfRuns(mesh, nearRuns), rings,
      result.Nodes.Status, result.ElementStatus, SpreadAcrossPieces(piece));
    if (!GatherBandCells(mesh, piece, cells, result.Error))
    {
      return false;
    }
    near = std::make_unique<TrimBand>(Band(std::move(cells), rings, within.Single));
    result.Error = FindRepeatedElement(near->Mesh, piece);
    if (!result.Error.empty())
    {
      return false;
    }
    near->Structure = FindColumns(near->Mesh);
    if (!piece.All.Any(
          !near->Structure.AllHaveThickness() || !near->Structure.Complete(near->Mesh, 2)))
    {
      break;
    }
  }
  near->SheetAxis = near->Structure.Axis;
  return true;
}

/// Sets columns and shares of the stretches; leaves an error if the surface ends in the band.
/// Collective.
void MeasureStretches(const Piece& piece, const nurbs::TrimmingSurface& surface,
  const BandOptions& options, StretchTrims& stretches, TrimResult& result)
{
  const bool nodesMove = options.Ladder.CorrectionType != Correction::Eliminate;
  const auto& feet = result.Nodes.Near.Feet;
  const bool ends = piece.All.Any(std::any_of(feet.begin(), feet.end(),
    [](const nurbs::Foot& foot) { return foot.Kind == nurbs::FootKind::Border; }));
  const double gap = surface.WidestGap();
  for (int s = 0; s < stretches.Count() && result.Error.empty(); ++s)
  {
    TrimBand& near = stretches[s];
    SetColumns(near, result.Nodes.Near, surface, nodesMove);
    std::array<int, 2> missed{ -1, -1 };
    if (!MeasureShares(near.Mesh, near.Structure, surface, gap, near.Shares, missed))
    {
      const Vec3& eliminated = near.Mesh.Point[missed[0]];
      const Vec3& kept = near.Mesh.Point[missed[1]];
      const auto end = FindEndBeside(surface, eliminated, kept);
      const Vec3 place = end.value_or(0.5 * (eliminated + kept));
      result.Error = ends || end ? EndsInsideText(place) : SidesMixedUpText(place);
    }
  }
  result.Error = piece.All.FirstText(result.Error);
}

/// Decides each stretch by itself: side by side, as that is what keeps threads busy, but for one
/// that the others would be through with long before, whose loops the threads share.
void DecideStretches(StretchTrims& stretches, const BandTask& task, const Progress& progress)
{
  std::atomic<int> decided{ 0 }; // elements
  const double all = stretches.NumberOfElements();
  const auto decide = [&](int s)
  {
    TrimBand& near = stretches[s];
    const int own = near.Mesh.NumberOfElements();
    DecideBand(near, task,
      [&](double done) { return progress(done < 0.0 ? done : (decided + done * own) / all); });
    decided += own;
  };
  std::vector<int> others;
  for (int s = 0; s < stretches.Count(); ++s)
  {
    if (stretches[s].Mesh.NumberOfElements() > MostSideBySide * all)
    {
      decide(s);
    }
    else
    {
      others.push_back(s);
    }
  }
  // Nobody begins with the largest one when the others are through.
  std::stable_sort(others.begin(), others.end(),
    [&](int a, int b)
    { return stretches[a].Mesh.NumberOfElements() > stretches[b].Mesh.NumberOfElements(); });
  ForAll(
    static_cast<int>(others.size()), [&](int i) { decide(others[i]); }, 1);
}

/// Inserted nodes of this rank get the ids after those of the mesh.
void NumberInserted(Id next, Band& band)
{
  for (std::size_t n = 0; n < band.NodeOrigins.size(); ++n)
  {
    if (band.NodeOrigins[n].Inserted && band.GlobalNode[n] >= 0)
    {
      band.GlobalNode[n] = next++;
    }
  }
}

void SetFates(const HexMesh& mesh, TrimResult& result)
{
  result.Kept.resize(mesh.NumberOfCells);
  ParallelFor(0, mesh.NumberOfCells, 100000,
    [&result](Id begin, Id end)
    {
      const auto& status = result.ElementStatus;
      std::transform(status.begin() + begin, status.begin() + end, result.Kept.begin() + begin,
        [](unsigned char own) { return static_cast<char>(own != ElementEliminate); });
    });
  if (result.Near)
  {
    const auto& near = *result.Near;
    for (const int e : near.Mesh.ElementsByCell())
    {
      result.Kept[near.Mesh.Elements[e].Global] = near.Trimmed.Kept[e];
    }
  }
}

/// A list by nodes of the band as one by ids of this rank's mesh, ascending.
std::vector<std::pair<Id, float>> ById(
  const std::vector<std::pair<int, float>>& list, const Band& band)
{
  std::vector<std::pair<Id, float>> byId;
  for (const auto& [node, value] : list)
  {
    if (band.GlobalNode[node] >= 0)
    {
      byId.emplace_back(band.GlobalNode[node], value);
    }
  }
  std::sort(byId.begin(), byId.end());
  return byId;
}

/// The ids that nodes of the band have in this rank's mesh, ascending.
std::vector<Id> IdsOf(const std::vector<int>& nodes, const Band& band)
{
  std::vector<Id> ids;
  for (const int node : nodes)
  {
    if (band.GlobalNode[node] >= 0)
    {
      ids.push_back(band.GlobalNode[node]);
    }
  }
  std::sort(ids.begin(), ids.end());
  return ids;
}

/// Of all pieces, inserted elements among them. Collective.
Id CountKept(const Piece& piece, const TrimResult& result)
{
  const Band& band = result.Near->Mesh;
  Id inserted = 0;
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    inserted += band.IsInserted(e) && result.Near->Trimmed.Kept[e];
  }
  return piece.All.Sum(CountBytes(result.Kept, 1)) + inserted;
}

void FindAndWarn(const HexMesh& mesh, const Piece& piece, const nurbs::TrimmingSurface& surface,
  const TrimOptions& options, const std::string& unitsHint, TrimResult& result)
{
  result.Found.Feasibilities = CheckFeasibility(mesh, piece.All, surface, result);
  if (result.Near)
  {
    auto& near = *result.Near;
    const std::vector<int> boundary = ListBoundaryNodes(near.Mesh, near.Trimmed);
    near.Shortfalls =
      FindShortfalls(near, near.NodesLeft, FindLooseParts(near, boundary, CountKept(piece, result)),
        options.OfBand.Ladder.QualityFloor > 0.0);
    result.Found.DistancesLeft = ById(near.NodesLeft, near.Mesh);
    result.Found.NewBoundary = IdsOf(boundary, near.Mesh);
    if (options.Tolerance > FinestCoarseTolerance)
    {
      near.NodesBeside = FindNodesBeside(near, surface);
    }
    if (options.OfBand.ProduceOffcut)
    {
      near.ShortfallsOfRest = FindShortfallsOfOffcut(near, near.NodesLeft);
      near.Missing = MeasureMissing(near);
      near.CornersLost = FindCornersLost(near, near.Missing);
      result.Found.CornersLost = IdsOf(near.CornersLost, near.Mesh);
    }
  }
  AddWarnings(mesh, piece, options.OfBand, unitsHint, result);
}

}

TrimResult Trim(const HexMesh& mesh, const MeshBlocks& blocks, const Piece& piece,
  nurbs::TrimmingSurface& surface, const TrimOptions& options, const Progress& progress)
{
  TrimResult result;
  // If one rank stops, all do: the others would wait for it.
  const auto aborted = [&](double done) { return result.Aborted = piece.All.Any(progress(done)); };
  const auto stopped = [&progress] { return progress(-1.0); };
  const Precisions within = PrecisionsOf(mesh, blocks, piece, options.Tolerance);
  const std::string unitsHint = UnitsHint(blocks.Bounds, surface.Bounds());
  // Of what is wrong with mesh and surface together.
  const auto addHint = [&] { result.Error += result.Error.empty() ? "" : unitsHint; };

  // Classify.
  std::vector<Id> nearRuns = FindNearRuns(blocks, surface, BandRings, within.Tolerance);
  const bool classified = ClassifyNodes(
    mesh, blocks, nearRuns, piece, surface, within.Tolerance, stopped, result.Nodes, result.Error);
  addHint();
  if (aborted(0.2) || !classified)
  {
    return result;
  }
  const bool turn = MustTurn(mesh, blocks, piece, surface, options, within.Tolerance, result);
  const Turned turned(surface, turn);
  if (turn)
  {
    TurnStatuses(result.Nodes);
  }
  result.ElementStatus = ClassifyElements(mesh, blocks, surface, within.Rounding, result.Nodes);

  // Decide, correct and treat, near the cut.
  const auto seeds = FindSeeds(mesh, result);
  if (piece.All.Any(!seeds.empty()))
  {
    if (!BuildBand(mesh, blocks, piece, surface, within, std::move(nearRuns), seeds, result) ||
      aborted(0.3))
    {
      return result;
    }
    StretchTrims stretches(*result.Near);
    MeasureStretches(piece, surface, options.OfBand, stretches, result);
    addHint();
    if (!result.Error.empty() || aborted(0.4))
    {
      return result;
    }
    const BandTask task{ surface, within.Place, options.OfBand };
    DecideStretches(stretches, task, Part(progress, 0.4, 0.6));
    if (aborted(0.6)) // what there is then may be in part, as an offcut that nobody fitted
    {
      return result;
    }
    stretches.Join();
    NumberInserted(mesh.NumberOfPoints, result.Near->Mesh);
  }
  SetFates(mesh, result);
  FindAndWarn(mesh, piece, surface, options, unitsHint, result);
  aborted(0.6);
  return result;
}

}
