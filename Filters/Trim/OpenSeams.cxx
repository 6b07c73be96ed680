#include "OpenSeams.h"

#include "Place.h"
#include "SortUnique.h"

#include <algorithm>
#include <array>
#include <utility>

namespace trim
{
namespace
{

/// The corners of a face by their places, and the element it is of.
using Side = std::pair<std::array<Place, 4>, int>;

bool IsOnSkin(const TrimBand& near, const BandFace& face)
{
  const int element = face.Element[0];
  const int axis = near.SheetAxis[element];
  return axis >= 0 && TopologyOf(near.Mesh.Elements[element].Count).FaceAxis[face.Slot[0]] == axis;
}

std::vector<Side> OpenSides(const TrimBand& near)
{
  const Band& band = near.Mesh;
  std::vector<Side> sides;
  for (const BandFace& face : band.Faces)
  {
    const int element = face.Element[0];
    // What lies on a face of ring 0 is no farther than in the next ring.
    if (!face.Exterior || element < 0 || band.Elements[element].Ring > 1 || IsOnSkin(near, face))
    {
      continue;
    }
    Side side;
    side.first.fill(ToPlace(band.Point[face.Node[0]]));
    side.second = element;
    for (int i = 0; i < face.Count; ++i)
    {
      side.first[i] = ToPlace(band.Point[face.Node[i]]);
    }
    std::sort(side.first.begin(), side.first.end());
    sides.push_back(side);
  }
  std::sort(sides.begin(), sides.end());
  return sides;
}

}

std::vector<int> FindOpenSeams(const TrimBand& near)
{
  const std::vector<Side> sides = OpenSides(near);
  std::vector<int> elements;
  for (std::size_t i = 1; i < sides.size(); ++i)
  {
    if (sides[i].first == sides[i - 1].first)
    {
      for (const int e : { sides[i - 1].second, sides[i].second })
      {
        if (near.Mesh.Elements[e].Ring == 0)
        {
          elements.push_back(e);
        }
      }
    }
  }
  SortUnique(elements);
  return elements;
}

}
