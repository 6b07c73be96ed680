#include "GatherBand.h"

#include "NodeNumbers.h"
#include "Place.h"
#include "PlaceText.h"

#include <algorithm>
#include <tuple>
#include <unordered_map>

namespace trim
{
namespace
{

struct SentNode
{
  Id Number;   ///< over all ranks
  Id GlobalId; ///< the same, if there are none
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

/// A cell by what tells it apart.
struct CellName
{
  std::vector<Place> At; ///< of its nodes, ascending
  std::vector<Id> Node;  ///< their global ids, or else their numbers over all ranks, ascending
  int Owner;             ///< the rank that these numbers mean something to; -1: to all

  bool operator<(const CellName& other) const
  {
    return std::tie(this->At, this->Owner, this->Node) <
      std::tie(other.At, other.Owner, other.Node);
  }
  /// Nodes within a piece are known to that piece alone: those of another one at the same places
  /// are others only if global ids say so.
  bool IsSame(const CellName& other) const
  {
    return this->At == other.At && (this->Owner != other.Owner || this->Node == other.Node);
  }
};

/// The rank that each of the cells comes from.
/// @param ends one past the last cell of each rank.
std::vector<int> OwnersOf(const std::vector<std::size_t>& ends)
{
  std::vector<int> owners;
  for (std::size_t rank = 0; rank < ends.size(); ++rank)
  {
    owners.resize(ends[rank], static_cast<int>(rank));
  }
  return owners;
}

/// An error text if two cells are the same; else empty.
/// @param ids of the band's nodes: global ids, or numbers over all ranks.
/// @param owners of each cell, see CellName.
std::string FindRepeatedCell(
  const BandCells& band, const std::vector<Id>& ids, const std::vector<int>& owners)
{
  std::vector<CellName> names;
  for (std::size_t c = 0; c < band.Cells.size(); ++c)
  {
    CellName name{ {}, {}, owners[c] };
    for (const int node : band.Cells[c])
    {
      name.At.push_back(ToPlace(band.Nodes[node].Point));
      name.Node.push_back(ids[node]);
    }
    std::sort(name.At.begin(), name.At.end());
    std::sort(name.Node.begin(), name.Node.end());
    names.push_back(std::move(name));
  }
  std::sort(names.begin(), names.end());
  const auto repeated = std::adjacent_find(
    names.begin(), names.end(), [](const CellName& a, const CellName& b) { return a.IsSame(b); });
  return repeated == names.end() ? std::string()
                                 : "Several ranks have the same cell, or one has it twice, at " +
      nurbs::PlaceText(ToVec3(repeated->At.front())) +
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
    const Id number = numbers.NumberOf(node.Global);
    const Id id = piece.GlobalIds ? piece.GlobalIds[node.Global] : number;
    nodes.push_back({ number, id, ToPlace(node.Point), node.Status });
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
  std::vector<Id> ids;
  for (const auto& node : piece.All.Gather(nodes))
  {
    if (at.emplace(node.Number, static_cast<int>(band.Nodes.size())).second)
    {
      band.Nodes.push_back({ numbers.LocalOf(node.Number), ToVec3(node.At), node.Status });
      ids.push_back(node.GlobalId);
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
  const bool useIds = piece.All.Any(piece.GlobalIds != nullptr);
  error = FindRepeatedCell(band, ids, useIds ? std::vector<int>(all.size(), -1) : OwnersOf(ends));
  return error.empty();
}

}
