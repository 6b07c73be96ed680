#include "SharedSurface.h"

#include <set>

namespace trim
{
namespace
{

/// A face as numbers, its own length first.
using Packed = std::vector<double>;

Packed Pack(const nurbs::NurbsSurface& face)
{
  Packed packed{ 0.0, double(face.DegreeU), double(face.DegreeV), double(face.CountU),
    double(face.CountV), double(face.KnotsU.size()), double(face.KnotsV.size()),
    double(face.TrimLoops.size()) };
  packed.insert(packed.end(), face.KnotsU.begin(), face.KnotsU.end());
  packed.insert(packed.end(), face.KnotsV.begin(), face.KnotsV.end());
  for (const auto& point : face.ControlPoints)
  {
    packed.insert(packed.end(), point.data(), point.data() + 4);
  }
  for (const auto& loop : face.TrimLoops)
  {
    packed.push_back(double(loop.size()));
    for (const auto& corner : loop)
    {
      packed.insert(packed.end(), corner.data(), corner.data() + 2);
    }
  }
  packed[0] = double(packed.size());
  return packed;
}

nurbs::NurbsSurface Unpack(const Packed& packed)
{
  const double* next = packed.data() + 1;
  const auto count = [&next] { return static_cast<int>(*next++); };
  nurbs::NurbsSurface face;
  face.DegreeU = count();
  face.DegreeV = count();
  face.CountU = count();
  face.CountV = count();
  face.KnotsU.resize(count());
  face.KnotsV.resize(count());
  face.TrimLoops.resize(count());
  for (auto* knots : { &face.KnotsU, &face.KnotsV })
  {
    for (double& knot : *knots)
    {
      knot = *next++;
    }
  }
  face.ControlPoints.resize(static_cast<std::size_t>(face.CountU) * face.CountV);
  for (auto& point : face.ControlPoints)
  {
    point = nurbs::Vec4(next[0], next[1], next[2], next[3]);
    next += 4;
  }
  for (auto& loop : face.TrimLoops)
  {
    loop.resize(count());
    for (auto& corner : loop)
    {
      corner = nurbs::Vec2(next[0], next[1]);
      next += 2;
    }
  }
  return face;
}

}

std::vector<nurbs::NurbsSurface> ShareFaces(
  const Ranks& ranks, const std::vector<nurbs::NurbsSurface>& own)
{
  Packed mine;
  for (const auto& face : own)
  {
    const Packed packed = Pack(face);
    mine.insert(mine.end(), packed.begin(), packed.end());
  }
  const Packed all = ranks.Gather(mine);
  std::vector<nurbs::NurbsSurface> faces;
  std::set<Packed> seen;
  for (auto first = all.begin(); first != all.end();)
  {
    const auto last = first + static_cast<std::ptrdiff_t>(*first);
    const auto [packed, isNew] = seen.emplace(first, last);
    if (isNew)
    {
      faces.push_back(Unpack(*packed));
    }
    first = last;
  }
  return faces;
}

}
