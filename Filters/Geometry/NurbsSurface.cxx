#include "NurbsSurface.h"

#include "ParameterPolygon.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace nurbs
{
namespace
{

/// Weights and knots that keep products of derivatives far from overflow.
constexpr double LargestWeight = 1e15, SmallestWeight = 1e-15, LargestKnot = 1e30;
/// Beyond it nothing is left of a surface in double precision between two control points.
constexpr double LargestWeightRatio = 1e8;

std::string DegreeDefect(const char* axis, int degree)
{
  std::ostringstream text;
  if (degree < 1 || degree > MaximumDegree)
  {
    text << "degree " << axis << " is " << degree << ": give one from 1 to " << MaximumDegree;
  }
  return text.str();
}

std::string CountDefect(const char* axis, int degree, int count, std::size_t knots)
{
  std::ostringstream text;
  if (count < degree + 1)
  {
    text << count << " control points along " << axis << " are too few for degree " << degree
         << ": give at least " << degree + 1;
  }
  // Counts up to the largest int come from properties.
  else if (const std::size_t needed = static_cast<std::size_t>(count) + degree + 1; knots != needed)
  {
    text << "knot vector " << axis << " has " << knots << " values: " << count
         << " control points of degree " << degree << " need " << needed;
  }
  return text.str();
}

std::string KnotDefect(const char* axis, int degree, int count, const std::vector<double>& knots)
{
  std::ostringstream text;
  for (std::size_t i = 0; i < knots.size(); ++i)
  {
    if (!std::isfinite(knots[i]))
    {
      text << "knot " << axis << "[" << i << "] is not finite: give a finite number";
      return text.str();
    }
    if (std::abs(knots[i]) > LargestKnot)
    {
      text << "knot " << axis << "[" << i << "] = " << knots[i] << " is larger than " << LargestKnot
           << ": scale the knots down";
      return text.str();
    }
    if (i > 0 && knots[i] < knots[i - 1])
    {
      text << "knot " << axis << "[" << i << "] = " << knots[i] << " is less than the one before, "
           << knots[i - 1] << ": give knots that do not decrease";
      return text.str();
    }
  }
  // A domain that is a rounding error wide cannot be told from an empty one.
  const double first = knots[degree], last = knots[count];
  if (!(last - first > 1e-14 * (std::abs(first) + std::abs(last))) ||
    last - first < 1 / LargestKnot)
  {
    text << "the domain along " << axis << ", knots " << axis << "[" << degree << "] to " << axis
         << "[" << count << "], is empty: give knots that rise";
    return text.str();
  }
  // More than p + 1 equal knots leave control points without influence and the basis undefined.
  int run = 1;
  for (std::size_t i = 1; i < knots.size(); ++i)
  {
    run = knots[i] == knots[i - 1] ? run + 1 : 1;
    if (run > degree + 1)
    {
      text << "knot " << axis << "[" << i << "] = " << knots[i] << " is repeated more than "
           << degree + 1 << " times: remove the surplus ones and their control points";
      return text.str();
    }
  }
  return text.str();
}

std::string WeightRatioDefect(const NurbsSurface& surface)
{
  const auto lighter = [](const Vec4& a, const Vec4& b) { return a.w() < b.w(); };
  const auto [least, most] =
    std::minmax_element(surface.ControlPoints.begin(), surface.ControlPoints.end(), lighter);
  if (most->w() <= LargestWeightRatio * least->w())
  {
    return std::string();
  }
  std::ostringstream text;
  const auto tell = [&](const auto& point)
  {
    const auto k = point - surface.ControlPoints.begin();
    text << point->w() << " at control point (" << k % surface.CountU << ", " << k / surface.CountU
         << ")";
  };
  text << "the weights go from ";
  tell(least);
  text << " to ";
  tell(most);
  text << ": give weights that differ by no more than a factor of " << LargestWeightRatio;
  return text.str();
}

std::string NetDefect(const NurbsSurface& surface)
{
  std::ostringstream text;
  const std::size_t expected = static_cast<std::size_t>(surface.CountU) * surface.CountV;
  if (surface.ControlPoints.size() != expected)
  {
    text << "the control net has " << surface.ControlPoints.size() << " points: " << surface.CountU
         << " x " << surface.CountV << " = " << expected << " are needed";
    return text.str();
  }
  for (std::size_t k = 0; k < expected; ++k)
  {
    const Vec4& point = surface.ControlPoints[k];
    const auto place = [&]()
    { text << "control point (" << k % surface.CountU << ", " << k / surface.CountU << ")"; };
    if (!std::isfinite(point.x()) || !std::isfinite(point.y()) || !std::isfinite(point.z()))
    {
      place();
      text << " is not finite: give finite coordinates";
      return text.str();
    }
    if (point.head<3>().cwiseAbs().maxCoeff() > LargestCoordinate)
    {
      place();
      text << " is at (" << point.x() << ", " << point.y() << ", " << point.z() << "), beyond "
           << LargestCoordinate << ": correct it or the length unit";
      return text.str();
    }
    if (point.w() > 0 && !(point.w() >= SmallestWeight && point.w() <= LargestWeight))
    {
      place();
      text << " has the weight " << point.w() << ": give weights from " << SmallestWeight << " to "
           << LargestWeight;
      return text.str();
    }
    if (!std::isfinite(point.w()) || !(point.w() > 0))
    {
      place();
      text << " has the weight " << point.w() << ": give a finite weight above zero";
      return text.str();
    }
  }
  return WeightRatioDefect(surface);
}

std::string LoopDefect(const NurbsSurface& surface)
{
  // What projecting an edge on a surface may leave beyond the border; not a wrong loop.
  constexpr double Slack = 1e-6;
  const Vec2 low(surface.FirstU(), surface.FirstV()), high(surface.LastU(), surface.LastV());
  const Vec2 slack = Slack * (high - low);
  std::ostringstream text;
  for (std::size_t loop = 0; loop < surface.TrimLoops.size(); ++loop)
  {
    const auto& points = surface.TrimLoops[loop];
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const Vec2& uv = points[i];
      // Written so that NaN fails.
      if (!((uv.array() >= (low - slack).array()).all() &&
            (uv.array() <= (high + slack).array()).all()))
      {
        text << "point " << i << " of trim loop " << loop << " is (" << uv.x() << ", " << uv.y()
             << "): give one in the domain " << low.x() << " .. " << high.x() << " by " << low.y()
             << " .. " << high.y();
        return text.str();
      }
    }
    if (const int corners = CountCorners(points); corners < 3)
    {
      text << "trim loop " << loop << " has " << corners << " different points: give at least 3";
      return text.str();
    }
  }
  return text.str();
}

std::string ToleranceDefect(const NurbsSurface& surface)
{
  if (std::isfinite(surface.Tolerance) && surface.Tolerance >= 0.0)
  {
    return std::string();
  }
  std::ostringstream text;
  text << "the tolerance is " << surface.Tolerance << ": give a finite length, or none";
  return text.str();
}
}

std::string FindDefect(const NurbsSurface& surface)
{
  std::string defect = DegreeDefect("U", surface.DegreeU);
  if (defect.empty())
  {
    defect = DegreeDefect("V", surface.DegreeV);
  }
  if (defect.empty())
  {
    defect = CountDefect("U", surface.DegreeU, surface.CountU, surface.KnotsU.size());
  }
  if (defect.empty())
  {
    defect = CountDefect("V", surface.DegreeV, surface.CountV, surface.KnotsV.size());
  }
  if (defect.empty())
  {
    defect = KnotDefect("U", surface.DegreeU, surface.CountU, surface.KnotsU);
  }
  if (defect.empty())
  {
    defect = KnotDefect("V", surface.DegreeV, surface.CountV, surface.KnotsV);
  }
  if (defect.empty())
  {
    defect = NetDefect(surface);
  }
  if (defect.empty())
  {
    defect = LoopDefect(surface);
  }
  return defect.empty() ? ToleranceDefect(surface) : defect;
}

Box3 BoxOf(const NurbsSurface& surface)
{
  Box3 box;
  for (const Vec4& point : surface.ControlPoints)
  {
    box.extend(Vec3(point.head<3>()));
  }
  return box;
}

}
