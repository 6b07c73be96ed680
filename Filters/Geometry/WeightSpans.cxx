#include "WeightSpans.h"

#include "SpanToBezier.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace nurbs
{
namespace
{

/// Surfaces whose weights differ by less are left as they are: about here searches were seen to
/// begin to fail.
constexpr double Harmless = 1e4;
/// Where spans are divided the weights are to be well within that.
constexpr double MostUnequal = 100.0;

using Weights = std::array<double, MaximumDegree + 1>;

/// The largest of the weights as a multiple of the smallest.
template <typename Iterator>
double RatioOf(Iterator begin, Iterator end)
{
  const auto range = std::minmax_element(begin, end);
  return *range.second / *range.first;
}

/// The rows of weights along one parameter of a surface.
class WeightRows
{
public:
  WeightRows(const NurbsSurface& surface, bool alongU)
    : Surface(surface)
    , AlongU(alongU)
  {
  }

  int Degree() const { return this->AlongU ? this->Surface.DegreeU : this->Surface.DegreeV; }
  const std::vector<double>& Knots() const
  {
    return this->AlongU ? this->Surface.KnotsU : this->Surface.KnotsV;
  }

  /// The Bezier weights from a to b of the row where they are the most unequal.
  Weights FindWorst(double a, double b) const
  {
    const SpanToBezier convert(this->Degree(), this->Knots(), a, b);
    const int rows = this->AlongU ? this->Surface.CountV : this->Surface.CountU;
    const int size = this->Degree() + 1;
    Weights worst{};
    double largest = 0.0;
    for (int row = 0; row < rows; ++row)
    {
      Weights own{};
      convert.Convert([&](int i) { return this->At(convert.First + i, row); }, own.data(), 1);
      const double ratio = RatioOf(own.begin(), own.begin() + size);
      if (ratio > largest)
      {
        largest = ratio;
        worst = own;
      }
    }
    return worst;
  }

private:
  double At(int i, int row) const
  {
    const int u = this->AlongU ? i : row, v = this->AlongU ? row : i;
    return this->Surface.ControlPoints[static_cast<std::size_t>(v) * this->Surface.CountU + u].w();
  }

  const NurbsSurface& Surface;
  bool AlongU;
};

/// A Bezier polynomial at t, 0 to 1 (de Casteljau).
double ValueAt(Weights weights, int degree, double t)
{
  for (int r = degree; r > 0; --r)
  {
    for (int i = 0; i < r; ++i)
    {
      weights[i] = (1.0 - t) * weights[i] + t * weights[i + 1];
    }
  }
  return weights[0];
}

/// Where the weight is the geometric mean of what it is about its smallest and its largest
/// coefficient, 0 to 1.
double MiddleOf(const Weights& weights, int degree)
{
  const auto range = std::minmax_element(weights.begin(), weights.begin() + degree + 1);
  double low = static_cast<double>(range.first - weights.begin()) / degree;
  double high = static_cast<double>(range.second - weights.begin()) / degree;
  const double mean =
    std::sqrt(ValueAt(weights, degree, low)) * std::sqrt(ValueAt(weights, degree, high));
  constexpr int halvings = 60;
  for (int i = 0; i < halvings; ++i)
  {
    const double middle = 0.5 * (low + high);
    (ValueAt(weights, degree, middle) < mean ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Appends the ends of the parts of a span that ends at b, but b.
void Divide(const WeightRows& rows, double a, double b, std::vector<double>& breaks)
{
  const int degree = rows.Degree();
  const Weights worst = rows.FindWorst(a, b);
  if (RatioOf(worst.begin(), worst.begin() + degree + 1) <= MostUnequal)
  {
    return;
  }
  const double middle = a + MiddleOf(worst, degree) * (b - a);
  if (middle > a && middle < b)
  {
    Divide(rows, a, middle, breaks);
    breaks.push_back(middle);
    Divide(rows, middle, b, breaks);
  }
}

void DivideSpans(const WeightRows& rows, KnotSpans& spans)
{
  KnotSpans divided;
  for (std::size_t k = 0; k < spans.Breaks.size(); ++k)
  {
    divided.Breaks.push_back(spans.Breaks[k]);
    divided.Kinds.push_back(spans.Kinds[k]);
    if (k + 1 < spans.Breaks.size())
    {
      Divide(rows, spans.Breaks[k], spans.Breaks[k + 1], divided.Breaks);
      divided.Kinds.resize(divided.Breaks.size(), SideKind::Smooth);
    }
  }
  spans = std::move(divided);
}

}

void DivideByWeights(const NurbsSurface& surface, KnotSpans& spansU, KnotSpans& spansV)
{
  const auto range = std::minmax_element(surface.ControlPoints.begin(), surface.ControlPoints.end(),
    [](const Vec4& a, const Vec4& b) { return a.w() < b.w(); });
  if (range.second->w() < Harmless * range.first->w())
  {
    return; // as a rule
  }
  DivideSpans(WeightRows(surface, true), spansU);
  DivideSpans(WeightRows(surface, false), spansV);
}

}
