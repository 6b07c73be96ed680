#include "LocalThickness.h"

#include "ElementChain.h"

#include <algorithm>
#include <array>

namespace trim
{
namespace
{

/// The axis of one element whose chain is clearly its thickness, or -1.
int ThicknessOf(const Band& band, int e)
{
  const int count = TopologyOf(band.Elements[e].Count).NumberOfAxes;
  std::array<Chain, 3> chains;
  for (int axis = 0; axis < count; ++axis)
  {
    chains[axis] = MeasureChain(band, e, axis);
  }
  for (int axis = 0; axis < count; ++axis)
  {
    const Chain& own = chains[axis];
    // An open chain is longer than what the band shows of it.
    const bool shortest = std::all_of(chains.begin(), chains.begin() + count,
      [&own](const Chain& o)
      {
        return &o == &own || o.Length > ThicknessRatio * own.Length ||
          (!o.Closed && o.Length > own.Length);
      });
    if (own.Closed && shortest)
    {
      return axis;
    }
  }
  return -1;
}

/// Whether the thickness of an element ends at a face: on each side of it.
std::array<bool, 2> EndsAt(
  const Band& band, const BandFace& face, const std::vector<signed char>& axis)
{
  std::array<bool, 2> ends{};
  for (int side = 0; side < 2; ++side)
  {
    const int e = face.Element[side];
    ends[side] = TopologyOf(band.Elements[e].Count).FaceAxis[face.Slot[side]] == axis[e];
  }
  return ends;
}

/// Whether the axes of two elements that a face joins go on through it, or along it.
bool FitAt(const Band& band, const BandFace& face, const std::vector<signed char>& axis)
{
  const int a = axis[face.Element[0]], b = axis[face.Element[1]];
  if (a < 0 || b < 0)
  {
    return true;
  }
  const auto ends = EndsAt(band, face, axis);
  bool fit = ends[0] == ends[1];
  for (int i = 0; i < face.Count && fit && !ends[0]; ++i)
  {
    const int n = face.Node[i], next = face.Node[(i + 1) % face.Count];
    fit = (AxisOfEdge(band.Elements[face.Element[0]], n, next) == a) ==
      (AxisOfEdge(band.Elements[face.Element[1]], n, next) == b);
  }
  return fit;
}

/// The faces between elements of a part, ascending.
std::vector<int> InnerFaces(const Band& band, const std::vector<int>& part)
{
  std::vector<int> faces;
  for (const int e : part)
  {
    const auto& element = band.Elements[e];
    for (int slot = 0; slot < TopologyOf(element.Count).NumberOfFaces; ++slot)
    {
      const auto& face = band.Faces[element.Face[slot]];
      if (face.Element[0] == e && face.Element[1] >= 0)
      {
        faces.push_back(element.Face[slot]);
      }
    }
  }
  std::sort(faces.begin(), faces.end());
  return faces;
}

}

void FindLocalThickness(
  const Band& band, const std::vector<int>& part, std::vector<signed char>& axis)
{
  for (const int e : part)
  {
    axis[e] = static_cast<signed char>(ThicknessOf(band, e));
  }
  const std::vector<int> faces = InnerFaces(band, part);
  for (bool changed = true; changed;)
  {
    changed = false;
    for (const int f : faces)
    {
      const auto& face = band.Faces[f];
      if (FitAt(band, face, axis))
      {
        continue;
      }
      const auto ends = EndsAt(band, face, axis);
      for (int side = 0; side < 2; ++side)
      {
        const bool givesWay = ends[side] || ends[0] == ends[1];
        axis[face.Element[side]] = givesWay ? -1 : axis[face.Element[side]];
      }
      changed = true;
    }
  }
}

}
