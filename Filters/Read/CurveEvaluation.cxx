#include "CurveEvaluation.h"

#include "KnotVector.h"

#include <algorithm>

namespace nurbs
{
//------------------------------------------------------------------------------
Vec3 EvaluateCurve(const ConvertedCurve& curve, double u, Vec3* derivative)
{
  const int degree = curve.Degree;
  const int span = FindSpan(
    degree, static_cast<int>(curve.Points.size()), curve.Knots, std::max(u, curve.Knots[degree]));
  Vec4 points[MaximumDegree + 1];
  for (int i = 0; i <= degree; ++i)
  {
    const Vec4& p = curve.Points[span - degree + i];
    points[i] = Vec4(p[0] * p[3], p[1] * p[3], p[2] * p[3], p[3]);
  }
  Vec4 slope = Vec4::Zero();
  for (int level = 1; level <= degree; ++level)
  {
    if (level == degree)
    {
      slope = degree * (points[1] - points[0]) / (curve.Knots[span + 1] - curve.Knots[span]);
    }
    for (int i = 0; i <= degree - level; ++i)
    {
      const double low = curve.Knots[span - degree + level + i];
      const double high = curve.Knots[span + 1 + i];
      const double share = (u - low) / (high - low);
      points[i] = (1.0 - share) * points[i] + share * points[i + 1];
    }
  }
  const Vec3 point = points[0].head<3>() / points[0][3];
  if (derivative)
  {
    *derivative = (slope.head<3>() - slope[3] * point) / points[0][3];
  }
  return point;
}

//------------------------------------------------------------------------------
ConvertedCurve ReverseCurve(const ConvertedCurve& curve)
{
  ConvertedCurve result;
  result.Degree = curve.Degree;
  result.Points.assign(curve.Points.rbegin(), curve.Points.rend());
  const double sum = curve.Knots.front() + curve.Knots.back();
  result.Knots.resize(curve.Knots.size());
  std::transform(curve.Knots.rbegin(), curve.Knots.rend(), result.Knots.begin(),
    [sum](double knot) { return sum - knot; });
  return result;
}

//------------------------------------------------------------------------------
std::vector<CurveSample> SampleCurve(const ConvertedCurve& curve)
{
  constexpr int stepsPerSpan = 16;
  const int steps = curve.Degree == 1 ? 1 : stepsPerSpan;
  const int count = static_cast<int>(curve.Points.size());
  std::vector<CurveSample> samples;
  for (int k = curve.Degree; k < count; ++k)
  {
    const double first = curve.Knots[k], last = curve.Knots[k + 1];
    for (int i = 0; i < steps && first < last; ++i)
    {
      const double u = first + (last - first) * i / steps;
      samples.push_back({ u, EvaluateCurve(curve, u) });
    }
  }
  const double end = curve.Knots[count];
  samples.push_back({ end, EvaluateCurve(curve, end) });
  return samples;
}
}
