#include "LostVolume.h"

#include "DisjointSets.h"
#include "ElementsAstray.h"
#include "NodesOfElements.h"
#include "Status.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace trim
{
namespace
{

template <typename Test>
bool HasNode(const BandElement& element, const Test& test)
{
  return std::any_of(element.begin(), element.end(), test);
}

/// Elements that went or stayed although some of them, or all, lies on the other side, and that
/// share no node with one of the other fate: no border reaches them.
std::vector<char> FindUnreached(const TrimBand& near)
{
  const Band& band = near.Mesh;
  const std::array<std::vector<char>, 2> has = { NodesOfFate(near, false),
    NodesOfFate(near, true) };
  std::vector<char> unreached(band.NumberOfElements(), 0);
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    const bool kept = near.Trimmed.Kept[e] != 0;
    const auto& others = has[kept ? 0 : 1];
    unreached[e] = band.ElementStatus[e] != (kept ? ElementKeep : ElementEliminate) &&
      !band.IsInserted(e) && !HasNode(band.Elements[e], [&](int n) { return others[n] != 0; });
  }
  return unreached;
}

/// By the smallest element of each place, its excess in elements.
std::vector<double> ExcessByPlace(
  const TrimBand& near, const std::vector<char>& unreached, DisjointSets<int>& places)
{
  const Band& band = near.Mesh;
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
  std::vector<double> excess(band.NumberOfElements(), 0.0);
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    if (unreached[e] && near.Shares.Volume[e] > 0.0)
    {
      excess[places.Find(e)] += ExcessOf(near, e) / near.Shares.Volume[e];
    }
  }
  return excess;
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
LostVolume FindLostPlaces(const TrimBand& near, const std::vector<char>& told)
{
  const std::vector<char> unreached = FindUnreached(near);
  if (std::find(unreached.begin(), unreached.end(), 1) == unreached.end())
  {
    return {};
  }
  DisjointSets<int> places(near.Mesh.NumberOfElements());
  std::vector<double> excess = ExcessByPlace(near, unreached, places);
  for (int e = 0; e < near.Mesh.NumberOfElements(); ++e)
  {
    if (told[e] && unreached[e])
    {
      excess[places.Find(e)] = 0.0;
    }
  }
  const auto isLost = [](double volume) { return std::abs(volume) > ElementsAstray::FewCorners; };
  LostVolume lost;
  lost.IsOfPlaces = true;
  for (const double volume : excess)
  {
    lost.Elements += isLost(volume) ? std::abs(volume) : 0.0;
  }
  lost.Most =
    FindMostAstray(near, [&](int e) { return unreached[e] && isLost(excess[places.Find(e)]); });
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
  const ElementsAstray astray = MeasureVolumeAstray(near, toldNearby);
  if (!astray.MissesWhole(share))
  {
    return FindLostPlaces(near, toldNearby);
  }
  LostVolume lost;
  lost.Elements = astray.Volume;
  lost.Most = FindMostAstray(near, [&](int e) { return !toldNearby[e]; });
  return lost;
}

}
