#include "FailedReturns.h"

#include "NodesOfElements.h"

#include <algorithm>

namespace trim
{
namespace
{

void AppendShape(const Band& band, const RelaxedElement& shape, int e, FailedReturns::Key& key)
{
  AppendBytes(e, key);
  AppendBytes(static_cast<char>(shape.Count), key);
  if (shape.Count > 0 && shape.Count != band.Elements[e].Count)
  {
    std::for_each(shape.begin(), shape.end(), [&key](int node) { AppendBytes(node, key); });
  }
}

}

FailedReturns::Key StateRound(const RelaxedMesh& mesh, const std::vector<char>& fixed,
  const std::vector<int>& elements, int rings)
{
  const Band& band = mesh.TheBand;
  const std::vector<int> round = RingsRound(band, elements, rings);
  FailedReturns::Key key;
  for (const int e : round)
  {
    AppendShape(band, mesh.Elements[e], e, key);
  }
  for (const int node : NodesOf(band, round))
  {
    const Vec3& place = mesh.TheMoves.Position[node];
    for (int c = 0; c < 3; ++c)
    {
      AppendBytes(place[c], key);
    }
    key.push_back(static_cast<char>(
      4 * (fixed[node] != 0) + 2 * (mesh.OnCut[node] != 0) + (mesh.TheMoves.Left[node] != 0)));
  }
  return key;
}

}
