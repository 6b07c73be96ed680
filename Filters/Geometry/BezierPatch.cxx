#include "BezierPatch.h"

#include <algorithm>
#include <cmath>

namespace nurbs
{

int KnotSpans::Find(double u) const
{
  const auto it = std::upper_bound(this->Breaks.begin() + 1, this->Breaks.end() - 1, u);
  return static_cast<int>(it - this->Breaks.begin()) - 1;
}

//------------------------------------------------------------------------------
// Decomposition
//------------------------------------------------------------------------------
namespace
{

KnotSpans FindSpans(int degree, int count, const std::vector<double>& knots)
{
  KnotSpans spans;
  for (int k = degree; k <= count; ++k)
  {
    if (!spans.Breaks.empty() && knots[k] == spans.Breaks.back())
    {
      continue;
    }
    const auto range = std::equal_range(knots.begin(), knots.end(), knots[k]);
    const int continuity = degree - static_cast<int>(range.second - range.first);
    spans.Breaks.push_back(knots[k]);
    spans.Kinds.push_back(
      continuity > 0 ? SideKind::Smooth : (continuity == 0 ? SideKind::Crease : SideKind::Border));
  }
  spans.Kinds.front() = spans.Kinds.back() = SideKind::Border;
  return spans;
}

int LastKnotBefore(const std::vector<double>& knots, double next)
{
  return static_cast<int>(std::lower_bound(knots.begin(), knots.end(), next) - knots.begin()) - 1;
}

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

  /// @param at gives the control points of the row or column of the spline, from First on.
  template <typename PointAt>
  void Convert(const PointAt& at, Vec4* bezier, std::size_t stride) const
  {
    return this->Degree == 3 ? this->ConvertAs<3>(at, bezier, stride)
                             : this->ConvertAs<-1>(at, bezier, stride);
  }

  int First; ///< of the control points that count; there are degree + 1

private:
  /// D < 0: degree at run time.
  template <int D, typename PointAt>
  void ConvertAs(const PointAt& at, Vec4* bezier, std::size_t stride) const
  {
    const int degree = D < 0 ? this->Degree : D;
    for (int m = 0; m <= degree; ++m)
    {
      Vec4 sum = this->Of[m][0] * at(0);
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

std::vector<SpanToBezier> ConvertSpans(
  int degree, const std::vector<double>& knots, const KnotSpans& spans)
{
  std::vector<SpanToBezier> converters;
  converters.reserve(spans.Breaks.size() - 1);
  for (std::size_t k = 0; k + 1 < spans.Breaks.size(); ++k)
  {
    converters.emplace_back(degree, knots, spans.Breaks[k], spans.Breaks[k + 1]);
  }
  return converters;
}

/// The rows of control points of a surface, Bezier in u: each when it is needed, the last few kept.
class BezierRows
{
public:
  BezierRows(const NurbsSurface& surface, const KnotSpans& spansU, const Vec3& origin)
    : Surface(surface)
    , Origin(origin)
    , Spans(ConvertSpans(surface.DegreeU, surface.KnotsU, spansU))
    , Width(this->Spans.size() * (surface.DegreeU + 1))
    , Points(surface.CountU)
    , Kept(this->Width * (surface.DegreeV + 1))
  {
  }

  /// Rows as far as `last`; those more than the degree in v before it are lost.
  void Advance(int last)
  {
    for (; this->Next <= last; ++this->Next)
    {
      const Vec4* given = this->Surface.ControlPoints.data() +
        static_cast<std::size_t>(this->Next) * this->Points.size();
      for (std::size_t i = 0; i < this->Points.size(); ++i)
      {
        const double w = given[i].w();
        this->Points[i] << w * (given[i].head<3>() - this->Origin), w;
      }
      Vec4* row = this->Row(this->Next);
      for (const SpanToBezier& span : this->Spans)
      {
        const Vec4* points = this->Points.data() + span.First;
        span.Convert([points](int i) -> const Vec4& { return points[i]; }, row, 1);
        row += this->Surface.DegreeU + 1;
      }
    }
  }

  Vec4* Row(int j) { return this->Kept.data() + j % (this->Surface.DegreeV + 1) * this->Width; }

private:
  const NurbsSurface& Surface;
  const Vec3 Origin;
  std::vector<SpanToBezier> Spans;
  std::size_t Width;
  std::vector<Vec4> Points; ///< a row of the surface, homogeneous about the origin
  std::vector<Vec4> Kept;
  int Next = 0;
};

/// Divides a net of constant weight by it; says whether weights differ.
bool NormaliseWeights(Vec4* net, int size)
{
  double low = net[0].w(), high = low;
  for (int i = 1; i < size; ++i)
  {
    low = std::min(low, net[i].w());
    high = std::max(high, net[i].w());
  }
  if (high - low > 1e-15 * high)
  {
    return true;
  }
  for (int i = 0; i < size && !(low == 1.0 && high == 1.0); ++i)
  {
    net[i].head<3>() /= net[i].w();
    net[i].w() = 1.0;
  }
  return false;
}

/// Whether all points along a side are within the tolerance of its first.
bool IsCollapsed(const BezierPatch& patch, const Vec4* net, int side, double tolerance)
{
  const int p = patch.DegreeU, q = patch.DegreeV, nu = p + 1;
  const int first = side == 1 ? p : (side == 3 ? q * nu : 0);
  const int step = side < 2 ? nu : 1, count = side < 2 ? q : p;
  const Vec3 start = CartesianPoint(net[first]);
  for (int k = 1; k <= count; ++k)
  {
    if (!((CartesianPoint(net[first + k * step]) - start).norm() <= tolerance))
    {
      return false;
    }
  }
  return true;
}

/// @param reach at least the extent of the patch.
void FindCollapsedSides(BezierPatch& patch, const Vec4* net, double reach)
{
  constexpr double Share = 1e-9; // of the patch, which a collapsed side may extend
  double tolerance = -1;         // known when it is needed
  for (int side = 0; side < 4; ++side)
  {
    if (!IsCollapsed(patch, net, side, Share * reach))
    {
      patch.Collapsed[side] = false;
      continue;
    }
    if (tolerance < 0)
    {
      double extent = 0;
      const Vec3 first = CartesianPoint(net[0]);
      for (int k = 1; k < (patch.DegreeU + 1) * (patch.DegreeV + 1); ++k)
      {
        extent = std::max(extent, (CartesianPoint(net[k]) - first).cwiseAbs().maxCoeff());
      }
      tolerance = Share * extent;
    }
    patch.Collapsed[side] = IsCollapsed(patch, net, side, tolerance);
  }
}

/// More than any two points of the surface are apart.
double ReachOf(const NurbsSurface& surface, const Vec3& origin)
{
  double farthest = 0;
  for (const Vec4& point : surface.ControlPoints)
  {
    farthest = std::max(farthest, (point.head<3>() - origin).cwiseAbs().maxCoeff());
  }
  return 4 * farthest;
}

/// At least twice the room each time: a shell's faces come one by one.
template <typename Value>
void MakeRoom(PageVector<Value>& list, std::size_t added)
{
  const std::size_t size = list.size() + added;
  if (size > list.capacity())
  {
    list.reserve(std::max(size, 2 * list.capacity()));
  }
}

}

void Decompose(const NurbsSurface& surface, int face, const Vec3& origin, KnotSpans& spansU,
  KnotSpans& spansV, PageVector<BezierPatch>& patches, PageVector<Vec4>& nets)
{
  const int p = surface.DegreeU, q = surface.DegreeV;
  spansU = FindSpans(p, surface.CountU, surface.KnotsU);
  spansV = FindSpans(q, surface.CountV, surface.KnotsV);
  const int countU = static_cast<int>(spansU.Breaks.size()) - 1;
  const int countV = static_cast<int>(spansV.Breaks.size()) - 1;

  BezierRows rows(surface, spansU, origin);
  const double reach = ReachOf(surface, origin);
  const int size = (p + 1) * (q + 1);
  const std::size_t added = static_cast<std::size_t>(countU) * countV;
  MakeRoom(patches, added);
  MakeRoom(nets, added * size);
  for (int spanV = 0; spanV < countV; ++spanV)
  {
    const SpanToBezier convert(q, surface.KnotsV, spansV.Breaks[spanV], spansV.Breaks[spanV + 1]);
    rows.Advance(convert.First + q);
    const Vec4* row[MaximumDegree + 1];
    for (int j = 0; j <= q; ++j)
    {
      row[j] = rows.Row(convert.First + j);
    }
    for (int spanU = 0; spanU < countU; ++spanU)
    {
      BezierPatch patch;
      patch.Face = face;
      patch.DegreeU = p;
      patch.DegreeV = q;
      patch.U0 = spansU.Breaks[spanU];
      patch.U1 = spansU.Breaks[spanU + 1];
      patch.V0 = spansV.Breaks[spanV];
      patch.V1 = spansV.Breaks[spanV + 1];
      patch.Sides[0] = spansU.Kinds[spanU];
      patch.Sides[1] = spansU.Kinds[spanU + 1];
      patch.Sides[2] = spansV.Kinds[spanV];
      patch.Sides[3] = spansV.Kinds[spanV + 1];
      patch.Net = nets.size();
      nets.resize(nets.size() + size);
      Vec4* net = nets.data() + patch.Net;
      for (int i = 0; i <= p; ++i)
      {
        const std::size_t column = static_cast<std::size_t>(spanU) * (p + 1) + i;
        convert.Convert([&](int j) -> const Vec4& { return row[j][column]; }, net + i, p + 1);
      }
      patch.Rational = NormaliseWeights(net, size);
      FindCollapsedSides(patch, net, reach);
      patches.push_back(patch);
    }
  }
}

//------------------------------------------------------------------------------
// Evaluation
//------------------------------------------------------------------------------
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

template <int P, int Q>
inline void EvaluateNet(
  const BezierPatch& patch, const Vec4* net, double s, double t, SurfaceJet& jet)
{
  const int p = P < 0 ? patch.DegreeU : P;
  const int q = Q < 0 ? patch.DegreeV : Q;
  const Bernstein<P> bu(p, s);
  const Bernstein<Q> bv(q, t);
  Quad a, au, av, auu, auv, avv;
  const double* point = net->data();
  for (int j = 0; j <= q; ++j)
  {
    Quad row, rowU, rowUU;
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

}

void EvaluateBezier(const BezierPatch& patch, const Vec4* net, double s, double t, SurfaceJet& jet)
{
  switch (patch.DegreeU * 64 + patch.DegreeV)
  {
    case 3 * 64 + 3:
      return EvaluateNet<3, 3>(patch, net, s, t, jet);
    case 3 * 64 + 1:
      return EvaluateNet<3, 1>(patch, net, s, t, jet);
    case 1 * 64 + 3:
      return EvaluateNet<1, 3>(patch, net, s, t, jet);
    case 2 * 64 + 2:
      return EvaluateNet<2, 2>(patch, net, s, t, jet);
    case 2 * 64 + 1:
      return EvaluateNet<2, 1>(patch, net, s, t, jet);
    case 1 * 64 + 2:
      return EvaluateNet<1, 2>(patch, net, s, t, jet);
    case 1 * 64 + 1:
      return EvaluateNet<1, 1>(patch, net, s, t, jet);
    default:
      return EvaluateNet<-1, -1>(patch, net, s, t, jet);
  }
}

namespace
{

/// Bernstein polynomials without derivatives.
struct BernsteinValues
{
  double N[MaximumBezierDegree + 1];

  BernsteinValues(int degree, double x)
  {
    this->N[0] = 1.0;
    for (int j = 1; j <= degree; ++j)
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

Quad HomogeneousPoint(const BezierPatch& patch, const Vec4* net, double s, double t)
{
  const BernsteinValues bu(patch.DegreeU, s), bv(patch.DegreeV, t);
  Quad a;
  const double* point = net->data();
  for (int j = 0; j <= patch.DegreeV; ++j)
  {
    Quad row;
    for (int i = 0; i <= patch.DegreeU; ++i, point += 4)
    {
      row.Add(bu.N[i], point);
    }
    a.Add(bv.N[j], row);
  }
  return a;
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

//------------------------------------------------------------------------------
// Restriction
//------------------------------------------------------------------------------
namespace
{

/// Restricts one row of coefficients to [x0, x1], 0 <= x0 < x1 <= 1, in place.
void RestrictRow(Vec4* c, int degree, std::size_t stride, double x0, double x1)
{
  if (x1 < 1.0)
  {
    for (int r = 1; r <= degree; ++r)
    {
      for (int i = degree; i >= r; --i)
      {
        c[i * stride] = (1.0 - x1) * c[(i - 1) * stride] + x1 * c[i * stride];
      }
    }
  }
  if (x0 > 0.0)
  {
    const double x = x0 / x1;
    for (int r = 1; r <= degree; ++r)
    {
      for (int i = 0; i <= degree - r; ++i)
      {
        c[i * stride] = (1.0 - x) * c[i * stride] + x * c[(i + 1) * stride];
      }
    }
  }
}

/// As RestrictRow, but for any order of x0 and x1, equal ones included (blossoms).
void BlossomRow(Vec4* c, int degree, std::size_t stride, double x0, double x1)
{
  Vec4 result[MaximumDegree + 1], d[MaximumDegree + 1];
  for (int m = 0; m <= degree; ++m)
  {
    for (int i = 0; i <= degree; ++i)
    {
      d[i] = c[i * stride];
    }
    for (int r = 1; r <= degree; ++r)
    {
      const double x = r <= m ? x1 : x0;
      for (int i = 0; i <= degree - r; ++i)
      {
        d[i] = (1.0 - x) * d[i] + x * d[i + 1];
      }
    }
    result[m] = d[0];
  }
  for (int m = 0; m <= degree; ++m)
  {
    c[m * stride] = result[m];
  }
}

double Binomial(int n, int k)
{
  double value = 1.0;
  for (int i = 1; i <= k; ++i)
  {
    value = value * (n - k + i) / i;
  }
  return value;
}

}

void RestrictNet(
  const BezierPatch& patch, const Vec4* net, double s0, double s1, double t0, double t1, Vec4* part)
{
  const int nu = patch.DegreeU + 1, nv = patch.DegreeV + 1;
  std::copy(net, net + nu * nv, part);
  if (s0 > 0.0 || s1 < 1.0)
  {
    for (int j = 0; j < nv; ++j)
    {
      RestrictRow(part + j * nu, patch.DegreeU, 1, s0, s1);
    }
  }
  if (t0 > 0.0 || t1 < 1.0)
  {
    for (int i = 0; i < nu; ++i)
    {
      RestrictRow(part + i, patch.DegreeV, nu, t0, t1);
    }
  }
}

BezierPatch CurveOnPatch(const BezierPatch& patch, const PageVector<Vec4>& pool, const Vec2& from,
  const Vec2& to, PageVector<Vec4>& nets)
{
  const int p = patch.DegreeU, q = patch.DegreeV;
  std::vector<Vec4> part(pool.begin() + patch.Net, pool.begin() + patch.Net + (p + 1) * (q + 1));
  for (int j = 0; j <= q; ++j)
  {
    BlossomRow(part.data() + j * (p + 1), p, 1, from.x(), to.x());
  }
  for (int i = 0; i <= p; ++i)
  {
    BlossomRow(part.data() + i, q, p + 1, from.y(), to.y());
  }
  // The diagonal of the part: products of Bernstein polynomials of degree p and q.
  BezierPatch curve;
  curve.Face = patch.Face;
  curve.Curve = true;
  curve.DegreeU = p + q;
  curve.DegreeV = 0;
  curve.U0 = patch.U(from.x(), 0);
  curve.U1 = patch.U(to.x(), 0);
  curve.V0 = patch.V(0, from.y());
  curve.V1 = patch.V(0, to.y());
  for (SideKind& side : curve.Sides)
  {
    side = SideKind::Border;
  }
  std::vector<Vec4> net(p + q + 1, Vec4::Zero());
  for (int l = 0; l <= q; ++l)
  {
    for (int k = 0; k <= p; ++k)
    {
      net[k + l] +=
        (Binomial(p, k) * Binomial(q, l) / Binomial(p + q, k + l)) * part[k + l * (p + 1)];
    }
  }
  curve.Rational = NormaliseWeights(net.data(), p + q + 1);
  curve.Net = nets.size();
  nets.insert(nets.end(), net.begin(), net.end());
  return curve;
}

}
