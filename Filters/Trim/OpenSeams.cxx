#include "OpenSeams.h"

#include "Facet.h"
#include "SortUnique.h"

#include <algorithm>
#include <cstddef>

namespace trim
{
namespace
{

/// How far beside each other faces may lie, of their size: places are rounded.
constexpr double Closeness = 1e-6;

/// A face that no other element shares.
struct Side
{
  FacetSearch Search;
  int Element;
  Vec3 Low, High, Middle;

  double Size() const { return (this->High - this->Low).norm(); }
};

bool IsOnSkin(const TrimBand& near, const BandFace& face)
{
  const int element = face.Element[0];
  const int axis = near.SheetAxis[element];
  return axis >= 0 && TopologyOf(near.Mesh.Elements[element].Count).FaceAxis[face.Slot[0]] == axis;
}

Side ToSide(const Band& band, const BandFace& face)
{
  const Vec3& first = band.Point[face.Node[0]];
  Side side{ FacetSearch(Facet(band, face)), face.Element[0], first, first, Vec3::Zero() };
  for (const int node : face)
  {
    const Vec3& corner = band.Point[node];
    side.Low = side.Low.cwiseMin(corner);
    side.High = side.High.cwiseMax(corner);
    side.Middle += corner / face.Count;
  }
  return side;
}

std::vector<Side> OpenSides(const TrimBand& near)
{
  const Band& band = near.Mesh;
  std::vector<Side> sides;
  for (const BandFace& face : band.Faces)
  {
    const int element = face.Element[0];
    // What lies on a face of ring 0 is no farther than in the next ring.
    if (face.Exterior && element >= 0 && band.Elements[element].Ring <= 1 && !IsOnSkin(near, face))
    {
      sides.push_back(ToSide(band, face));
    }
  }
  return sides;
}

/// Whether the middle of a face lies on another: faces that share nodes only meet at their borders.
bool LiesOn(const Side& side, const Side& other)
{
  Vec3 on;
  return other.Search.FindInside(side.Middle, 0.0, on) &&
    (on - side.Middle).norm() <= Closeness * other.Size();
}

bool MayTouch(const Side& a, const Side& b)
{
  const double close = Closeness * (a.Size() + b.Size());
  return ((a.Low - b.High).array() <= close).all() && ((b.Low - a.High).array() <= close).all();
}

/// The direction in which the sides reach farthest: along it most of them are apart.
int LongestAxis(const std::vector<Side>& sides)
{
  Vec3 low = sides[0].Low, high = sides[0].High;
  for (const Side& side : sides)
  {
    low = low.cwiseMin(side.Low);
    high = high.cwiseMax(side.High);
  }
  int axis = 0;
  (high - low).maxCoeff(&axis);
  return axis;
}

}

std::vector<int> FindOpenSeams(const TrimBand& near)
{
  std::vector<Side> sides = OpenSides(near);
  std::vector<int> elements;
  const int axis = sides.empty() ? 0 : LongestAxis(sides);
  std::sort(sides.begin(), sides.end(),
    [axis](const Side& a, const Side& b) { return a.Low[axis] < b.Low[axis]; });
  for (std::size_t i = 0; i < sides.size(); ++i)
  {
    const double end = sides[i].High[axis] + Closeness * sides[i].Size();
    for (std::size_t j = i + 1; j < sides.size() && sides[j].Low[axis] <= end; ++j)
    {
      if (MayTouch(sides[i], sides[j]) &&
        (LiesOn(sides[i], sides[j]) || LiesOn(sides[j], sides[i])))
      {
        elements.insert(elements.end(), { sides[i].Element, sides[j].Element });
      }
    }
  }
  SortUnique(elements);
  elements.erase(std::remove_if(elements.begin(), elements.end(),
                   [&near](int e) { return near.Mesh.Elements[e].Ring != 0; }),
    elements.end());
  return elements;
}

}
