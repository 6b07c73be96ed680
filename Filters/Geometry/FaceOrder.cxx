#include "FaceOrder.h"

#include <algorithm>
#include <tuple>

namespace nurbs
{
namespace
{

/// Points by their coordinates, lists by their items, from the first on.
struct ByFirst
{
  template <typename Point>
  bool operator()(
    const Eigen::PlainObjectBase<Point>& a, const Eigen::PlainObjectBase<Point>& b) const
  {
    return std::lexicographical_compare(
      a.data(), a.data() + a.size(), b.data(), b.data() + b.size());
  }

  template <typename Item>
  bool operator()(const std::vector<Item>& a, const std::vector<Item>& b) const
  {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end(), *this);
  }
};

bool ComesBefore(const NurbsSurface& a, const NurbsSurface& b)
{
  const ByFirst before;
  if (before(a.ControlPoints, b.ControlPoints))
  {
    return true;
  }
  if (before(b.ControlPoints, a.ControlPoints))
  {
    return false;
  }
  const auto others = [](const NurbsSurface& s)
  { return std::tie(s.DegreeU, s.DegreeV, s.CountU, s.KnotsU, s.KnotsV, s.Tolerance); };
  return others(a) != others(b) ? others(a) < others(b) : before(a.TrimLoops, b.TrimLoops);
}

}

std::vector<NurbsSurface> InOwnOrder(std::vector<NurbsSurface> faces)
{
  std::stable_sort(faces.begin(), faces.end(), ComesBefore);
  return faces;
}

}
