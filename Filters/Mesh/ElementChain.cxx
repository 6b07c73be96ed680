#include "ElementChain.h"

#include <limits>

namespace trim
{
namespace
{

/// Longer chains count as open.
constexpr int LongestChain = 4096;

double AxisLength(const Band& band, int element, int axis)
{
  const auto& e = band.Elements[element];
  const auto& topology = TopologyOf(e.Count);
  double sum = 0.0;
  int count = 0;
  for (int i = 0; i < topology.NumberOfEdges; ++i)
  {
    if (topology.Edges[i].Axis == axis)
    {
      sum +=
        (band.Point[e.Node[topology.Edges[i].First]] - band.Point[e.Node[topology.Edges[i].Second]])
          .norm();
      ++count;
    }
  }
  return sum / count;
}

}

Chain MeasureChain(const Band& band, int element, int axis)
{
  Chain chain;
  chain.Length = AxisLength(band, element, axis);
  int way = 0;
  const auto& topology = TopologyOf(band.Elements[element].Count);
  for (int slot = 0; slot < topology.NumberOfFaces; ++slot)
  {
    if (topology.FaceAxis[slot] != axis)
    {
      continue;
    }
    int current = element;
    int leaving = slot;
    for (int step = 0;; ++step)
    {
      const int end = band.Elements[current].Face[leaving];
      const auto& face = band.Faces[end];
      chain.EndFace[way] = end;
      const int side = face.Element[0] == current ? 1 : 0;
      const int next = face.Element[side];
      if (next < 0 || step == LongestChain)
      {
        chain.Closed = chain.Closed && next < 0 && face.Exterior;
        break;
      }
      if (next == element)
      {
        chain.Length = std::numeric_limits<double>::infinity(); // a ring has no end
        chain.Closed = false;
        break;
      }
      const int nextAxis = TopologyOf(band.Elements[next].Count).FaceAxis[face.Slot[side]];
      if (nextAxis < 0)
      {
        chain.Closed = false;
        break;
      }
      ++chain.Count;
      chain.Length += AxisLength(band, next, nextAxis);
      leaving = OppositeFace(face.Slot[side]);
      current = next;
    }
    ++way;
  }
  return chain;
}

int AxisOfEdge(const BandElement& element, int a, int b)
{
  const auto& topology = TopologyOf(element.Count);
  for (int i = 0; i < topology.NumberOfEdges; ++i)
  {
    const int p = element.Node[topology.Edges[i].First];
    const int q = element.Node[topology.Edges[i].Second];
    if ((p == a && q == b) || (p == b && q == a))
    {
      return topology.Edges[i].Axis;
    }
  }
  return -1;
}

}
