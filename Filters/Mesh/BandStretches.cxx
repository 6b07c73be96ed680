#include "BandStretches.h"

#include "ConcurrentSets.h"
#include "Runs.h"

#include <utility>

namespace trim
{
namespace
{

/// Appends the band of a stretch.
/// @param stretch where it is in the band without layers.
void AppendCells(const Band& own, const BandStretch& stretch, BandCells& cells)
{
  const auto offset = static_cast<int>(cells.Nodes.size());
  for (int n = 0; n < own.NumberOfNodes(); ++n)
  {
    const Origin from{ stretch.Nodes[NodeWithoutLayer(own, n)], own.IsInsertedNode(n) };
    cells.Nodes.push_back(TakeNode(own, n, from));
  }
  for (int e = 0; e < own.NumberOfElements(); ++e)
  {
    const Origin from{ stretch.Elements[ElementWithoutLayer(own, e)], own.IsInserted(e) };
    cells.Cells.push_back(TakeElement(own, e, from, [offset](int n) { return offset + n; }));
  }
}

}

std::vector<BandStretch> FindStretches(const Band& band)
{
  ConcurrentSets<int> joined(band.NumberOfNodes());
  ForAll(
    band.NumberOfElements(),
    [&](int e)
    {
      const auto& element = band.Elements[e];
      for (int i = 1; i < element.Count; ++i)
      {
        joined.Unite(element.Node[0], element.Node[i]);
      }
    },
    LightGrain / 8);
  std::vector<int> ofRoot(band.NumberOfNodes(), -1);
  std::vector<BandStretch> stretches;
  for (int e = 0; e < band.NumberOfElements(); ++e)
  {
    int& number = ofRoot[joined.Find(band.Elements[e].Node[0])];
    if (number < 0)
    {
      number = static_cast<int>(stretches.size());
      stretches.emplace_back();
    }
    stretches[number].Elements.push_back(e);
  }
  for (int n = 0; n < band.NumberOfNodes(); ++n)
  {
    stretches[ofRoot[joined.Find(n)]].Nodes.push_back(n);
  }
  return stretches;
}

std::vector<Band> ExtractStretches(const Band& band, const std::vector<BandStretch>& stretches)
{
  std::vector<int> number(band.NumberOfNodes());
  std::vector<Band> bands;
  for (const BandStretch& stretch : stretches)
  {
    BandCells cells;
    for (const int n : stretch.Nodes)
    {
      number[n] = static_cast<int>(cells.Nodes.size());
      cells.Nodes.push_back(TakeNode(band, n, {}));
    }
    for (const int e : stretch.Elements)
    {
      cells.Cells.push_back(TakeElement(band, e, {}, [&number](int n) { return number[n]; }));
    }
    bands.emplace_back(std::move(cells), band.NumberOfRings(), band.SinglePrecision);
  }
  return bands;
}

Band JoinLayers(
  const std::vector<const Band*>& bands, Band whole, std::vector<BandStretch>& stretches)
{
  BandCells cells;
  std::vector<int> stretchOfNode(whole.NumberOfNodes()), stretchOfElement(whole.NumberOfElements());
  for (std::size_t s = 0; s < bands.size(); ++s)
  {
    AppendCells(*bands[s], stretches[s], cells);
    for (const int n : stretches[s].Nodes)
    {
      stretchOfNode[n] = static_cast<int>(s);
    }
    for (const int e : stretches[s].Elements)
    {
      stretchOfElement[e] = static_cast<int>(s);
    }
  }
  Band joined(std::move(cells), whole.NumberOfRings(), whole.SinglePrecision);
  // The order of places is the same in a stretch and in the whole.
  stretches.assign(bands.size(), BandStretch());
  for (int n = 0; n < joined.NumberOfNodes(); ++n)
  {
    stretches[stretchOfNode[joined.NodeOrigins[n].Index]].Nodes.push_back(n);
  }
  for (int e = 0; e < joined.NumberOfElements(); ++e)
  {
    stretches[stretchOfElement[joined.ElementOrigins[e].Index]].Elements.push_back(e);
  }
  joined.BeforeLayer = std::make_shared<const Band>(std::move(whole));
  return joined;
}

}
