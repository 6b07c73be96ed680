#include "ElementTetrahedra.h"

#include <algorithm>

namespace trim
{

std::array<int, 8> OrderForTetrahedra(const BandElement& element)
{
  const auto& node = element.Node;
  const int first =
    static_cast<int>(std::min_element(element.begin(), element.end()) - element.begin());
  const int corners = element.Count / 2; // of one end
  // Seen from the other end they go round the other way.
  const bool turned = first >= corners;
  const int start = turned ? first - corners : first;
  std::array<int, 8> nodes = node;
  for (int i = 0; i < corners; ++i)
  {
    const int next = turned ? start + corners - i : start + i;
    const int corner = next < corners ? next : next - corners;
    nodes[i] = node[turned ? corner + corners : corner];
    nodes[i + corners] = node[turned ? corner : corner + corners];
  }
  return nodes;
}

}
