#include "Manifold.h"

#include <algorithm>

namespace trim
{
namespace
{

struct FanFace
{
  int Before, After; ///< the neighbours of the node within the face
  int Group;
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
    fan.push_back({ face.Node[(at + face.Count - 1) % face.Count], face.Node[(at + 1) % face.Count],
      static_cast<int>(fan.size()) });
  }
  return fan;
}

}

bool IsManifoldAt(const Band& band, const std::vector<char>& kept, int node)
{
  auto fan = BoundaryFan(band, kept, node);
  if (fan.empty())
  {
    return true;
  }
  int groups = static_cast<int>(fan.size());
  for (std::size_t i = 0; i < fan.size(); ++i)
  {
    for (const int edgeEnd : { fan[i].Before, fan[i].After })
    {
      int sharing = 0;
      for (std::size_t j = 0; j < fan.size(); ++j)
      {
        if (j == i || (fan[j].Before != edgeEnd && fan[j].After != edgeEnd))
        {
          continue;
        }
        ++sharing;
        const int from = fan[j].Group;
        const int to = fan[i].Group;
        if (from != to)
        {
          --groups;
          for (auto& face : fan)
          {
            face.Group = face.Group == from ? to : face.Group;
          }
        }
      }
      if (sharing != 1)
      {
        return false;
      }
    }
  }
  return groups == 1;
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
