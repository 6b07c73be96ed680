#include "PieceSides.h"

#include "DisjointSets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace trim
{
namespace
{

struct SentProjection
{
  Id Number;
  float SignedDistance;
  unsigned char Status;
};

struct SentVote
{
  Id Number;
  SideVote Vote;
};

/// A shared node and the set that it belongs to on one rank, numbered on that rank.
struct SentMember
{
  Id Number;
  Id Set;
};

struct SentOutermost
{
  Id Part;
  OutermostNodes Nodes;
};

/// Order of two places along one axis, the other coordinates deciding where they are level.
bool ComesBefore(const Place& a, const Place& b, int axis)
{
  for (int k = 0; k < 3; ++k)
  {
    const int i = (axis + k) % 3;
    if (a[i] != b[i])
    {
      return a[i] < b[i];
    }
  }
  return false;
}

}

void ShareProjections(const Piece& piece, NodeClassification& nodes)
{
  if (piece.All.Alone())
  {
    return;
  }
  auto& distances = nodes.SignedDistances;
  const auto comesBefore = [](const auto& a, const auto& b) { return a.first < b.first; };
  std::vector<SentProjection> mine;
  for (std::size_t i = 0; i < piece.Shared.Local.size(); ++i)
  {
    std::pair<Id, float> own(piece.Shared.Local[i], std::numeric_limits<float>::quiet_NaN());
    const auto at = std::lower_bound(distances.begin(), distances.end(), own, comesBefore);
    const bool projected = at != distances.end() && at->first == own.first;
    if (nodes.Status[own.first] != NodeUnknown || projected)
    {
      own.second = projected ? at->second : own.second;
      mine.push_back({ piece.Shared.Number[i], own.second, nodes.Status[own.first] });
    }
  }
  for (const auto& sent : piece.All.Gather(mine))
  {
    const Id node = piece.Shared.LocalByNumber[sent.Number];
    if (node >= 0)
    {
      nodes.Status[node] = sent.Status;
      if (std::isfinite(sent.SignedDistance))
      {
        distances.emplace_back(node, sent.SignedDistance);
      }
    }
  }
  // Where several ranks projected a node, they found the same.
  std::stable_sort(distances.begin(), distances.end(), comesBefore);
  distances.erase(std::unique(distances.begin(), distances.end(),
                    [](const auto& a, const auto& b) { return a.first == b.first; }),
    distances.end());
}

void ShareVotes(const Piece& piece, std::vector<NodeVote>& votes)
{
  if (piece.All.Alone())
  {
    return;
  }
  std::vector<SentVote> mine;
  for (const auto& vote : votes)
  {
    const Id number = piece.Shared.NumberOf(vote.Node);
    if (number >= 0)
    {
      mine.push_back({ number, vote.Vote });
    }
  }
  for (const auto& sent : piece.All.Gather(mine))
  {
    const Id node = piece.Shared.LocalByNumber[sent.Number];
    if (node >= 0)
    {
      votes.push_back({ node, sent.Vote });
    }
  }
}

void OutermostNodes::Add(const Place& p)
{
  for (int k = 0; k < 3; ++k)
  {
    if (this->Empty || ComesBefore(p, this->Most[2 * k], k))
    {
      this->Most[2 * k] = p;
    }
    if (this->Empty || ComesBefore(this->Most[2 * k + 1], p, k))
    {
      this->Most[2 * k + 1] = p;
    }
  }
  this->Empty = false;
}

void OutermostNodes::Add(const OutermostNodes& other)
{
  for (const Place& p : other.Most)
  {
    this->Add(p);
  }
}

bool JoinedSets::Join(const Piece& piece, const std::function<Id(Id)>& rootOf, SetSides& ofRoot)
{
  if (piece.All.Alone())
  {
    return true;
  }
  // Sets with shared nodes, numbered rank by rank.
  std::map<Id, Id> setOfRoot;
  std::vector<unsigned char> sides;
  std::vector<SentMember> members;
  for (std::size_t i = 0; i < piece.Shared.Local.size(); ++i)
  {
    const Id root = rootOf(piece.Shared.Local[i]);
    const auto set = setOfRoot.emplace(root, static_cast<Id>(setOfRoot.size()));
    if (set.second)
    {
      sides.push_back(ofRoot.Of(root));
    }
    members.push_back({ piece.Shared.Number[i], set.first->second });
  }
  std::vector<std::size_t> setEnds;
  std::vector<std::size_t> memberEnds;
  const auto allSides = piece.All.Gather(sides, setEnds);
  const auto allMembers = piece.All.Gather(members, memberEnds);

  nurbs::DisjointSets<Id> joined(static_cast<Id>(allSides.size()));
  std::vector<Id> setOfNumber(piece.Shared.Total(), -1);
  int rank = 0;
  for (std::size_t i = 0; i < allMembers.size(); ++i)
  {
    while (i >= memberEnds[rank])
    {
      ++rank;
    }
    const Id first = rank > 0 ? static_cast<Id>(setEnds[rank - 1]) : 0;
    const Id set = first + allMembers[i].Set;
    Id& known = setOfNumber[allMembers[i].Number];
    if (known >= 0)
    {
      joined.Unite(known, set);
    }
    known = set;
  }
  std::vector<unsigned char> sideOfPart(allSides.size(), NodeUnknown);
  bool contradiction = false;
  for (std::size_t set = 0; set < allSides.size(); ++set)
  {
    auto& side = sideOfPart[joined.Find(static_cast<Id>(set))];
    side = JoinedSide(side, allSides[set]);
    contradiction |= side == NodeOnBothSides;
  }
  const int self = piece.All.Rank();
  const Id first = self > 0 ? static_cast<Id>(setEnds[self - 1]) : 0;
  for (const auto& set : setOfRoot)
  {
    const Id part = joined.Find(first + set.second);
    ofRoot.Set(set.first, sideOfPart[part]);
    this->Parts.emplace_back(set.first, part);
  }
  return !contradiction;
}

Id JoinedSets::PartOf(Id root) const
{
  const auto it =
    std::lower_bound(this->Parts.begin(), this->Parts.end(), std::make_pair(root, Id(-1)));
  return it != this->Parts.end() && it->first == root ? it->second : -1;
}

void JoinedSets::ShareOutermost(
  const Piece& piece, std::vector<std::pair<Id, OutermostNodes>>& parts) const
{
  if (piece.All.Alone())
  {
    return;
  }
  std::vector<SentOutermost> mine;
  for (const auto& part : parts)
  {
    const Id number = this->PartOf(part.first);
    if (number >= 0)
    {
      mine.push_back({ number, part.second });
    }
  }
  std::map<Id, OutermostNodes> whole;
  for (const auto& sent : piece.All.Gather(mine))
  {
    whole[sent.Part].Add(sent.Nodes);
  }
  for (auto& part : parts)
  {
    const auto found = whole.find(this->PartOf(part.first));
    if (found != whole.end())
    {
      part.second = found->second;
    }
  }
}

}
