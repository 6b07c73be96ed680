#include "BezierEvaluation.h"

#include "WideLanes.h"

#include <type_traits>

namespace nurbs
{
namespace
{

/// Four doubles as two SSE registers; plain Eigen temporaries go through memory here.
typedef double Pair __attribute__((vector_size(16), aligned(8), may_alias));
struct Quad
{
  Pair A = { 0, 0 }, B = { 0, 0 };
  inline void Add(double factor, const Quad& x)
  {
    const Pair f = { factor, factor };
    this->A += f * x.A;
    this->B += f * x.B;
  }
  inline void Add(double factor, const double* x)
  {
    const Pair f = { factor, factor };
    this->A += f * *reinterpret_cast<const Pair*>(x);
    this->B += f * *reinterpret_cast<const Pair*>(x + 2);
  }
  inline Vec3 Head() const { return Vec3(this->A[0], this->A[1], this->B[0]); }
  inline double W() const { return this->B[1]; }
};

/// The same in one register that is twice as wide.
typedef double Four __attribute__((vector_size(32), aligned(8), may_alias));
struct WideQuad
{
  Four A = { 0, 0, 0, 0 };
  inline void Add(double factor, const WideQuad& x) { this->A += factor * x.A; }
  inline void Add(double factor, const double* x)
  {
    this->A += factor * *reinterpret_cast<const Four*>(x);
  }
  inline Vec3 Head() const { return Vec3(this->A[0], this->A[1], this->A[2]); }
  inline double W() const { return this->A[3]; }
};

/// Bernstein polynomials of degree p with two derivatives, at x. P < 0: degree at run time.
template <int P>
struct Bernstein
{
  static constexpr int Size = P < 0 ? MaximumBezierDegree + 1 : P + 1;
  double N[3][Size];

  inline Bernstein(int degree, double x)
  {
    const int p = P < 0 ? degree : P;
    const double y = 1.0 - x;
    double* n = this->N[0];
    n[0] = 1.0;
    for (int j = 1; j <= p; ++j)
    {
      if (j == p - 1) // n has degree p - 2
      {
        for (int i = 0; i <= p; ++i)
        {
          const double a = i >= 2 ? n[i - 2] : 0.0;
          const double b = i >= 1 && i <= p - 1 ? n[i - 1] : 0.0;
          const double c = i <= p - 2 ? n[i] : 0.0;
          this->N[2][i] = p * (p - 1) * (a - 2 * b + c);
        }
      }
      if (j == p) // n has degree p - 1
      {
        this->N[1][0] = -p * n[0];
        for (int i = 1; i < p; ++i)
        {
          this->N[1][i] = p * (n[i - 1] - n[i]);
        }
        this->N[1][p] = p * n[p - 1];
      }
      double carry = 0.0;
      for (int i = 0; i < j; ++i)
      {
        const double value = n[i];
        n[i] = carry + y * value;
        carry = x * value;
      }
      n[j] = carry;
    }
    if (p < 2)
    {
      for (int i = 0; i <= p; ++i)
      {
        this->N[2][i] = 0.0;
      }
    }
    if (p < 1)
    {
      this->N[1][0] = 0.0;
    }
  }
};

/// Cubics are what nearly all CAD surfaces are made of.
template <>
inline Bernstein<3>::Bernstein(int, double x)
{
  const double y = 1.0 - x, xx = x * x, yy = y * y, xy = x * y;
  this->N[0][0] = yy * y;
  this->N[0][1] = 3 * yy * x;
  this->N[0][2] = 3 * xx * y;
  this->N[0][3] = xx * x;
  this->N[1][0] = -3 * yy;
  this->N[1][1] = 3 * (yy - 2 * xy);
  this->N[1][2] = 3 * (2 * xy - xx);
  this->N[1][3] = 3 * xx;
  this->N[2][0] = 6 * y;
  this->N[2][1] = 6 * (x - 2 * y);
  this->N[2][2] = 6 * (y - 2 * x);
  this->N[2][3] = 6 * x;
}

template <int P, int Q, typename AnyQuad>
inline void EvaluateNet(
  const BezierPatch& patch, const Vec4* net, double s, double t, SurfaceJet& jet)
{
  const int p = P < 0 ? patch.DegreeU : P;
  const int q = Q < 0 ? patch.DegreeV : Q;
  const Bernstein<P> bu(p, s);
  const Bernstein<Q> bv(q, t);
  AnyQuad a, au, av, auu, auv, avv;
  const double* point = net->data();
  for (int j = 0; j <= q; ++j)
  {
    AnyQuad row, rowU, rowUU;
    for (int i = 0; i <= p; ++i, point += 4)
    {
      row.Add(bu.N[0][i], point);
      rowU.Add(bu.N[1][i], point);
      rowUU.Add(bu.N[2][i], point);
    }
    a.Add(bv.N[0][j], row);
    av.Add(bv.N[1][j], row);
    avv.Add(bv.N[2][j], row);
    au.Add(bv.N[0][j], rowU);
    auv.Add(bv.N[1][j], rowU);
    auu.Add(bv.N[0][j], rowUU);
  }
  if (!patch.Rational)
  {
    jet.S = a.Head();
    jet.Su = au.Head();
    jet.Sv = av.Head();
    jet.Suu = auu.Head();
    jet.Suv = auv.Head();
    jet.Svv = avv.Head();
    return;
  }
  const double inverse = 1.0 / a.W(); // quotient rule (NURBS Book, eq. 4.20)
  jet.S = a.Head() * inverse;
  jet.Su = (au.Head() - au.W() * jet.S) * inverse;
  jet.Sv = (av.Head() - av.W() * jet.S) * inverse;
  jet.Suu = (auu.Head() - 2 * au.W() * jet.Su - auu.W() * jet.S) * inverse;
  jet.Suv = (auv.Head() - au.W() * jet.Sv - av.W() * jet.Su - auv.W() * jet.S) * inverse;
  jet.Svv = (avv.Head() - 2 * av.W() * jet.Sv - avv.W() * jet.S) * inverse;
}

template <typename AnyQuad>
inline void EvaluateByDegree(
  const BezierPatch& patch, const Vec4* net, double s, double t, SurfaceJet& jet)
{
  switch (patch.DegreeU * 64 + patch.DegreeV)
  {
    case 3 * 64 + 3:
      return EvaluateNet<3, 3, AnyQuad>(patch, net, s, t, jet);
    case 3 * 64 + 1:
      return EvaluateNet<3, 1, AnyQuad>(patch, net, s, t, jet);
    case 1 * 64 + 3:
      return EvaluateNet<1, 3, AnyQuad>(patch, net, s, t, jet);
    case 2 * 64 + 2:
      return EvaluateNet<2, 2, AnyQuad>(patch, net, s, t, jet);
    case 2 * 64 + 1:
      return EvaluateNet<2, 1, AnyQuad>(patch, net, s, t, jet);
    case 1 * 64 + 2:
      return EvaluateNet<1, 2, AnyQuad>(patch, net, s, t, jet);
    case 1 * 64 + 1:
      return EvaluateNet<1, 1, AnyQuad>(patch, net, s, t, jet);
    default:
      return EvaluateNet<-1, -1, AnyQuad>(patch, net, s, t, jet);
  }
}

}

void EvaluateBezier(const BezierPatch& patch, const Vec4* net, double s, double t, SurfaceJet& jet)
{
  WithWideLanes(
    [&](auto wide)
    {
      using OwnQuad = std::conditional_t<wide, WideQuad, Quad>;
      EvaluateByDegree<OwnQuad>(patch, net, s, t, jet);
    });
}

namespace
{

/// Bernstein polynomials without derivatives. P < 0: degree at run time.
template <int P>
struct BernsteinValues
{
  double N[P < 0 ? MaximumBezierDegree + 1 : P + 1];

  BernsteinValues(int degree, double x)
  {
    const int p = P < 0 ? degree : P;
    this->N[0] = 1.0;
    for (int j = 1; j <= p; ++j)
    {
      double carry = 0.0;
      for (int i = 0; i < j; ++i)
      {
        const double value = this->N[i];
        this->N[i] = carry + (1.0 - x) * value;
        carry = x * value;
      }
      this->N[j] = carry;
    }
  }
};

template <int P, int Q>
Quad PointOfNet(const BezierPatch& patch, const Vec4* net, double s, double t)
{
  const int p = P < 0 ? patch.DegreeU : P, q = Q < 0 ? patch.DegreeV : Q;
  const BernsteinValues<P> bu(p, s);
  const BernsteinValues<Q> bv(q, t);
  Quad a;
  const double* point = net->data();
  for (int j = 0; j <= q; ++j)
  {
    Quad row;
    for (int i = 0; i <= p; ++i, point += 4)
    {
      row.Add(bu.N[i], point);
    }
    a.Add(bv.N[j], row);
  }
  return a;
}

Quad HomogeneousPoint(const BezierPatch& patch, const Vec4* net, double s, double t)
{
  return patch.DegreeU == 3 && patch.DegreeV == 3 ? PointOfNet<3, 3>(patch, net, s, t)
                                                  : PointOfNet<-1, -1>(patch, net, s, t);
}

}

Vec3 BezierPoint(const BezierPatch& patch, const Vec4* net, double s, double t)
{
  const Quad a = HomogeneousPoint(patch, net, s, t);
  return a.Head() / a.W();
}

double BezierWeight(const BezierPatch& patch, const Vec4* net, double s, double t)
{
  return HomogeneousPoint(patch, net, s, t).W();
}

namespace
{

/// The middle of points at a stride. D < 0: degree at run time.
template <int D>
Vec3 MiddleOfPoints(int degree, const Vec4* points, int stride)
{
  const BernsteinValues<D> b(degree, 0.5);
  Quad a;
  for (int k = 0; k <= (D < 0 ? degree : D); ++k)
  {
    a.Add(b.N[k], points[k * stride].data());
  }
  return a.Head() / a.W();
}

}

Vec3 MiddleOfSide(const BezierPatch& patch, const Vec4* net, int side)
{
  const NetSide points(patch, side);
  const Vec4* first = net + points.First;
  return points.Degree == 3 ? MiddleOfPoints<3>(points.Degree, first, points.Stride)
                            : MiddleOfPoints<-1>(points.Degree, first, points.Stride);
}

}
