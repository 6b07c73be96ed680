#include "TrimPipeline.h"

#include "FeasibilityCheck.h"
#include "Shortfalls.h"
#include "Status.h"
#include "TrimWarnings.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trim
{
namespace
{

/// Rings of elements round the cut: those that may change, and one halo.
constexpr int BandRings = 4;
/// Rings where columns reach farther, in a sheet of many layers under an inclined surface.
constexpr int DeepBandRings = 12;
/// A surface that shifts by more than this share of an element from skin to skin cannot be
/// followed by whole columns: the sheet is treated as a block.
constexpr double LargestColumnShift = 2.0;

/// Turns the surface round for a scope.
class Turned
{
public:
  Turned(nurbs::TrimmingSurface& surface, bool turn)
    : Surface(surface)
    , Turn(turn)
  {
    this->Flip();
  }
  ~Turned() { this->Flip(); }
  Turned(const Turned&) = delete;
  void operator=(const Turned&) = delete;

private:
  void Flip()
  {
    if (this->Turn)
    {
      this->Surface.Flip();
    }
  }
  nurbs::TrimmingSurface& Surface;
  bool Turn;
};

Id NearestNode(const HexMesh& mesh, const Vec3& point)
{
  Id nearest = 0;
  double best = std::numeric_limits<double>::infinity();
  for (Id i = 0; i < mesh.NumberOfPoints; ++i)
  {
    const double d = (mesh.Point(i) - point).squaredNorm();
    if (d < best)
    {
      best = d;
      nearest = i;
    }
  }
  return nearest;
}

/// Whether a point lies beyond the surface: by projection near it, where the sign is certain,
/// else as the nearest node, whose status was carried along the mesh.
bool LiesBeyond(const HexMesh& mesh, const MeshBlocks& blocks,
  const nurbs::TrimmingSurface& surface, const NodeClassification& nodes, const Vec3& point)
{
  const auto foot = surface.ClosestPoint(point);
  const Id node = NearestNode(mesh, point);
  const bool near = foot.Distance < blocks.LargestDiagonal;
  if ((near && foot.Kind == nurbs::FootKind::Interior) || nodes.Status[node] == NodeOnSurface)
  {
    return foot.SignedDistance > 0.0;
  }
  return nodes.Status[node] == NodeEliminate;
}

void TurnStatuses(NodeClassification& nodes)
{
  for (auto& status : nodes.Status)
  {
    if (status != NodeOnSurface)
    {
      status = static_cast<unsigned char>(status == NodeKeep ? NodeEliminate : NodeKeep);
    }
  }
  for (auto& distance : nodes.SignedDistance)
  {
    distance = -distance;
  }
  for (auto& foot : nodes.Near.Feet)
  {
    foot.Normal = -foot.Normal;
    foot.SignedDistance = -foot.SignedDistance;
  }
}

void ClassifyElements(const HexMesh& mesh, TrimResult& result)
{
  result.ElementStatus.resize(mesh.NumberOfCells);
  vtkSMPTools::For(0, mesh.NumberOfCells, 50000,
    [&](Id begin, Id end)
    {
      std::array<Id, 8> nodes;
      std::array<unsigned char, 8> status;
      for (Id c = begin; c < end; ++c)
      {
        const int count = mesh.Cell(c, nodes);
        for (int i = 0; i < count; ++i)
        {
          status[i] = result.Nodes.Status[nodes[i]];
        }
        result.ElementStatus[c] = StatusOfElement(status.data(), count);
      }
    });
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

/// Cells within so many of the largest elements of the surface: all rings lie among them.
std::vector<Id> FindNearCells(
  const HexMesh& mesh, const MeshBlocks& blocks, const nurbs::TrimmingSurface& surface, int rings)
{
  const Vec3 margin = Vec3::Constant((rings + 1) * blocks.LargestDiagonal);
  const auto near = [&](Box3 box)
  {
    box.min() -= margin;
    box.max() += margin;
    return surface.MayIntersect(box);
  };
  std::vector<std::vector<Id>> found(blocks.NumberOfBlocks());
  vtkSMPTools::For(0, blocks.NumberOfBlocks(), 64,
    [&](Id begin, Id end)
    {
      for (Id b = begin; b < end; ++b)
      {
        if (!near(blocks.Boxes[b]))
        {
          continue;
        }
        const Id last = MeshBlocks::EndCell(b, mesh.NumberOfCells);
        for (Id c = MeshBlocks::FirstCell(b); c < last; ++c)
        {
          if (near(CellBox(mesh, c)))
          {
            found[b].push_back(c);
          }
        }
      }
    });
  std::vector<Id> cells;
  for (const auto& list : found)
  {
    cells.insert(cells.end(), list.begin(), list.end());
  }
  return cells;
}

/// Mean shift of the surface from skin to skin, in elements; 0 without thickness.
double ColumnShift(const Band& band, const Columns& columns, const nurbs::TrimmingSurface& surface)
{
  double shift = 0.0;
  int count = 0;
  std::vector<int> layers(band.NumberOfElements(), 0);
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    ++layers[columns.Column[e]];
  }
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    const auto& element = band.Elements[e];
    if (element.Ring > 0 || columns.Axis[e] < 0)
    {
      continue;
    }
    const auto& topology = TopologyOf(element.Count);
    Vec3 thickness = Vec3::Zero();
    double lateral = 0.0;
    int lateralEdges = 0;
    int axisEdges = 0;
    for (int i = 0; i < topology.NumberOfEdges; ++i)
    {
      const Vec3 edge = band.Point[element.Node[topology.Edges[i].Second]] -
        band.Point[element.Node[topology.Edges[i].First]];
      const bool along = topology.Edges[i].Axis == columns.Axis[e];
      (along ? axisEdges : lateralEdges) += 1;
      thickness += along ? edge : Vec3::Zero();
      lateral += along ? 0.0 : edge.norm();
    }
    thickness /= axisEdges;
    lateral /= lateralEdges;
    const Vec3 normal = surface.ClosestPoint(band.Point[element.Node[0]]).Normal;
    const double sine = std::abs(normal.dot(thickness.normalized()));
    const double tangent = sine / std::sqrt(std::max(1e-12, 1.0 - sine * sine));
    shift += std::min(10.0, layers[columns.Column[e]] * thickness.norm() * tangent / lateral);
    ++count;
  }
  return count > 0 ? shift / count : 0.0;
}

std::unique_ptr<TrimBand> BuildBand(const HexMesh& mesh, const MeshBlocks& blocks,
  const nurbs::TrimmingSurface& surface, const std::vector<Id>& seeds)
{
  std::unique_ptr<TrimBand> near;
  for (const int rings : { BandRings, DeepBandRings })
  {
    near = std::make_unique<TrimBand>(
      Band(mesh, seeds, FindNearCells(mesh, blocks, surface, rings), rings));
    near->Structure = FindColumns(near->Mesh);
    const bool all = std::all_of(near->Structure.Axis.begin(), near->Structure.Axis.end(),
      [](signed char axis) { return axis >= 0; });
    if (all && near->Structure.Complete(near->Mesh, 2))
    {
      break;
    }
  }
  near->SheetAxis = near->Structure.Axis;
  if (ColumnShift(near->Mesh, near->Structure, surface) > LargestColumnShift ||
    !near->Structure.Complete(near->Mesh, 2))
  {
    near->Structure = NoColumns(near->Mesh);
  }
  return near;
}

bool MeasureBand(TrimResult& result, const nurbs::TrimmingSurface& surface, std::string& error)
{
  auto& near = *result.Near;
  const double gap = GapShare * surface.Bounds().diagonal().norm();
  near.NodeStatus.resize(near.Mesh.NumberOfNodes());
  for (int n = 0; n < near.Mesh.NumberOfNodes(); ++n)
  {
    near.NodeStatus[n] = result.Nodes.Status[near.Mesh.GlobalNode[n]];
  }
  std::vector<unsigned char> elementStatus(near.Mesh.NumberOfElements());
  for (int e = 0; e < near.Mesh.NumberOfElements(); ++e)
  {
    elementStatus[e] = result.ElementStatus[near.Mesh.Elements[e].Global];
  }
  std::array<int, 2> missed{ -1, -1 };
  if (!MeasureShares(near.Mesh, near.Structure, near.NodeStatus, elementStatus, surface, gap,
        near.Shares, missed))
  {
    const Vec3 place = 0.5 * (near.Mesh.Point[missed[0]] + near.Mesh.Point[missed[1]]);
    error = "The trimming surface ends inside the grid, near " + PlaceText(place) +
      ", and so does not part it: extend the surface beyond the grid or close it.";
    return false;
  }
  return true;
}

void SetFates(const HexMesh& mesh, TrimResult& result)
{
  result.Kept.resize(mesh.NumberOfCells);
  for (Id c = 0; c < mesh.NumberOfCells; ++c)
  {
    result.Kept[c] = result.ElementStatus[c] != ElementEliminate;
  }
  if (result.Near)
  {
    const auto& near = *result.Near;
    for (int e = 0; e < near.Mesh.NumberOfElements(); ++e)
    {
      result.Kept[near.Mesh.Elements[e].Global] = near.Trimmed.Kept[e];
    }
  }
}

void FindAndWarn(
  const HexMesh& mesh, const nurbs::TrimmingSurface& surface, double precision, TrimResult& result)
{
  result.Found.Feasibilities = CheckFeasibility(mesh, surface, result);
  if (result.Near)
  {
    result.Found.DistancesLeft = FindNodesLeft(*result.Near, surface, precision);
    result.Found.Shortfalls = FindShortfalls(*result.Near, result.Found.DistancesLeft);
  }
  AddWarnings(mesh, result);
}

}

TrimResult Trim(const HexMesh& mesh, const MeshBlocks& blocks, nurbs::TrimmingSurface& surface,
  const TrimOptions& options, const Progress& progress)
{
  TrimResult result;
  const auto aborted = [&](double done) { return result.Aborted = progress(done); };
  const auto stopped = [&result, &progress] { return progress(-1.0); };
  const double precision = options.Tolerance * blocks.Bounds.diagonal().norm();

  // Classify.
  if (!ClassifyNodes(mesh, blocks, surface, precision, stopped, result.Nodes, result.Error) ||
    aborted(0.3))
  {
    return result;
  }
  bool turn = options.InvertSide;
  if (options.UseKeepPoint && LiesBeyond(mesh, blocks, surface, result.Nodes, options.KeepPoint))
  {
    turn = !turn;
  }
  const Turned turned(surface, turn);
  if (turn)
  {
    TurnStatuses(result.Nodes);
  }
  ClassifyElements(mesh, result);

  // Decide, correct and treat, near the cut.
  const auto seeds = FindSeeds(mesh, result);
  if (!seeds.empty())
  {
    result.Near = BuildBand(mesh, blocks, surface, seeds);
    if (aborted(0.4) || !MeasureBand(result, surface, result.Error) || aborted(0.5))
    {
      return result;
    }
    auto& near = *result.Near;
    near.Trimmed = ClimbLadder(near.Mesh, near.Structure, near.Shares, near.NodeStatus, surface,
      precision, options.Ladder, stopped);
  }
  SetFates(mesh, result);
  FindAndWarn(mesh, surface, precision, result);
  aborted(0.6);
  return result;
}

}
