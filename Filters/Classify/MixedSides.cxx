#include "MixedSides.h"

#include "Ranks.h"
#include "SortUnique.h"
#include "Status.h"

#include <algorithm>
#include <tuple>

namespace trim
{

Vec3 FindMixedPlace(const Ranks& ranks, const std::vector<MixedNode>& own)
{
  using Node = std::tuple<std::array<Id, 2>, Place, unsigned char>;
  std::vector<Node> nodes;
  for (const MixedNode& node : ranks.Gather(own))
  {
    nodes.emplace_back(node.Set, node.At, node.Side);
  }
  SortUnique(nodes); // those of several pieces once
  Place least{};
  bool found = false;
  for (auto begin = nodes.begin(), end = begin; begin != nodes.end(); begin = end)
  {
    end = std::find_if(begin, nodes.end(),
      [&](const Node& node) { return std::get<0>(node) != std::get<0>(*begin); });
    const auto kept =
      std::count_if(begin, end, [](const Node& node) { return std::get<2>(node) == NodeKeep; });
    const unsigned char few = 2 * kept < end - begin ? NodeKeep : NodeEliminate;
    const auto first =
      std::find_if(begin, end, [few](const Node& node) { return std::get<2>(node) == few; });
    if (first != end && (!found || std::get<1>(*first) < least))
    {
      least = std::get<1>(*first);
      found = true;
    }
  }
  return ToVec3(least);
}

}
