#include "LostVolume.h"

#include "BandPlace.h"
#include "DisjointSets.h"
#include "ElementMap.h"
#include "ElementsAstray.h"
#include "NodesOfElements.h"
#include "Status.h"

#include <algorithm>
#include <cmath>

namespace trim
{
namespace
{

/// Elements that went or stayed although some of them, or all, lies on the other side, and that
/// share no node with one of the other fate: no border reaches them.
std::vector<char> FindUnreached(const TrimBand& near)
{
  const Band& band = near.Mesh;
  const auto has = NodesByFate(near);
  std::vector<char> unreached(band.NumberOfElements(), 0);
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    const bool kept = near.Trimmed.Kept[e] != 0;
    const auto& others = has[kept ? 0 : 1];
    const BandElement& element = band.Elements[e];
    unreached[e] = band.ElementStatus[e] != (kept ? ElementKeep : ElementEliminate) &&
      !band.IsInserted(e) &&
      std::none_of(element.begin(), element.end(), [&](int n) { return others[n] != 0; });
  }
  return unreached;
}

/// Joins unreached elements that share a node to places.
nurbs::DisjointSets<int> JoinPlaces(const Band& band, const std::vector<char>& unreached)
{
  nurbs::DisjointSets<int> places(band.NumberOfElements());
  std::vector<int> first(band.NumberOfNodes(), -1);
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    for (const int n : band.Elements[e])
    {
      if (unreached[e])
      {
        first[n] = first[n] < 0 ? e : first[n];
        places.Unite(first[n], e);
      }
    }
  }
  return places;
}

/// Volumes of the elements of a place, in elements.
struct Balance
{
  double Excess = 0.0; ///< how much more there is than lies on the kept side
  double Whole = 0.0;  ///< what there is, or would have to be if that is more

  /// More than a border on the surface reaches round.
  bool IsLarge() const { return std::abs(this->Excess) > ElementsAstray::FewCorners; }
  /// A strip or an island that went or stayed is most of its place.
  bool IsLost() const { return this->IsLarge() && std::abs(this->Excess) > 0.5 * this->Whole; }
};

/// By the smallest element of each place; nothing where a finding tells of it.
/// @param volumes of the elements before.
/// @param excessOf the volume that an element has too much.
template <typename Excess>
std::vector<Balance> BalanceByPlace(const TrimBand& near, const std::vector<double>& volumes,
  const std::vector<char>& unreached, const std::vector<char>& told,
  nurbs::DisjointSets<int>& places, const Excess& excessOf)
{
  std::vector<Balance> balances(near.Mesh.NumberOfElements());
  for (int e = 0; e < near.Mesh.NumberOfElements(); ++e)
  {
    if (unreached[e] && volumes[e] > 0.0)
    {
      const double excess = excessOf(e) / volumes[e];
      Balance& balance = balances[places.Find(e)];
      balance.Excess += excess;
      const double due = near.Mesh.IsInserted(e) ? 0.0 : 1.0 - near.Shares.Element[e];
      balance.Whole += due + std::max(excess, 0.0);
    }
  }
  for (int e = 0; e < near.Mesh.NumberOfElements(); ++e)
  {
    if (told[e] && unreached[e])
    {
      balances[places.Find(e)] = {};
    }
  }
  return balances;
}

/// How much of the place of each element, as the mesh came, the trimmed mesh takes, in whatever
/// element; of WithoutLayer(near.Mesh).
/// @param volumes of the elements before.
std::vector<double> FindVolumesTaken(const TrimBand& near, const std::vector<double>& volumes)
{
  const Band& band = WithoutLayer(near.Mesh);
  std::vector<double> taken(band.NumberOfElements(), 0.0);
  for (int e = 0; e < near.Mesh.NumberOfElements(); ++e)
  {
    if (!near.Trimmed.Kept[e])
    {
      continue;
    }
    int start = ElementWithoutLayer(near.Mesh, e);
    const FinalElement shape = FinalShape(near.Mesh, near.Trimmed, e);
    if (!shape.Touched && !near.Mesh.IsInserted(e))
    {
      taken[start] += volumes[e];
      continue;
    }
    ForVolumes<3>(shape.Points, shape.Count,
      [&](const Vec3& place, double volume)
      {
        const int at = FindBandPlace(band, start, place).Element;
        start = at < 0 ? start : at;
        taken[start] += std::abs(volume);
      });
  }
  return taken;
}

/// The cut element of which most is lost or stayed, of those that pass a test; -1: none.
template <typename Test>
int FindMostAstray(const TrimBand& near, const Test& test)
{
  int most = -1;
  double largest = 0.0;
  for (int e = 0; e < near.Mesh.NumberOfElements(); ++e)
  {
    const double beyond = near.Shares.Element[e];
    const double astray = near.Trimmed.Kept[e] ? beyond : 1.0 - beyond;
    const bool isCut = near.Mesh.ElementStatus[e] == ElementToTreat && !near.Mesh.IsInserted(e);
    if (isCut && astray > largest && test(e))
    {
      largest = astray;
      most = e;
    }
  }
  return most;
}

/// What is lost at places of which nothing is told.
/// @param volumes of the elements before.
LostVolume FindLostPlaces(
  const TrimBand& near, const std::vector<double>& volumes, const std::vector<char>& told)
{
  const std::vector<char> unreached = FindUnreached(near);
  if (std::find(unreached.begin(), unreached.end(), 1) == unreached.end())
  {
    return {};
  }
  nurbs::DisjointSets<int> places = JoinPlaces(near.Mesh, unreached);
  const auto balance = [&](const auto& excessOf)
  { return BalanceByPlace(near, volumes, unreached, told, places, excessOf); };
  std::vector<Balance> found = balance([&](int e) { return ExcessOf(near, e, volumes[e]); });
  if (std::none_of(found.begin(), found.end(), [](const Balance& b) { return b.IsLarge(); }))
  {
    return {};
  }
  // Nodes that move by several elements, as those of columns do along a surface that leans, carry
  // kept elements to where others went, or from where they stay.
  const std::vector<double> taken = FindVolumesTaken(near, volumes);
  found = balance(
    [&](int e)
    {
      const double due = volumes[e] * (1.0 - near.Shares.Element[e]);
      // An inserted one counts with that on which it stands.
      return near.Mesh.IsInserted(e) ? 0.0 : taken[ElementWithoutLayer(near.Mesh, e)] - due;
    });
  LostVolume lost;
  lost.IsOfPlaces = true;
  for (const Balance& place : found)
  {
    lost.Elements += place.IsLost() ? std::abs(place.Excess) : 0.0;
  }
  lost.Most =
    FindMostAstray(near, [&](int e) { return unreached[e] && found[places.Find(e)].IsLost(); });
  return lost;
}

}

LostVolume FindLostVolume(const TrimBand& near, const std::vector<int>& told, double share)
{
  std::vector<char> toldNearby(near.Mesh.NumberOfElements(), 0);
  for (const int e : ElementsAt(near.Mesh, NodesOf(near.Mesh, told)))
  {
    toldNearby[e] = 1;
  }
  std::vector<double> volumes(near.Mesh.NumberOfElements());
  for (int e = 0; e < near.Mesh.NumberOfElements(); ++e)
  {
    volumes[e] = VolumeBefore(near.Mesh, e);
  }
  const ElementsAstray astray = MeasureVolumeAstray(near, volumes, toldNearby);
  if (!astray.MissesWhole(share))
  {
    return FindLostPlaces(near, volumes, toldNearby);
  }
  LostVolume lost;
  lost.Elements = astray.Volume;
  lost.Most = FindMostAstray(near, [&](int e) { return !toldNearby[e]; });
  return lost;
}

}
