#include "GatherBand.h"

#include "NodeNumbers.h"
#include "Place.h"
#include "PlaceText.h"

#include <algorithm>
#include <unordered_map>

namespace trim
{
namespace
{

struct SentNode
{
  Id Number; ///< over all ranks
  Place At;
  unsigned char Status;
};

struct SentCell
{
  Id Global; ///< on its rank
  int Count;
  int Ring;
  unsigned char Status;
  std::array<Id, 8> Node; ///< numbers over all ranks
};

/// An error text if two cells lie at one place; else empty. Nodes inside a piece are known to that
/// piece alone, so the places are compared and not the numbers.
std::string FindRepeatedCell(const BandCells& band)
{
  std::vector<std::vector<Place>> keys;
  for (const auto& cell : band.Cells)
  {
    std::vector<Place> key;
    for (int i = 0; i < cell.Count; ++i)
    {
      key.push_back(ToPlace(band.Nodes[cell.Node[i]].Point));
    }
    std::sort(key.begin(), key.end());
    keys.push_back(std::move(key));
  }
  std::sort(keys.begin(), keys.end());
  const auto repeated = std::adjacent_find(keys.begin(), keys.end());
  return repeated == keys.end() ? std::string()
                                : "Several ranks have the same cell, or one has it twice, at " +
      nurbs::PlaceText(ToVec3(repeated->front())) +
      ": distribute the grid, e.g. with Redistribute DataSet, and mark copies of other ranks' "
      "cells as ghosts, or remove one of two cells that are the same.";
}

}

SpreadRing SpreadAcrossPieces(const Piece& piece)
{
  if (piece.All.Alone())
  {
    return {};
  }
  return [&piece](std::vector<Id>& nodes)
  {
    std::vector<Id> mine;
    for (const Id node : nodes)
    {
      const Id number = piece.Shared.NumberOf(node);
      if (number >= 0)
      {
        mine.push_back(number);
      }
    }
    for (const Id number : piece.All.Gather(mine))
    {
      if (piece.Shared.LocalByNumber[number] >= 0)
      {
        nodes.push_back(piece.Shared.LocalByNumber[number]);
      }
    }
  };
}

bool GatherBandCells(const HexMesh& mesh, const Piece& piece, BandCells& band, std::string& error)
{
  if (piece.All.Alone())
  {
    return true;
  }
  const NodeNumbers numbers(mesh, piece);
  std::vector<SentNode> nodes;
  for (const auto& node : band.Nodes)
  {
    nodes.push_back({ numbers.NumberOf(node.Global), ToPlace(node.Point), node.Status });
  }
  std::vector<SentCell> cells;
  for (const auto& cell : band.Cells)
  {
    SentCell sent{ cell.Global, cell.Count, cell.Ring, cell.Status, {} };
    for (int i = 0; i < cell.Count; ++i)
    {
      sent.Node[i] = nodes[cell.Node[i]].Number;
    }
    cells.push_back(sent);
  }
  band = BandCells{};
  std::unordered_map<Id, int> at;
  for (const auto& node : piece.All.Gather(nodes))
  {
    if (at.emplace(node.Number, static_cast<int>(band.Nodes.size())).second)
    {
      band.Nodes.push_back({ numbers.LocalOf(node.Number), ToVec3(node.At), node.Status });
    }
  }
  std::vector<std::size_t> ends;
  const auto all = piece.All.Gather(cells, ends);
  const int self = piece.All.Rank();
  const std::size_t first = self > 0 ? ends[self - 1] : 0;
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    const auto& sent = all[i];
    const bool own = i >= first && i < ends[self];
    BandCells::Cell cell{ own ? sent.Global : -1, sent.Count, sent.Ring, sent.Status, {} };
    for (int k = 0; k < cell.Count; ++k)
    {
      cell.Node[k] = at[sent.Node[k]];
    }
    band.Cells.push_back(cell);
  }
  error = FindRepeatedCell(band);
  return error.empty();
}

}
