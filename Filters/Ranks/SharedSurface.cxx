#include "SharedSurface.h"

#include "SurfaceBytes.h"

#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace trim
{

std::vector<nurbs::NurbsSurface> ShareFaces(
  const Ranks& ranks, const std::vector<nurbs::NurbsSurface>& own, const std::vector<Id>& blocks)
{
  if (ranks.Alone() && own.size() < 2)
  {
    return own;
  }
  nurbs::Packer mine;
  for (const auto& face : own)
  {
    nurbs::Packer packer;
    nurbs::PackSurface(packer, face);
    mine.PutText(packer.Bytes);
  }
  const auto gathered = ranks.Gather(std::vector<char>(mine.Bytes.begin(), mine.Bytes.end()));
  const std::string all(gathered.begin(), gathered.end());
  std::vector<std::pair<Id, std::string>> ordered;
  nurbs::Unpacker ofAll(all);
  for (const Id block : ranks.Gather(blocks))
  {
    ordered.emplace_back(block, ofAll.TakeText());
  }
  std::stable_sort(
    ordered.begin(), ordered.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<nurbs::NurbsSurface> faces;
  std::set<std::string_view> seen;
  for (const auto& face : ordered)
  {
    if (seen.insert(face.second).second)
    {
      nurbs::Unpacker unpacker(face.second);
      faces.push_back(nurbs::UnpackSurface(unpacker));
    }
  }
  return faces;
}

}
