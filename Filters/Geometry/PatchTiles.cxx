#include "PatchTiles.h"

#include "SurfaceModel.h"

#include <algorithm>
#include <cmath>

namespace nurbs
{
namespace
{

constexpr int PatchesOfTile = 16;

/// How many patches a tile has along u, so that it is about as long as wide in the mean.
int TileAlongU(const std::vector<PatchShape>& shapes, int first, int count)
{
  Vec2 sum = Vec2::Zero();
  for (int k = first; k < first + count; ++k)
  {
    sum += shapes[k].Size;
  }
  const double along = std::round(std::sqrt(PatchesOfTile * sum.y() / sum.x()));
  return along < PatchesOfTile ? std::max(1, static_cast<int>(along)) : PatchesOfTile;
}

/// @param first of the face's patches.
void AddTiles(
  const FaceData& face, const std::vector<PatchShape>& shapes, int first, PatchTiles& tiles)
{
  const int countU = face.SpansU.Count(), countV = face.SpansV.Count();
  const int stepU = TileAlongU(shapes, first, countU * countV), stepV = PatchesOfTile / stepU;
  for (int v = 0; v < countV; v += stepV)
  {
    for (int u = 0; u < countU; u += stepU)
    {
      for (int j = v; j < std::min(v + stepV, countV); ++j)
      {
        for (int i = u; i < std::min(u + stepU, countU); ++i)
        {
          tiles.Patches.push_back(first + j * countU + i);
        }
      }
      tiles.Ends.push_back(static_cast<int>(tiles.Patches.size()));
    }
  }
}

}

PatchTiles TilePatches(const SurfaceModel& model, const std::vector<PatchShape>& shapes)
{
  const int count = static_cast<int>(model.Patches.size());
  PatchTiles tiles;
  tiles.Patches.reserve(count);
  while (static_cast<int>(tiles.Patches.size()) < count)
  {
    const int next = static_cast<int>(tiles.Patches.size());
    const BezierPatch& patch = model.Patches[next];
    if (!patch.Curve)
    {
      AddTiles(model.Data[patch.Face], shapes, next, tiles);
      continue;
    }
    for (int k = next; k < std::min(next + PatchesOfTile, count) && model.Patches[k].Curve; ++k)
    {
      tiles.Patches.push_back(k);
    }
    tiles.Ends.push_back(static_cast<int>(tiles.Patches.size()));
  }
  return tiles;
}

}
