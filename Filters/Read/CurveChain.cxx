#include "CurveChain.h"

#include "CurveEvaluation.h"
#include "PlaceText.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <sstream>

namespace nurbs
{
namespace
{
/// Shares of the size of all curves: ends nearer than the first always meet, ends farther apart
/// than the second never do, whatever the file says.
constexpr double LeastTolerance = 1e-6;
constexpr double LargestTolerance = 1e-3;

/// Open ends nearer than so many tolerances, or this share of the size, are worth a remark.
constexpr double SuspiciousTolerances = 10.0;
constexpr double SuspiciousShare = 1e-3;

/// Points nearer to each other than this share of a curve's length coincide.
constexpr double Negligible = 1e-9;

constexpr size_t None = static_cast<size_t>(-1);

double PolygonLength(const ConvertedCurve& curve)
{
  double length = 0.0;
  for (size_t i = 1; i < curve.Points.size(); ++i)
  {
    length += (curve.Points[i] - curve.Points[i - 1]).head<3>().norm();
  }
  return length;
}

bool IsRational(const ConvertedCurve& curve)
{
  return std::any_of(curve.Points.begin(), curve.Points.end(),
    [&](const Vec4& p) { return p[3] != curve.Points.front()[3]; });
}

/// The beginning (even number) or end (odd) of a curve.
struct End
{
  Vec3 Place;
  double Tolerance;
  size_t Partner = None; ///< the end that it joins
};

class Ends
{
public:
  explicit Ends(const std::vector<FileCurve>& curves)
  {
    Eigen::AlignedBox3d box;
    for (const FileCurve& curve : curves)
    {
      for (const Vec4& point : curve.Curve.Points)
      {
        box.extend(Vec3(point.head<3>()));
      }
    }
    this->Size = box.diagonal().norm();
    for (const FileCurve& curve : curves)
    {
      const double tolerance =
        std::clamp(curve.Tolerance, LeastTolerance * this->Size, LargestTolerance * this->Size);
      this->All.push_back({ curve.Curve.Points.front().head<3>(), tolerance });
      this->All.push_back({ curve.Curve.Points.back().head<3>(), tolerance });
      // What is shorter than that joins nothing.
      this->Used.push_back(PolygonLength(curve.Curve) > tolerance);
      this->Widest = std::max(this->Widest, tolerance);
    }
    for (size_t i = 0; i < this->All.size(); ++i)
    {
      if (this->Used[i / 2])
      {
        this->Order.push_back(i);
      }
    }
    std::sort(this->Order.begin(), this->Order.end(),
      [this](size_t a, size_t b)
      {
        const double x = this->All[a].Place.x(), y = this->All[b].Place.x();
        return x != y ? x < y : a < b;
      });
  }

  /// Finds partners; false if there is an end with two, `place` is where.
  bool Match(Vec3& place)
  {
    for (size_t i : this->Order)
    {
      const std::vector<size_t> near = this->Near(i, 1.0, 0.0);
      if (near.size() > 1)
      {
        place = this->All[i].Place;
        return false;
      }
      this->All[i].Partner = near.empty() ? None : near[0];
    }
    return true;
  }

  /// Open ends that lie near each other, as one remark; empty: there are none.
  std::string DescribeGaps() const
  {
    for (size_t i : this->Order)
    {
      if (this->All[i].Partner != None)
      {
        continue;
      }
      for (size_t j : this->Near(i, SuspiciousTolerances, SuspiciousShare * this->Size))
      {
        if (this->All[j].Partner == None && i / 2 != j / 2)
        {
          std::ostringstream text;
          text << "curves end at " << PlaceText(this->All[i].Place) << " and at "
               << PlaceText(this->All[j].Place) << ", "
               << (this->All[i].Place - this->All[j].Place).norm()
               << " apart, which is more than the tolerance of "
               << std::max(this->All[i].Tolerance, this->All[j].Tolerance)
               << "; close the gap in the CAD program if they are one line";
          return text.str();
        }
      }
    }
    return {};
  }

  std::vector<End> All;
  std::vector<char> Used; ///< of every curve

private:
  /// Other ends within so many tolerances, or nearer than `least`.
  std::vector<size_t> Near(size_t end, double factor, double least) const
  {
    const End& from = this->All[end];
    const double reach = std::max(factor * this->Widest, least);
    auto at = std::lower_bound(this->Order.begin(), this->Order.end(), from.Place.x() - reach,
      [this](size_t i, double x) { return this->All[i].Place.x() < x; });
    std::vector<size_t> found;
    for (; at != this->Order.end() && this->All[*at].Place.x() <= from.Place.x() + reach; ++at)
    {
      const End& to = this->All[*at];
      if (*at != end &&
        (to.Place - from.Place).norm() <=
          std::max(factor * std::max(from.Tolerance, to.Tolerance), least))
      {
        found.push_back(*at);
      }
    }
    return found;
  }

  double Size = 0.0;         ///< of all curves together
  double Widest = 0.0;       ///< tolerance
  std::vector<size_t> Order; ///< ends of used curves by x
};

/// The ends at which the pieces of one line begin, one after the other.
struct Chain
{
  std::vector<size_t> Begins;
  bool Closed = false;
};

/// Follows the partners from the beginning of a piece, marking what it passes as not used.
Chain Follow(Ends& ends, size_t begin)
{
  Chain chain;
  while (true)
  {
    chain.Begins.push_back(begin);
    ends.Used[begin / 2] = 0;
    const size_t next = ends.All[begin ^ 1].Partner;
    chain.Closed = next == chain.Begins.front();
    if (next == None || chain.Closed)
    {
      return chain;
    }
    begin = next;
  }
}

/// The chain in the direction of its first curve in the file; a closed one begins with it.
void Straighten(Chain& chain)
{
  const auto first = std::min_element(
    chain.Begins.begin(), chain.Begins.end(), [](size_t a, size_t b) { return a / 2 < b / 2; });
  const bool backwards = *first % 2 == 1;
  if (chain.Closed)
  {
    std::rotate(chain.Begins.begin(), backwards ? first + 1 : first, chain.Begins.end());
  }
  if (backwards)
  {
    std::reverse(chain.Begins.begin(), chain.Begins.end());
    for (size_t& begin : chain.Begins)
    {
      begin ^= 1;
    }
  }
}

/// Do so many control points coincide, from this one on?
bool Coincide(const std::vector<Vec4>& points, size_t first, int count, double tolerance)
{
  return std::all_of(points.begin() + first, points.begin() + first + count,
    [&](const Vec4& p) { return (p - points[first]).head<3>().norm() <= tolerance; });
}

/// Does the curve stay at one place between two knots, as at a point that the file has twice?
bool StandsStill(const ConvertedCurve& curve, double tolerance)
{
  for (size_t i = 0; i + curve.Degree < curve.Points.size(); ++i)
  {
    if (curve.Knots[i + curve.Degree] < curve.Knots[i + curve.Degree + 1] &&
      Coincide(curve.Points, i, curve.Degree + 1, tolerance))
    {
      return true;
    }
  }
  return false;
}

/// The curve without the spans in which it stands still: swept, they are no surface.
ConvertedCurve WithoutStandstills(const ConvertedCurve& curve)
{
  const double tolerance = Negligible * PolygonLength(curve);
  if (!StandsStill(curve, tolerance))
  {
    return curve;
  }
  const ConvertedCurve pieces = WithBezierKnots(curve, curve.Degree);
  const size_t degree = curve.Degree;
  ConvertedCurve result;
  result.Degree = curve.Degree;
  result.Knots.assign(degree + 1, pieces.Knots.front());
  result.Points.push_back(pieces.Points.front());
  double weight = 1.0; // those of a piece have to fit to the piece before
  for (size_t i = 0; i + degree < pieces.Points.size(); i += degree)
  {
    if (Coincide(pieces.Points, i, curve.Degree + 1, tolerance))
    {
      weight *= pieces.Points[i][3] / pieces.Points[i + degree][3];
      continue;
    }
    const double length = pieces.Knots[i + degree + 1] - pieces.Knots[i + degree];
    result.Knots.insert(result.Knots.end(), degree, result.Knots.back() + length);
    for (size_t k = i + 1; k <= i + degree; ++k)
    {
      result.Points.push_back(pieces.Points[k]);
      result.Points.back()[3] *= weight;
    }
  }
  result.Knots.push_back(result.Knots.back());
  return result;
}

/// Moves the ends where two pieces join onto one place.
void Meet(ConvertedCurve& piece, ConvertedCurve& next)
{
  const Vec3 end = piece.Points.back().head<3>();
  const Vec3 begin = next.Points.front().head<3>();
  const bool stays = IsRational(piece), nextStays = IsRational(next);
  const Vec3 place = stays == nextStays ? Vec3(0.5 * (end + begin)) : stays ? end : begin;
  piece.Points.back().head<3>() = place;
  next.Points.front().head<3>() = place;
}

/// Appends a piece that begins where the curve ends; its parameters are scaled to its length.
void Append(ConvertedCurve& curve, const ConvertedCurve& piece)
{
  const double start = curve.Knots.empty() ? 0.0 : curve.Knots.back();
  const double scale = PolygonLength(piece) / (piece.Knots.back() - piece.Knots.front());
  // Weights count relative to each other: those of the piece are made to fit.
  const double weight = curve.Points.empty() ? 1.0 / piece.Points.front()[3]
                                             : curve.Points.back()[3] / piece.Points.front()[3];
  const auto place = [&](double knot) { return start + scale * (knot - piece.Knots.front()); };
  const int degree = piece.Degree;
  curve.Degree = degree;
  if (curve.Points.empty())
  {
    curve.Knots.assign(degree + 1, start);
    curve.Points.push_back(piece.Points.front());
    curve.Points.back()[3] = 1.0;
  }
  else
  {
    curve.Knots.pop_back();
  }
  std::transform(
    piece.Knots.begin() + degree + 1, piece.Knots.end(), std::back_inserter(curve.Knots), place);
  for (size_t i = 1; i < piece.Points.size(); ++i)
  {
    curve.Points.push_back(piece.Points[i]);
    curve.Points.back()[3] *= weight;
  }
}

TrimLine MakeLine(const std::vector<FileCurve>& curves, const Chain& chain)
{
  TrimLine line;
  line.Closed = chain.Closed;
  std::vector<ConvertedCurve> pieces;
  int degree = 1;
  for (size_t begin : chain.Begins)
  {
    const FileCurve& curve = curves[begin / 2];
    pieces.push_back(WithoutStandstills(begin % 2 == 1 ? ReverseCurve(curve.Curve) : curve.Curve));
    line.Name = line.Name.empty() ? curve.Name : line.Name;
    degree = std::max(degree, curve.Curve.Degree);
  }
  const size_t count = pieces.size();
  for (size_t i = 0; i + !chain.Closed < count; ++i)
  {
    Meet(pieces[i], pieces[(i + 1) % count]);
  }
  for (const ConvertedCurve& piece : pieces)
  {
    Append(line.Curve, ElevateDegree(piece, degree));
  }
  return line;
}
}

//------------------------------------------------------------------------------
bool JoinCurves(
  const std::vector<FileCurve>& curves, std::vector<TrimLine>& lines, std::string& message)
{
  lines.clear();
  message.clear();
  Ends ends(curves);
  Vec3 place;
  if (!ends.Match(place))
  {
    message = "more than two curves end at " + PlaceText(place) +
      "; leave only those in the file that make up the trim lines, each once";
    return false;
  }
  std::vector<Chain> chains;
  for (bool open : { true, false })
  {
    for (size_t i = 0; i < ends.All.size(); ++i)
    {
      if (ends.Used[i / 2] && (!open || ends.All[i].Partner == None))
      {
        chains.push_back(Follow(ends, i));
        Straighten(chains.back());
      }
    }
  }
  std::sort(chains.begin(), chains.end(),
    [](const Chain& a, const Chain& b)
    {
      const auto byFile = [](size_t x, size_t y) { return x / 2 < y / 2; };
      return *std::min_element(a.Begins.begin(), a.Begins.end(), byFile) / 2 <
        *std::min_element(b.Begins.begin(), b.Begins.end(), byFile) / 2;
    });
  for (const Chain& chain : chains)
  {
    lines.push_back(MakeLine(curves, chain));
  }
  message = ends.DescribeGaps();
  if (lines.empty())
  {
    message = "all curves are shorter than the tolerance; export the trim lines again";
  }
  return !lines.empty();
}
}
