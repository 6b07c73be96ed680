#include "LayerTrim.h"

#include "InsertedLayer.h"

#include <algorithm>
#include <utility>

namespace trim
{
namespace
{

/// Elements from this ring on keep their fate: the layer and those behind it need room in the band.
constexpr int FirstFixedRing = 2;
/// How often the fates of elements are changed to give a layer room.
constexpr int MostAttempts = 8;

/// By whole columns in a sheet, element by element in a block: there the layer makes up for it.
Columns ColumnsFor(const Band& band, bool isSheet)
{
  Columns columns = FindColumns(band);
  return isSheet && columns.HasThickness() && columns.Complete(band, 2)
    ? columns
    : NoColumns(band, std::move(columns.Part));
}

/// Of each element the largest share in its column.
VolumeShares LargestOfColumns(const VolumeShares& shares, const Columns& columns)
{
  VolumeShares reach = shares;
  std::vector<double> largest(shares.Element.size(), 0.0);
  for (std::size_t e = 0; e < largest.size(); ++e)
  {
    double& ofColumn = largest[columns.Column[e]];
    ofColumn = std::max(ofColumn, shares.Element[e]);
  }
  for (std::size_t e = 0; e < largest.size(); ++e)
  {
    reach.Column[e] = largest[columns.Column[e]];
  }
  return reach;
}

/// Where a layer has no room on faces, one of the columns beside changes its fate, rather the one
/// that is nearer to the surface. False if none may.
bool PartElsewhere(const Band& band, const Columns& columns, const VolumeShares& reach,
  const std::vector<char>& kept, const std::vector<int>& faces, std::vector<Fate>& fates)
{
  bool any = false;
  for (const int f : faces)
  {
    const auto& elements = band.Faces[f].Element;
    const int in = elements[kept[elements[0]] ? 0 : 1];
    const int out = elements[kept[elements[0]] ? 1 : 0];
    const bool moveIn = 1.0 - reach.Column[in] < reach.Column[out];
    for (const int e : { moveIn ? in : out, moveIn ? out : in })
    {
      Fate& fate = fates[columns.Column[e]];
      if (fate == Fate::ByVolume && band.Elements[e].Ring < FirstFixedRing)
      {
        fate = e == in ? Fate::Eliminate : Fate::Keep;
        any = true;
        break;
      }
    }
  }
  return any;
}

/// What is kept of the band and its layer; false if there is no room for one.
bool PutLayer(const TrimBand& near, const Columns& columns, double largestShare,
  const nurbs::TrimmingSurface& surface, double precision, std::vector<char>& kept,
  BandCells& cells)
{
  const Band& band = near.Mesh;
  const VolumeShares reach = LargestOfColumns(near.Shares, columns);
  Decision decision(band, columns, reach, surface, largestShare, false);
  const NodeMover mover(band, columns, surface, precision);
  std::vector<Fate> fates(band.NumberOfElements(), Fate::ByVolume);
  for (int attempt = 0; attempt < MostAttempts; ++attempt)
  {
    kept = decision.Take(fates);
    const auto noRoom = InsertLayer(band, columns, mover, kept, cells);
    if (noRoom.empty() || !PartElsewhere(band, columns, reach, kept, noRoom, fates))
    {
      return noRoom.empty();
    }
  }
  return false;
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
  std::vector<char> kept;
  BandCells cells;
  if (!PutLayer(near, columns, largestShare, surface, precision, kept, cells))
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
  TakeCloser(*layered, surface, precision, options);
  layered->Shares = SharesOfOrigins(band, near.Shares);
  for (const Origin& origin : band.ElementOrigins)
  {
    layered->SheetAxis.push_back(near.SheetAxis[origin.Index]);
  }
  TellInserted(band, layered->Trimmed.NodeMoves);
  return layered;
}

}
