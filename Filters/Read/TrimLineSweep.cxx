#include "TrimLineSweep.h"

#include "AxisSense.h"
#include "CurveCrossing.h"
#include "CurveEvaluation.h"
#include "PlaceText.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace nurbs
{
namespace
{
/// Below this share of the lengths involved areas vanish, directions are parallel.
constexpr double Negligible = 1e-9;
/// The same for the chord between two samples of a curve.
constexpr double NegligibleAngle = 1e-6;

/// Places along the lines at which the skin is asked for its normal.
constexpr int PlaceCount = 32;
/// How far round them, as a share of the diagonal of the lines' box.
constexpr double Reach = 0.1;

/// How far an automatic sweep reaches beyond the part, as a share of the part's own extent.
constexpr double Margin = 0.1;

using Polygon = std::vector<Vec3>;

std::vector<Polygon> MakePolygons(const std::vector<TrimLine>& lines)
{
  std::vector<Polygon> polygons;
  for (const TrimLine& line : lines)
  {
    polygons.emplace_back();
    for (const CurveSample& sample : SampleCurve(line.Curve))
    {
      polygons.back().push_back(sample.Point);
    }
  }
  return polygons;
}

/// Area that a closed polygon encloses, along the axis about which it turns right-handed.
Vec3 EnclosedArea(const Polygon& polygon)
{
  Vec3 area = Vec3::Zero();
  for (size_t i = 2; i < polygon.size(); ++i)
  {
    area += 0.5 * (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
  }
  return area;
}

double LengthOf(const Polygon& polygon)
{
  double length = 0.0;
  for (size_t i = 1; i < polygon.size(); ++i)
  {
    length += (polygon[i] - polygon[i - 1]).norm();
  }
  return length;
}

/// Places along all polygons, evenly spaced.
std::vector<Vec3> SpreadPlaces(const std::vector<Polygon>& polygons)
{
  double total = 0.0;
  for (const Polygon& polygon : polygons)
  {
    total += LengthOf(polygon);
  }
  const double step = total / PlaceCount;
  std::vector<Vec3> places;
  double next = 0.5 * step;
  double passed = 0.0;
  for (const Polygon& polygon : polygons)
  {
    for (size_t i = 1; i < polygon.size(); ++i)
    {
      const double size = (polygon[i] - polygon[i - 1]).norm();
      for (; next < passed + size; next += step)
      {
        places.push_back(polygon[i - 1] + (next - passed) / size * (polygon[i] - polygon[i - 1]));
      }
      passed += size;
    }
  }
  return places;
}

/// The normal of what closed lines enclose, its largest coordinate positive; 0 0 1 if there are
/// none.
Vec3 EnclosedNormal(const std::vector<TrimLine>& lines, const std::vector<Polygon>& polygons)
{
  Vec3 sum = Vec3::Zero();
  for (size_t i = 0; i < lines.size(); ++i)
  {
    const Vec3 area = lines[i].Closed ? EnclosedArea(polygons[i]) : Vec3(Vec3::Zero());
    sum += area.dot(sum) < 0.0 ? Vec3(-area) : area;
  }
  if (!(sum.norm() > 0.0) || !sum.allFinite())
  {
    return Vec3::UnitZ();
  }
  return PositiveSense(sum.normalized());
}

/// Extent of points along a direction.
struct Interval
{
  double Low = std::numeric_limits<double>::infinity();
  double High = -std::numeric_limits<double>::infinity();
  void Add(double value)
  {
    this->Low = std::min(this->Low, value);
    this->High = std::max(this->High, value);
  }
};

/// Far enough to pass through the box along the direction from anywhere on the polygons.
double PassingLength(
  const std::vector<Polygon>& polygons, const Vec3& direction, const Eigen::AlignedBox3d& box)
{
  Interval lines, part;
  for (const Polygon& polygon : polygons)
  {
    for (const Vec3& point : polygon)
    {
      lines.Add(point.dot(direction));
    }
  }
  for (int corner = 0; corner < 8; ++corner)
  {
    part.Add(box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)).dot(direction));
  }
  return std::max(part.High - lines.Low, lines.High - part.Low) + Margin * (part.High - part.Low);
}

/// Names a line where there are several.
std::string NameOf(const std::vector<TrimLine>& lines, size_t i)
{
  if (lines.size() == 1)
  {
    return "the line";
  }
  const std::string number = "line " + std::to_string(i + 1);
  return lines[i].Name.empty() ? number : number + " \"" + lines[i].Name + "\"";
}

std::string FindCourseDefect(
  const std::vector<TrimLine>& lines, const std::vector<Polygon>& polygons, const Sweep& sweep)
{
  for (size_t k = 0; k < lines.size(); ++k)
  {
    const Polygon& polygon = polygons[k];
    for (size_t i = 1; i < polygon.size(); ++i)
    {
      const Vec3 chord = polygon[i] - polygon[i - 1];
      // Not where two samples coincide.
      if (chord.cross(sweep.Direction).norm() < NegligibleAngle * chord.norm())
      {
        return "Direction is along " + NameOf(lines, k) + " at " + PlaceText(polygon[i - 1]) +
          "; give a direction across the line";
      }
    }
  }
  return {};
}

std::string FindAreaDefect(
  const std::vector<TrimLine>& lines, const std::vector<Polygon>& polygons, const Sweep& sweep)
{
  for (size_t k = 0; k < lines.size(); ++k)
  {
    const double length = LengthOf(polygons[k]);
    if (lines[k].Closed &&
      std::abs(EnclosedArea(polygons[k]).dot(sweep.Direction)) <= Negligible * length * length)
    {
      return NameOf(lines, k) +
        " is closed and encloses no area, seen along Direction; move its points or change "
        "Direction";
    }
  }
  return {};
}

std::string DescribeCrossing(const std::vector<TrimLine>& lines, const CurveCrossing& crossing)
{
  // What rounding left of a zero is no place.
  double reach = 0.0;
  for (const Vec4& point : lines[crossing.First].Curve.Points)
  {
    reach = std::max(reach, point.head<3>().cwiseAbs().maxCoeff());
  }
  const Vec3 at = (crossing.Place.array().abs() < 1e-12 * reach).select(0.0, crossing.Place);
  const std::string place = " at " + PlaceText(at);
  if (crossing.First != crossing.Second)
  {
    return NameOf(lines, crossing.First) + " and " + NameOf(lines, crossing.Second) +
      " cross or touch each other" + place + ", seen along Direction; take one of them away";
  }
  const std::string what = crossing.TurnsBack ? " turns back on itself" : " crosses itself";
  return NameOf(lines, crossing.First) + what + place +
    ", seen along Direction; move or remove points there, or change Direction";
}

/// How many times the polygon winds round a place, seen along the direction, is odd.
bool Encloses(const Polygon& polygon, const Vec3& place, const Vec3& direction)
{
  const Vec3 across = direction.unitOrthogonal();
  const Vec3 up = direction.cross(across);
  bool inside = false;
  for (size_t i = 1; i < polygon.size(); ++i)
  {
    const Vec3 a = polygon[i - 1] - place, b = polygon[i] - place;
    const double ya = a.dot(up), yb = b.dot(up);
    if ((ya > 0.0) != (yb > 0.0))
    {
      const double x = a.dot(across) + (b - a).dot(across) * ya / (ya - yb);
      inside = inside != (x > 0.0);
    }
  }
  return inside;
}

/// Does the place lie to the left of an open polygon, by the chord nearest to it?
bool LiesLeft(const Polygon& polygon, const Vec3& place, const Vec3& direction)
{
  double nearest = std::numeric_limits<double>::infinity();
  double side = 0.0;
  for (size_t i = 1; i < polygon.size(); ++i)
  {
    const auto flat = [&](const Vec3& p) { return Vec3(p - p.dot(direction) * direction); };
    const Vec3 chord = flat(polygon[i] - polygon[i - 1]);
    const Vec3 arm = flat(place - polygon[i - 1]);
    const double share = std::clamp(arm.dot(chord) / chord.squaredNorm(), 0.0, 1.0);
    const double distance = (arm - share * chord).norm();
    // At a corner both chords are as near: the one that sees the place less slantingly decides.
    const double height = direction.dot(chord.normalized().cross(arm));
    if (distance < nearest * (1.0 - 1e-9) ||
      (distance <= nearest * (1.0 + 1e-9) && std::abs(height) > std::abs(side)))
    {
      nearest = distance;
      side = height;
    }
  }
  return side > 0.0;
}

const Vec3& MiddleOf(const Polygon& polygon)
{
  return polygon[polygon.size() / 2];
}

/// Is the normal C' x Direction, to the right of the line, to be turned round?
std::vector<char> FindTurned(
  const std::vector<TrimLine>& lines, const std::vector<Polygon>& polygons, const Vec3& direction)
{
  const size_t count = lines.size();
  std::vector<char> turned(count, 0);
  size_t firstClosed = count;
  for (size_t i = count; i-- > 0;)
  {
    if (!lines[i].Closed)
    {
      continue;
    }
    firstClosed = i;
    turned[i] = EnclosedArea(polygons[i]).dot(direction) > 0.0;
    for (size_t k = 0; k < count; ++k)
    {
      if (k != i && lines[k].Closed && Encloses(polygons[k], polygons[i][0], direction))
      {
        turned[i] = !turned[i];
      }
    }
  }
  // What is kept lies to the left of a line that is not turned.
  size_t firstOpen = count;
  for (size_t i = 0; i < count; ++i)
  {
    if (lines[i].Closed)
    {
      continue;
    }
    if (firstClosed < count)
    {
      turned[i] = !LiesLeft(polygons[i], polygons[firstClosed][0], direction);
    }
    else if (firstOpen < count)
    {
      const bool firstKeeps = LiesLeft(polygons[firstOpen], MiddleOf(polygons[i]), direction);
      turned[i] = LiesLeft(polygons[i], MiddleOf(polygons[firstOpen]), direction) != firstKeeps;
    }
    firstOpen = std::min(firstOpen, i);
  }
  return turned;
}
}

//------------------------------------------------------------------------------
Sweep CompleteSweep(const Sweep& wanted, const std::vector<TrimLine>& lines, const SheetSkin* skin)
{
  const std::vector<Polygon> polygons = MakePolygons(lines);
  const bool hasSkin = skin && !skin->IsEmpty();
  Sweep sweep = wanted;
  Eigen::AlignedBox3d box;
  for (const Polygon& polygon : polygons)
  {
    for (const Vec3& point : polygon)
    {
      box.extend(point);
    }
  }
  const double size = box.diagonal().norm();
  if (sweep.Direction.isZero(0.0))
  {
    sweep.Direction = hasSkin ? skin->MeanNormal(SpreadPlaces(polygons), Reach * size)
                              : EnclosedNormal(lines, polygons);
  }
  sweep.Direction = sweep.Direction.stableNormalized();
  if (sweep.Length == 0.0)
  {
    sweep.Length = hasSkin ? PassingLength(polygons, sweep.Direction, skin->WholeBox()) : size;
  }
  return sweep;
}

//------------------------------------------------------------------------------
std::string FindDefect(const std::vector<TrimLine>& lines, const Sweep& sweep)
{
  if (!sweep.Direction.allFinite() || sweep.Direction.isZero(0.0))
  {
    return "Direction is not finite; give a direction across the line, or 0 0 0 to have it found";
  }
  if (!std::isfinite(sweep.Length) || sweep.Length <= 0.0)
  {
    std::ostringstream text;
    text << "Length is " << sweep.Length
         << "; it must be positive and reach through the part, or 0 to have it found";
    return text.str();
  }
  const std::vector<Polygon> polygons = MakePolygons(lines);
  std::string defect = FindCourseDefect(lines, polygons, sweep);
  if (!defect.empty())
  {
    return defect;
  }
  const CurveCrossing crossing = FindCrossing(lines, sweep.Direction);
  // What encloses nothing turns back too, and an eight may enclose nothing by symmetry.
  if (!crossing.Found || crossing.TurnsBack)
  {
    defect = FindAreaDefect(lines, polygons, sweep);
  }
  return defect.empty() && crossing.Found ? DescribeCrossing(lines, crossing) : defect;
}

//------------------------------------------------------------------------------
std::vector<NurbsSurface> SweepLines(const std::vector<TrimLine>& lines, const Sweep& sweep)
{
  const std::vector<char> turned = FindTurned(lines, MakePolygons(lines), sweep.Direction);
  std::vector<NurbsSurface> surfaces;
  for (size_t i = 0; i < lines.size(); ++i)
  {
    const NurbsSurface surface =
      Extrude(lines[i].Curve, sweep.Direction, -sweep.Length, sweep.Length).Surface;
    surfaces.push_back(turned[i] ? ReverseU(surface) : surface);
  }
  return surfaces;
}
}
