#include "ElementChain.h"

#include <algorithm>
#include <limits>

namespace trim
{
namespace
{

/// Longer chains count as open.
constexpr int LongestChain = 4096;

/// The axis of the edge between any two nodes of an element; -1: none, or no edge.
using AxesBetween = std::array<std::array<signed char, 8>, 8>;
constexpr AxesBetween FindAxes(const ElementTopology& topology)
{
  AxesBetween axes{};
  for (auto& row : axes)
  {
    for (auto& axis : row)
    {
      axis = -1;
    }
  }
  for (int i = 0; i < topology.NumberOfEdges; ++i)
  {
    const EdgeNodes& edge = topology.Edges[i];
    axes[edge.First][edge.Second] = axes[edge.Second][edge.First] =
      static_cast<signed char>(edge.Axis);
  }
  return axes;
}
constexpr AxesBetween HexahedronAxes = FindAxes(HexahedronTopology);
constexpr AxesBetween WedgeAxes = FindAxes(WedgeTopology);

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
  const auto first = std::find(element.begin(), element.end(), a);
  const auto second = std::find(element.begin(), element.end(), b);
  if (first == element.end() || second == element.end())
  {
    return -1;
  }
  const auto& axes = element.Count == 8 ? HexahedronAxes : WedgeAxes;
  return axes[first - element.begin()][second - element.begin()];
}

}
