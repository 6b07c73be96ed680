/**
 * @file SpanToBezier.h
 * @brief The Bezier points of a part of a spline.
 */
#ifndef SpanToBezier_h
#define SpanToBezier_h

#include "KnotVector.h"
#include "NurbsSurface.h"

#include <cstddef>
#include <vector>

namespace nurbs
{

/**
 * The degree + 1 Bezier points of a span [a, b] as sums over control points of the spline: each is
 * the blossom at (a, .., a, b, .., b), found by the de Boor recurrence with one argument per step.
 */
class SpanToBezier
{
public:
  SpanToBezier(int degree, const std::vector<double>& knots, double a, double b)
    : Degree(degree)
  {
    const int k = LastKnotBefore(knots, b);
    this->First = k - degree;
    for (int m = 0; m <= degree; ++m)
    {
      Factors d[MaximumDegree + 1];
      for (int i = 0; i <= degree; ++i)
      {
        d[i] = Factors::Unit(i);
      }
      for (int r = 1; r <= degree; ++r)
      {
        const double argument = r <= m ? b : a;
        for (int i = degree; i >= r; --i)
        {
          const double low = knots[k - degree + i], high = knots[k + 1 + i - r];
          const double x = (argument - low) / (high - low);
          d[i] = (1.0 - x) * d[i - 1] + x * d[i];
        }
      }
      this->Of[m] = d[degree];
    }
  }

  /// @param at gives the control points of the row or column of the spline, or one coordinate of
  /// them, from First on.
  template <typename PointAt, typename Point>
  void Convert(const PointAt& at, Point* bezier, std::size_t stride) const
  {
    return this->Degree == 3 ? this->ConvertAs<3>(at, bezier, stride)
                             : this->ConvertAs<-1>(at, bezier, stride);
  }

  int First; ///< of the control points that count; there are degree + 1

private:
  /// D < 0: degree at run time.
  template <int D, typename PointAt, typename Point>
  void ConvertAs(const PointAt& at, Point* bezier, std::size_t stride) const
  {
    const int degree = D < 0 ? this->Degree : D;
    for (int m = 0; m <= degree; ++m)
    {
      Point sum = this->Of[m][0] * at(0);
      for (int i = 1; i <= degree; ++i)
      {
        sum += this->Of[m][i] * at(i);
      }
      bezier[m * stride] = sum;
    }
  }

  using Factors = Eigen::Matrix<double, MaximumDegree + 1, 1>;
  int Degree;
  Factors Of[MaximumDegree + 1]; ///< of the control points from First on, by Bezier point
};

}

#endif
