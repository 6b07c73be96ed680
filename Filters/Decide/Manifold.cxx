#include "Manifold.h"

#include "DisjointSets.h"

#include <algorithm>
#include <utility>

namespace trim
{
namespace
{

struct FanFace
{
  int Before, After; ///< the neighbours of the node within the face
};

std::vector<FanFace> BoundaryFan(const Band& band, const std::vector<char>& kept, int node)
{
  std::vector<FanFace> fan;
  for (const int f : band.FacesOfNode(node))
  {
    const auto& face = band.Faces[f];
    const bool first = kept[face.Element[0]] != 0;
    const bool second = face.Element[1] >= 0 && kept[face.Element[1]] != 0;
    if (first == second)
    {
      continue;
    }
    const int at = CornerOf(face, node);
    fan.push_back(
      { face.Node[(at + face.Count - 1) % face.Count], face.Node[(at + 1) % face.Count] });
  }
  return fan;
}

}

bool IsManifoldAt(const Band& band, const std::vector<char>& kept, int node)
{
  const std::vector<FanFace> fan = BoundaryFan(band, kept, node);
  // By the other ends of the edges, each with its face: at an axis there are thousands.
  std::vector<std::pair<int, int>> ends;
  ends.reserve(2 * fan.size());
  for (const FanFace& face : fan)
  {
    const auto index = static_cast<int>(&face - fan.data());
    ends.insert(ends.end(), { { face.Before, index }, { face.After, index } });
  }
  std::sort(ends.begin(), ends.end());
  nurbs::DisjointSets<int> joined(static_cast<int>(fan.size()));
  for (std::size_t i = 0; i < ends.size(); i += 2)
  {
    const bool areTwo = ends[i].first == ends[i + 1].first &&
      (i + 2 == ends.size() || ends[i + 2].first != ends[i].first);
    if (!areTwo)
    {
      return false;
    }
    joined.Unite(ends[i].second, ends[i + 1].second);
  }
  for (int face = 1; face < joined.Size(); ++face)
  {
    if (joined.Find(face) != 0)
    {
      return false;
    }
  }
  return true;
}

std::vector<int> FindPinchedEdgesAt(const Band& band, const std::vector<char>& kept, int node)
{
  std::vector<int> ends;
  for (const FanFace& face : BoundaryFan(band, kept, node))
  {
    ends.insert(ends.end(), { face.Before, face.After });
  }
  std::sort(ends.begin(), ends.end());
  std::vector<int> pinched;
  for (std::size_t i = 2; i < ends.size(); ++i)
  {
    if (ends[i] == ends[i - 2] && (pinched.empty() || pinched.back() != ends[i]))
    {
      pinched.push_back(ends[i]);
    }
  }
  return pinched;
}

}
