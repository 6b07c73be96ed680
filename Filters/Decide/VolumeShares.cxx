#include "VolumeShares.h"

#include "CutEdges.h"
#include "EliminatedFraction.h"
#include "HalvedShare.h"
#include "Runs.h"
#include "Status.h"

namespace trim
{
namespace
{

/// V^e of an element that the surface cuts.
double ShareOf(const Band& band, int element, const std::array<int, 8>& nodes,
  const CutEdges& edges, const nurbs::TrimmingSurface& surface, double volume)
{
  const int count = band.Elements[element].Count;
  const ElementPoints points = PointsInOrder(band, count, nodes);
  const double share = MeasureEliminated(band, element, nodes, edges) / volume;
  return IsNearlyPlane(points, count, surface, MeanNormal(band, element, nodes, edges))
    ? share
    : HalveForShare(points, count, surface, share).value_or(share);
}

}

bool MeasureShares(const Band& band, const Columns& columns, const nurbs::TrimmingSurface& surface,
  double gap, VolumeShares& shares, std::array<int, 2>& missedEdge)
{
  const int count = band.NumberOfElements();
  shares.Volume.assign(count, 0.0);
  shares.Element.assign(count, 0.0);
  const CutEdges edges(band, surface, gap);
  missedEdge = edges.FindMissed();
  if (missedEdge[0] >= 0)
  {
    return false;
  }
  ForAll(
    count,
    [&](int e)
    {
      const std::array<int, 8> nodes = OrderForTetrahedra(band.Elements[e]);
      const double volume = MeasureVolume(band, e, nodes);
      shares.Volume[e] = volume;
      shares.Element[e] = band.ElementStatus[e] == ElementEliminate ? 1.0 : 0.0;
      if (band.ElementStatus[e] == ElementToTreat && volume > 0.0)
      {
        shares.Element[e] = ShareOf(band, e, nodes, edges, surface, volume);
      }
    },
    64);
  MeasureColumnShares(columns, shares);
  return true;
}

void MeasureColumnShares(const Columns& columns, VolumeShares& shares)
{
  const std::size_t count = shares.Element.size();
  std::vector<double> total(count, 0.0);
  std::vector<double> eliminated(count, 0.0);
  for (std::size_t e = 0; e < count; ++e)
  {
    total[columns.Column[e]] += shares.Volume[e];
    eliminated[columns.Column[e]] += shares.Volume[e] * shares.Element[e];
  }
  shares.Column.resize(count);
  for (std::size_t e = 0; e < count; ++e)
  {
    const int column = columns.Column[e];
    shares.Column[e] = total[column] > 0.0 ? eliminated[column] / total[column] : 0.0;
  }
}

}
