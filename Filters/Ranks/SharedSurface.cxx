#include "SharedSurface.h"

#include "SurfaceBytes.h"

#include <set>
#include <string>

namespace trim
{

std::vector<nurbs::NurbsSurface> ShareFaces(
  const Ranks& ranks, const std::vector<nurbs::NurbsSurface>& own)
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
  std::vector<nurbs::NurbsSurface> faces;
  std::set<std::string> seen;
  nurbs::Unpacker ofAll(all);
  while (!ofAll.AtEnd())
  {
    const auto [bytes, isNew] = seen.insert(ofAll.TakeText());
    if (isNew)
    {
      nurbs::Unpacker unpacker(*bytes);
      faces.push_back(nurbs::UnpackSurface(unpacker));
    }
  }
  return faces;
}

}
