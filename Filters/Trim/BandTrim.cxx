#include "BandTrim.h"

#include "BandQuality.h"
#include "BothParts.h"
#include "ColumnChoices.h"
#include "Shortfalls.h"
#include "Status.h"

#include <algorithm>
#include <tuple>

namespace trim
{
namespace
{

/// A node left farther than this many edges off the surface makes another trim worth the time.
constexpr double FarthestLeft = 0.5;
/// Where more are left, the cut runs along the mesh, and no decision would end it.
constexpr std::size_t MostLeft = 250;
/// Nodes that are left for the sake of a higher floor are so by any decision.
constexpr double HighestFloor = 0.5;

void Climb(TrimBand& near, const nurbs::TrimmingSurface& surface, double precision,
  const LadderOptions& options, bool produceOffcut, const Progress& progress)
{
  const TrimCase given{ near.Mesh, near.Structure, near.Shares, surface, precision };
  if (produceOffcut)
  {
    BothParts parts = ClimbForBothParts(given, options, progress);
    near.Trimmed = std::move(parts.Kept);
    near.Rest = std::move(parts.Rest);
  }
  else
  {
    LadderPosition foot;
    near.Trimmed = ClimbLadder(given, options, progress, foot);
  }
  near.NodesLeft = FindNodesLeft(near, surface, precision);
}

/// What a trim could not do.
struct Shortcomings
{
  std::size_t Elements = 0; ///< invalid or below the floor
  /// Sum of the squared distances of nodes left off the surface, in edges; an element short of what
  /// is aimed at counts as a node left by two.
  double Squares = 0.0;
  double Farthest = 0.0; ///< of the distances
  bool operator<(const Shortcomings& other) const
  {
    return std::tie(this->Elements, this->Squares) < std::tie(other.Elements, other.Squares);
  }
};

Shortcomings MeasureShortcomings(const TrimBand& near, const LadderOptions& options)
{
  const Band& band = near.Mesh;
  Shortcomings sum;
  sum.Elements = near.Trimmed.Invalid.size() + near.Trimmed.BelowFloor.size() +
    near.Rest.Invalid.size() + near.Rest.BelowFloor.size();
  const BandQuality aimed(band, options.Treatment, options.AimedQuality(), Measure::Worth);
  sum.Squares = 4.0 * static_cast<double>(aimed.FindBelowFloor(near.Trimmed).size());
  for (const auto& [node, distance] : near.NodesLeft)
  {
    double length = 0.0;
    const auto edges = band.EdgesOfNode(node);
    for (const int edge : edges)
    {
      length += (band.Point[band.OtherEnd(edge, node)] - band.Point[node]).norm() / edges.size();
    }
    sum.Squares += distance * distance / (length * length);
    sum.Farthest = std::max(sum.Farthest, distance / length);
  }
  return sum;
}

/// Whole elements that went though they lie on the kept side, or stayed beyond, farther than one
/// edge from the surface: the sum of their squared distances, in edges.
double SquaresAstray(const TrimBand& near, const nurbs::TrimmingSurface& surface)
{
  const Band& band = near.Mesh;
  double sum = 0.0;
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    const unsigned char side = near.Trimmed.Kept[e] ? ElementEliminate : ElementKeep;
    if (band.ElementStatus[e] != side)
    {
      continue;
    }
    const auto& element = band.Elements[e];
    const auto& topology = TopologyOf(element.Count);
    Vec3 centre = Vec3::Zero();
    for (int i = 0; i < element.Count; ++i)
    {
      centre += band.Point[element.Node[i]] / element.Count;
    }
    double longest = 0.0;
    for (int i = 0; i < topology.NumberOfEdges; ++i)
    {
      const auto& edge = topology.Edges[i];
      const Vec3 way = band.Point[element.Node[edge.Second]] - band.Point[element.Node[edge.First]];
      longest = std::max(longest, way.norm());
    }
    const double distance = surface.ClosestPoint(centre).Distance / longest;
    sum += distance > 1.0 ? distance * distance : 0.0;
  }
  return sum;
}

/// Trims a band once more, as `climb` does that is given what there is; what was before comes back
/// where it is no better.
/// @param least the shortcomings of what there is, afterwards of what is taken.
template <typename ClimbAnew, typename MeasureAll>
void TryAnew(TrimBand& near, const ClimbAnew& climb, const MeasureAll& measure, Shortcomings& least)
{
  BandTrim before = std::move(static_cast<BandTrim&>(near));
  climb(before);
  const Shortcomings now = measure();
  if (now < least)
  {
    least = now;
    return;
  }
  static_cast<BandTrim&>(near) = std::move(before);
}

/// Where columns take elements along that lie far from the surface, each sheet of a joint gets
/// columns of its own, or the elements are decided one by one, if that is better on the whole.
void TryOtherColumns(TrimBand& near, const nurbs::TrimmingSurface& surface, double precision,
  const LadderOptions& options, bool produceOffcut, const Progress& progress)
{
  std::vector<Columns> others;
  Columns sheets = FindJoinedSheets(near.Mesh);
  if (sheets.HasColumns() && sheets.Complete(near.Mesh, 2))
  {
    others.push_back(std::move(sheets));
  }
  others.push_back(NoColumns(near.Mesh, near.Structure.Part));
  const auto measure = [&]
  {
    Shortcomings sum = MeasureShortcomings(near, options);
    sum.Squares += SquaresAstray(near, surface);
    return sum;
  };
  Shortcomings least = measure();
  for (Columns& other : others)
  {
    const auto climb = [&](const BandTrim& before)
    {
      near.Structure = std::move(other);
      near.Shares = before.Shares;
      MeasureColumnShares(near.Structure, near.Shares);
      Climb(near, surface, precision, options, produceOffcut, progress);
    };
    if (!progress(-1.0) && SquaresAstray(near, surface) > 0.0)
    {
      TryAnew(near, climb, measure, least);
    }
  }
}

/// Whether something is kept that is nearly all beyond the surface.
bool KeepsCorners(const TrimBand& near)
{
  for (int e = 0; e < near.Mesh.NumberOfElements(); ++e)
  {
    if (near.Trimmed.Kept[e] && near.Shares.Column[e] > 1.0 - SmallestShare)
    {
      return true;
    }
  }
  return false;
}

}

/// What is kept for a corner of the model may leave nodes farther off than the corner would be, and
/// whole columns do where the cut wanders through a block or along a wall; then it is decided again
/// without, every element for itself, and what comes nearest to the surface is taken.
void DecideBand(TrimBand& near, const nurbs::TrimmingSurface& surface, double precision,
  const LadderOptions& options, bool produceOffcut, const Progress& progress)
{
  Climb(near, surface, precision, options, produceOffcut, Part(progress, 0.0, 0.4));
  if (!progress(-1.0) && near.Structure.HasColumns() && SquaresAstray(near, surface) > 0.0)
  {
    TryOtherColumns(near, surface, precision, options, produceOffcut, Part(progress, 0.4, 0.5));
  }
  // Most trims leave nothing, and are not measured again.
  if (near.NodesLeft.empty() || near.NodesLeft.size() > MostLeft ||
    options.QualityFloor > HighestFloor)
  {
    return;
  }
  Shortcomings least = MeasureShortcomings(near, options);
  const auto tryAgain = [&](const LadderOptions& with, bool columns, double begin, double end)
  {
    const auto climb = [&](const BandTrim& best)
    {
      const auto& shares = best.Shares;
      near.Structure = columns ? best.Structure : NoColumns(near.Mesh, best.Structure.Part);
      near.Shares =
        columns ? shares : VolumeShares{ shares.Volume, shares.Element, shares.Element };
      Climb(near, surface, precision, with, produceOffcut, Part(progress, begin, end));
    };
    TryAnew(
      near, climb, [&] { return MeasureShortcomings(near, options); }, least);
  };
  if (!progress(-1.0) && least.Farthest >= FarthestLeft && KeepsCorners(near))
  {
    LadderOptions without = options;
    without.KeepsCorners = false;
    tryAgain(without, true, 0.5, 0.75);
  }
  if (!progress(-1.0) && least.Farthest >= FarthestLeft && near.Structure.HasColumns())
  {
    tryAgain(options, false, 0.75, 1.0);
  }
}

}
