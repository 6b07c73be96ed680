#include "Binomials.h"

#include "BezierPatch.h"

namespace nurbs
{
namespace
{

struct PascalTriangle
{
  double Value[2 * MaximumBezierDegree + 1][2 * MaximumBezierDegree + 1] = {};
  constexpr PascalTriangle()
  {
    for (int n = 0; n <= 2 * MaximumBezierDegree; ++n)
    {
      this->Value[n][0] = this->Value[n][n] = 1.0;
      for (int k = 1; k < n; ++k)
      {
        this->Value[n][k] = this->Value[n - 1][k - 1] + this->Value[n - 1][k];
      }
    }
  }
};
constexpr PascalTriangle Triangle;

}

const double* Binomials(int n)
{
  return Triangle.Value[n];
}

}
