#include "StretchTrims.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <utility>

namespace trim
{
namespace
{

/// A list by the items of a stretch into one by the items of the whole; an empty one has zeros.
template <typename Value>
void Scatter(const std::vector<Value>& own, const std::vector<int>& places, int count,
  std::vector<Value>& whole)
{
  if (own.empty())
  {
    return;
  }
  whole.resize(count);
  for (std::size_t i = 0; i < own.size(); ++i)
  {
    whole[places[i]] = own[i];
  }
}

/// The same where the values are items themselves.
void ScatterItems(
  const std::vector<int>& own, const std::vector<int>& places, int count, std::vector<int>& whole)
{
  whole.resize(count);
  for (std::size_t i = 0; i < own.size(); ++i)
  {
    whole[places[i]] = places[own[i]];
  }
}

template <typename Value>
std::vector<Value> ValuesAt(const std::vector<Value>& whole, const std::vector<int>& places)
{
  std::vector<Value> own;
  for (std::size_t i = 0; i < places.size() && !whole.empty(); ++i)
  {
    own.push_back(whole[places[i]]);
  }
  return own;
}

/// The same where the values are items of the stretch.
std::vector<int> GatherItems(const std::vector<int>& whole, const std::vector<int>& places)
{
  std::vector<int> own = ValuesAt(whole, places);
  for (int& item : own)
  {
    item = static_cast<int>(std::lower_bound(places.begin(), places.end(), item) - places.begin());
  }
  return own;
}

void Append(const std::vector<int>& own, const std::vector<int>& places, std::vector<int>& whole)
{
  std::transform(own.begin(), own.end(), std::back_inserter(whole),
    [&places](int item) { return places[item]; });
}

/// The items of an element that are used.
template <std::size_t N>
void Renumber(const std::vector<int>& places, int count, std::array<int, N>& items)
{
  for (int i = 0; i < count; ++i)
  {
    items[i] = items[i] >= 0 ? places[items[i]] : items[i];
  }
}

Columns ExtractColumns(const Columns& whole, const BandStretch& stretch)
{
  Columns own;
  own.Axis = ValuesAt(whole.Axis, stretch.Elements);
  own.Column = GatherItems(whole.Column, stretch.Elements);
  own.Pillar = GatherItems(whole.Pillar, stretch.Nodes);
  own.Part = ValuesAt(whole.Part, stretch.Elements);
  own.ChosenByCut = ValuesAt(whole.ChosenByCut, stretch.Nodes);
  return own;
}

/// Where stretches are in a band, and its size.
struct Target
{
  const BandStretch& Stretch;
  int Nodes, Elements;
};

void AddColumns(const Columns& own, const Target& to, Columns& whole)
{
  const auto& elements = to.Stretch.Elements;
  Scatter(own.Axis, elements, to.Elements, whole.Axis);
  ScatterItems(own.Column, elements, to.Elements, whole.Column);
  ScatterItems(own.Pillar, to.Stretch.Nodes, to.Nodes, whole.Pillar);
  Scatter(own.ChosenByCut, to.Stretch.Nodes, to.Nodes, whole.ChosenByCut);
  // Parts are told apart by their first elements, as their numbers are those of the stretch.
  whole.Part.resize(to.Elements);
  std::map<int, int> first;
  for (std::size_t e = 0; e < elements.size(); ++e)
  {
    const int part = own.Part.empty() ? 0 : own.Part[e];
    whole.Part[elements[e]] = first.emplace(part, elements[e]).first->second;
  }
}

void AddMoves(const Moves& own, const Target& to, Moves& whole)
{
  const auto& nodes = to.Stretch.Nodes;
  Scatter(own.Position, nodes, to.Nodes, whole.Position);
  Scatter(own.Applied, nodes, to.Nodes, whole.Applied);
  Scatter(own.Failed, nodes, to.Nodes, whole.Failed);
  Scatter(own.Left, nodes, to.Nodes, whole.Left);
}

void AddPentahedra(const Pentahedra& own, const Target& to, Pentahedra& whole)
{
  const auto& elements = to.Stretch.Elements;
  whole.Count += own.Count;
  for (ReplacedElement wedge : own.Wedges)
  {
    wedge.Element = elements[wedge.Element];
    Renumber(to.Stretch.Nodes, 6, wedge.Node);
    Renumber(to.Stretch.Nodes, 2, wedge.Dropped);
    whole.Wedges.push_back(wedge);
  }
  Scatter(own.Exposed, elements, to.Elements, whole.Exposed);
  Scatter(own.FlatCorner, elements, to.Elements, whole.FlatCorner);
}

void AddTrimmed(const TrimmedBand& own, const Target& to, TrimmedBand& whole)
{
  const auto& nodes = to.Stretch.Nodes;
  const auto& elements = to.Stretch.Elements;
  Scatter(own.Kept, elements, to.Elements, whole.Kept);
  AddMoves(own.NodeMoves, to, whole.NodeMoves);
  AddMoves(own.Unrelaxed, to, whole.Unrelaxed);
  AddPentahedra(own.Treated, to, whole.Treated);
  Scatter(own.RescuedBy, elements, to.Elements, whole.RescuedBy);
  Scatter(own.AgainstVolume, elements, to.Elements, whole.AgainstVolume);
  Scatter(own.Relaxed, elements, to.Elements, whole.Relaxed);
  Append(own.BelowFloor, elements, whole.BelowFloor);
  Append(own.Invalid, elements, whole.Invalid);
  Scatter(own.Moving, nodes, to.Nodes, whole.Moving);
  Scatter(own.OnCrease, nodes, to.Nodes, whole.OnCrease);
}

void AddOffcut(const Offcut& own, const Target& to, Offcut& whole)
{
  AddMoves(own.NodeMoves, to, whole.NodeMoves);
  for (OffcutElement element : own.Elements)
  {
    element.Element = to.Stretch.Elements[element.Element];
    Renumber(to.Stretch.Nodes, element.Count, element.Node);
    whole.Elements.push_back(element);
  }
  Append(own.BelowFloor, to.Stretch.Elements, whole.BelowFloor);
  Append(own.Invalid, to.Stretch.Elements, whole.Invalid);
}

/// What was appended stretch by stretch, by ascending element again.
void SortElements(BandTrim& whole)
{
  const auto before = [](const auto& a, const auto& b) { return a.Element < b.Element; };
  std::stable_sort(
    whole.Trimmed.Treated.Wedges.begin(), whole.Trimmed.Treated.Wedges.end(), before);
  std::stable_sort(whole.Rest.Elements.begin(), whole.Rest.Elements.end(), before);
  for (auto* list : { &whole.Trimmed.BelowFloor, &whole.Trimmed.Invalid, &whole.Rest.BelowFloor,
         &whole.Rest.Invalid })
  {
    std::sort(list->begin(), list->end());
  }
  std::sort(whole.NodesLeft.begin(), whole.NodesLeft.end());
}

}

StretchTrims::StretchTrims(TrimBand& whole)
  : Whole(whole)
  , Stretches(FindStretches(whole.Mesh))
{
  if (this->Stretches.size() < 2)
  {
    return;
  }
  for (Band& band : ExtractStretches(whole.Mesh, this->Stretches))
  {
    const BandStretch& stretch = this->Stretches[this->Own.size()];
    this->Own.emplace_back(std::move(band));
    this->Own.back().Structure = ExtractColumns(whole.Structure, stretch);
    this->Own.back().SheetAxis = ValuesAt(whole.SheetAxis, stretch.Elements);
  }
}

void StretchTrims::Join()
{
  if (this->Own.empty())
  {
    return;
  }
  Band mesh = std::move(this->Whole.Mesh);
  if (std::any_of(this->Own.begin(), this->Own.end(),
        [](const TrimBand& own) { return own.Mesh.BeforeLayer != nullptr; }))
  {
    std::vector<const Band*> bands;
    for (const TrimBand& own : this->Own)
    {
      bands.push_back(&own.Mesh);
    }
    mesh = JoinLayers(bands, std::move(mesh), this->Stretches);
  }
  this->Whole = TrimBand(std::move(mesh));
  for (std::size_t s = 0; s < this->Own.size(); ++s)
  {
    this->Add(this->Stretches[s], this->Own[s]);
  }
  SortElements(this->Whole);
}

void StretchTrims::Add(const BandStretch& stretch, const TrimBand& own)
{
  const Target to{ stretch, this->Whole.Mesh.NumberOfNodes(), this->Whole.Mesh.NumberOfElements() };
  AddColumns(own.Structure, to, this->Whole.Structure);
  Scatter(own.SheetAxis, stretch.Elements, to.Elements, this->Whole.SheetAxis);
  Scatter(own.Shares.Volume, stretch.Elements, to.Elements, this->Whole.Shares.Volume);
  Scatter(own.Shares.Element, stretch.Elements, to.Elements, this->Whole.Shares.Element);
  Scatter(own.Shares.Column, stretch.Elements, to.Elements, this->Whole.Shares.Column);
  AddTrimmed(own.Trimmed, to, this->Whole.Trimmed);
  AddOffcut(own.Rest, to, this->Whole.Rest);
  for (const auto& [node, distance] : own.NodesLeft)
  {
    this->Whole.NodesLeft.emplace_back(stretch.Nodes[node], distance);
  }
}

}
