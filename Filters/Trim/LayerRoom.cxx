#include "LayerRoom.h"

#include "InsertedLayer.h"
#include "Manifold.h"
#include "NodesOfElements.h"

#include <algorithm>
#include <utility>

namespace trim
{
namespace
{

/// Elements from this ring on keep their fate: the layer and those behind it need room in the band.
constexpr int FirstFixedRing = 2;

}

LayerRoom::LayerRoom(const Band& band, const Columns& columns, const VolumeShares& reach)
  : TheBand(band)
  , TheColumns(columns)
  , Reach(reach)
  , ElementsOf(columns.Elements())
{
}

bool LayerRoom::PartElsewhere(
  const std::vector<char>& kept, const std::vector<int>& nodes, std::vector<Fate>& fates) const
{
  bool any = false;
  std::vector<char> now = kept;
  for (const int node : nodes)
  {
    const auto elements = this->TheBand.ElementsOfNode(node);
    const auto isChanged = [&](int e) { return now[e] != kept[e]; };
    if (std::any_of(elements.begin(), elements.end(), isChanged))
    {
      continue; // for a node beside it
    }
    for (const int e : this->FindBest(node, now, fates))
    {
      fates[this->TheColumns.Column[e]] = kept[e] ? Fate::Eliminate : Fate::Keep;
      this->Turn(e, now);
      any = true;
    }
  }
  return any;
}

/// Elements at a node, one or two, whose columns may change their fates: of those that leave
/// fewer nodes without room, if there are any, the ones nearest to the surface; empty: none.
std::vector<int> LayerRoom::FindBest(
  int node, std::vector<char>& kept, const std::vector<Fate>& fates) const
{
  struct Offer
  {
    double Price;
    std::vector<int> Turned;
  };
  std::vector<Offer> offers;
  const auto offer = [&](std::vector<int> turned)
  {
    double price = 0.0;
    for (const int e : turned)
    {
      const double reach = this->Reach.Column[e];
      price += kept[e] ? 1.0 - reach : reach;
    }
    offers.push_back({ price, std::move(turned) });
  };
  const std::vector<int> free = this->FreeColumnsAt(node, fates);
  for (std::size_t i = 0; i < free.size(); ++i)
  {
    offer({ free[i] });
    for (std::size_t j = 0; j < i; ++j)
    {
      offer({ free[j], free[i] });
    }
  }
  if (offers.empty())
  {
    return {};
  }
  std::stable_sort(
    offers.begin(), offers.end(), [](const Offer& a, const Offer& b) { return a.Price < b.Price; });
  std::map<int, bool> lacking;
  const auto best = std::find_if(offers.begin(), offers.end(),
    [&](const Offer& o) { return this->GivesRoom(o.Turned, kept, lacking); });
  return best != offers.end() ? best->Turned : offers.front().Turned;
}

/// An element of each column at a node that may change its fate.
std::vector<int> LayerRoom::FreeColumnsAt(int node, const std::vector<Fate>& fates) const
{
  std::vector<int> free;
  std::vector<int> seen;
  for (const int e : this->TheBand.ElementsOfNode(node))
  {
    const int column = this->TheColumns.Column[e];
    if (fates[column] == Fate::ByVolume && this->TheBand.Elements[e].Ring < FirstFixedRing &&
      std::find(seen.begin(), seen.end(), column) == seen.end())
    {
      seen.push_back(column);
      free.push_back(e);
    }
  }
  return free;
}

bool LayerRoom::LacksRoom(const std::vector<char>& kept, int node) const
{
  return !IsManifoldAt(this->TheBand, kept, node) || !HasRoomForLayer(this->TheBand, kept, node);
}

/// Whether fewer nodes have no room when the columns of elements are turned round.
/// @param lacking by node, whether it has none now; grows.
bool LayerRoom::GivesRoom(
  const std::vector<int>& turned, std::vector<char>& kept, std::map<int, bool>& lacking) const
{
  const std::vector<int> nodes = this->NodesOf(turned);
  std::ptrdiff_t fewer = 0; // than now, while none is found that lacks room then
  for (const int node : nodes)
  {
    const auto [at, isNew] = lacking.try_emplace(node, false);
    if (isNew)
    {
      at->second = this->LacksRoom(kept, node);
    }
    fewer += at->second;
  }
  const auto turn = [&]
  { std::for_each(turned.begin(), turned.end(), [&](int e) { this->Turn(e, kept); }); };
  turn();
  for (auto node = nodes.begin(); fewer > 0 && node != nodes.end(); ++node)
  {
    fewer -= this->LacksRoom(kept, *node);
  }
  turn();
  return fewer > 0;
}

std::vector<int> LayerRoom::NodesOf(const std::vector<int>& columns) const
{
  std::vector<int> elements;
  for (const int e : columns)
  {
    const auto members = this->Members(e);
    elements.insert(elements.end(), members.begin(), members.end());
  }
  return trim::NodesOf(this->TheBand, elements);
}

Band::Range LayerRoom::Members(int e) const
{
  const int column = this->TheColumns.Column[e];
  return { this->ElementsOf.begin(column), this->ElementsOf.end(column) };
}

/// Turns the column of an element round.
void LayerRoom::Turn(int e, std::vector<char>& kept) const
{
  for (const int member : this->Members(e))
  {
    kept[member] = !kept[member];
  }
}

}
