#include "LayerTrim.h"

#include "InsertedLayer.h"

#include <algorithm>
#include <utility>

namespace trim
{
namespace
{

/// By whole columns in a sheet, element by element in a block: there the layer makes up for it.
Columns ColumnsFor(const Band& band, bool isSheet)
{
  Columns columns = FindColumns(band);
  return isSheet && columns.HasThickness() && columns.Complete(band, 2)
    ? columns
    : NoColumns(band, std::move(columns.Part));
}

/// What the layer is to stand on.
std::vector<char> FindKept(const TrimBand& near, const Columns& columns, double largestShare,
  const nurbs::TrimmingSurface& surface)
{
  VolumeShares reach = near.Shares;
  reach.Column.assign(near.Mesh.NumberOfElements(), 0.0);
  for (int e = 0; e < near.Mesh.NumberOfElements(); ++e)
  {
    double& ofColumn = reach.Column[columns.Column[e]];
    ofColumn = std::max(ofColumn, reach.Element[e]);
  }
  for (int e = 0; e < near.Mesh.NumberOfElements(); ++e)
  {
    reach.Column[e] = reach.Column[columns.Column[e]];
  }
  const std::vector<Fate> fates(near.Mesh.NumberOfElements(), Fate::ByVolume);
  return Decision(near.Mesh, columns, reach, surface, largestShare, false).Take(fates);
}

/// By which what is kept stays so, the layer with it, and nothing else.
VolumeShares SharesByFate(const Band& layered, const std::vector<char>& kept)
{
  VolumeShares shares;
  for (const Origin& origin : layered.ElementOrigins)
  {
    shares.Element.push_back(kept[origin.Index] ? 0.0 : 1.0);
  }
  shares.Column = shares.Element;
  return shares;
}

VolumeShares SharesOfOrigins(const Band& layered, const VolumeShares& shares)
{
  VolumeShares own;
  for (const Origin& origin : layered.ElementOrigins)
  {
    own.Volume.push_back(shares.Volume[origin.Index]);
    own.Element.push_back(shares.Element[origin.Index]);
    own.Column.push_back(shares.Column[origin.Index]);
  }
  return own;
}

/// Inserted nodes are moved where they lie elsewhere than those in whose place they are.
void TellInserted(const Band& layered, Moves& moves)
{
  for (int n = 0; n < layered.NumberOfNodes(); ++n)
  {
    if (layered.IsInsertedNode(n))
    {
      const bool moved =
        moves.Position[n] != layered.BeforeLayer->Point[layered.NodeOrigins[n].Index];
      moves.Applied[n] = moved ? Correction::Relax : Correction::None;
    }
  }
}

}

std::unique_ptr<TrimBand> TrimWithLayer(const TrimBand& near,
  const std::shared_ptr<const Band>& before, double largestShare,
  const nurbs::TrimmingSurface& surface, double precision, const BandOptions& options,
  const Progress& progress)
{
  const bool isSheet = near.Structure.HasThickness() && !near.Structure.ChosenByCut;
  const Columns columns = ColumnsFor(near.Mesh, isSheet);
  const std::vector<char> kept = FindKept(near, columns, largestShare, surface);
  BandCells cells;
  if (!InsertLayer(near.Mesh, NodeMover(near.Mesh, columns, surface, precision), kept, cells))
  {
    return nullptr;
  }
  auto layered = std::make_unique<TrimBand>(
    Band(std::move(cells), near.Mesh.NumberOfRings(), near.Mesh.SinglePrecision));
  layered->Mesh.BeforeLayer = before;
  const Band& band = layered->Mesh;
  layered->Structure = ColumnsFor(band, isSheet);
  layered->Shares = SharesByFate(band, kept);
  ClimbBand(*layered, surface, precision, options, progress);
  layered->Shares = SharesOfOrigins(band, near.Shares);
  for (const Origin& origin : band.ElementOrigins)
  {
    layered->SheetAxis.push_back(near.SheetAxis[origin.Index]);
  }
  TellInserted(band, layered->Trimmed.NodeMoves);
  return layered;
}

}
