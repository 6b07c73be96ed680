#include "BezierDecomposition.h"

#include "SpanToBezier.h"
#include "WeightSpans.h"

#include <algorithm>

namespace nurbs
{
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

std::vector<SpanToBezier> ConvertSpans(
  int degree, const std::vector<double>& knots, const KnotSpans& spans)
{
  std::vector<SpanToBezier> converters;
  converters.reserve(spans.Count());
  for (int k = 0; k < spans.Count(); ++k)
  {
    converters.emplace_back(degree, knots, spans.Breaks[k], spans.Breaks[k + 1]);
  }
  return converters;
}

/// The rows of control points of a surface, Bezier in u: each when it is needed, the last few kept.
class BezierRows
{
public:
  BezierRows(
    const NurbsSurface& surface, bool equalWeights, const KnotSpans& spansU, const Vec3& origin)
    : Surface(surface)
    , EqualWeights(equalWeights)
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
        const double w = this->EqualWeights ? 1.0 : given[i].w();
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
  const bool EqualWeights; ///< as good as 1 each
  const Vec3 Origin;
  std::vector<SpanToBezier> Spans;
  std::size_t Width;
  std::vector<Vec4> Points; ///< a row of the surface, homogeneous about the origin
  std::vector<Vec4> Kept;
  int Next = 0;
};

/// Whether all points along a side are within the tolerance of its first.
bool IsCollapsed(const BezierPatch& patch, const Vec4* net, int side, double tolerance)
{
  const NetSide points(patch, side);
  const Vec3 start = CartesianPoint(net[points.First]);
  for (int k = 1; k <= points.Degree; ++k)
  {
    if (!((CartesianPoint(net[points.At(k)]) - start).squaredNorm() <= tolerance * tolerance))
    {
      return false;
    }
  }
  return true;
}

/// @param reach at least the extent of the patch.
void FindCollapsedSides(BezierPatch& patch, const Vec4* net, double reach)
{
  constexpr double Share = 1e-8; // of the patch, which a collapsed side may extend
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

/// Finds sides that the knots join smoothly, but where the derivative across vanishes:
/// control points that are repeated make an edge.
/// @param reach at least the extent of the patch.
void FindSharpSides(BezierPatch& patch, const Vec4* net, double reach)
{
  constexpr double Share = 1e-10;
  for (int side = 0; side < 4; ++side)
  {
    const NetSide points(patch, side);
    bool sharp = patch.Sides[side] == SideKind::Smooth;
    for (int k = 0; k <= points.Degree && sharp; ++k)
    {
      const Vec4* point = net + points.At(k);
      sharp =
        (CartesianPoint(point[0]) - CartesianPoint(point[points.Inwards])).cwiseAbs().maxCoeff() <=
        Share * reach;
    }
    patch.Sides[side] = sharp ? SideKind::Sharp : patch.Sides[side];
  }
}

/// Whether no weight of the surface differs from another.
bool HasEqualWeights(const NurbsSurface& surface)
{
  const double weight = surface.ControlPoints.front().w();
  return std::all_of(surface.ControlPoints.begin(), surface.ControlPoints.end(),
    [weight](const Vec4& point) { return point.w() == weight; });
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

/// The patch between knots, without its net.
BezierPatch PatchBetween(const KnotSpans& spansU, int u, const KnotSpans& spansV, int v)
{
  BezierPatch patch;
  patch.U0 = spansU.Breaks[u];
  patch.U1 = spansU.Breaks[u + 1];
  patch.V0 = spansV.Breaks[v];
  patch.V1 = spansV.Breaks[v + 1];
  patch.Sides[0] = spansU.Kinds[u];
  patch.Sides[1] = spansU.Kinds[u + 1];
  patch.Sides[2] = spansV.Kinds[v];
  patch.Sides[3] = spansV.Kinds[v + 1];
  return patch;
}

/// At least twice the room each time: a shell's faces come one by one.
template <typename Value>
void MakeRoom(UnsetVector<Value>& list, std::size_t added)
{
  const std::size_t size = list.size() + added;
  if (size > list.capacity())
  {
    list.reserve(std::max(size, 2 * list.capacity()));
  }
}

}

void Decompose(const NurbsSurface& surface, int face, const Vec3& origin, KnotSpans& spansU,
  KnotSpans& spansV, UnsetVector<BezierPatch>& patches, UnsetVector<Vec4>& nets,
  const std::function<void(const BezierPatch&, const Vec4* net)>& visit)
{
  const int p = surface.DegreeU, q = surface.DegreeV;
  spansU = FindSpans(p, surface.CountU, surface.KnotsU);
  spansV = FindSpans(q, surface.CountV, surface.KnotsV);
  DivideByWeights(surface, spansU, spansV);
  const int countU = spansU.Count(), countV = spansV.Count();

  const bool equalWeights = HasEqualWeights(surface);
  BezierRows rows(surface, equalWeights, spansU, origin);
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
      BezierPatch patch = PatchBetween(spansU, spanU, spansV, spanV);
      patch.Face = face;
      patch.DegreeU = p;
      patch.DegreeV = q;
      patch.Net = nets.size();
      nets.resize(nets.size() + size);
      Vec4* net = nets.data() + patch.Net;
      for (int i = 0; i <= p; ++i)
      {
        const std::size_t column = static_cast<std::size_t>(spanU) * (p + 1) + i;
        convert.Convert([&](int j) -> const Vec4& { return row[j][column]; }, net + i, p + 1);
      }
      if (equalWeights)
      {
        // What the factors of the points sum up to is 1 but for rounding.
        std::for_each(net, net + size, [](Vec4& point) { point.w() = 1.0; });
      }
      patch.Rational = !equalWeights && NormaliseWeights(net, size);
      FindCollapsedSides(patch, net, reach);
      FindSharpSides(patch, net, reach);
      visit(patch, net);
      patches.push_back(patch);
    }
  }
}

}
