#include "PieceTracing.h"

#include <algorithm>
#include <map>

namespace nurbs
{
namespace
{

/// Chains by either end, until they are taken.
class OpenChains
{
public:
  void Add(const Chain& chain)
  {
    this->ByEnd.emplace(chain.front(), &chain);
    this->ByEnd.emplace(chain.back(), &chain);
  }

  /// One that ends at a point; null: there is none.
  const Chain* At(int end) const
  {
    const auto found = this->ByEnd.find(end);
    return found == this->ByEnd.end() ? nullptr : found->second;
  }

  /// False if it is taken already.
  bool Take(const Chain& chain)
  {
    for (const int end : { chain.front(), chain.back() })
    {
      const auto range = this->ByEnd.equal_range(end);
      const auto found = std::find_if(
        range.first, range.second, [&chain](const auto& entry) { return entry.second == &chain; });
      if (found == range.second)
      {
        return false;
      }
      this->ByEnd.erase(found);
    }
    return true;
  }

private:
  std::multimap<int, const Chain*> ByEnd;
};

}

std::vector<Chain> TracePieces(const std::vector<Chain>& arcs, const std::vector<Chain>& chains)
{
  OpenChains open;
  for (const std::vector<Chain>* list : { &arcs, &chains })
  {
    for (const Chain& link : *list)
    {
      open.Add(link);
    }
  }
  std::vector<Chain> pieces;
  // Every piece has an arc; run along the arc's direction it is counter-clockwise.
  for (const Chain& arc : arcs)
  {
    if (!open.Take(arc))
    {
      continue;
    }
    Chain piece(arc.begin(), arc.end() - 1);
    int end = arc.back();
    for (const Chain* next = open.At(end); end != arc.front() && next; next = open.At(end))
    {
      const bool forward = next->front() == end;
      open.Take(*next);
      forward ? piece.insert(piece.end(), next->begin(), next->end() - 1)
              : piece.insert(piece.end(), next->rbegin(), next->rend() - 1);
      end = forward ? next->back() : next->front();
    }
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

}
