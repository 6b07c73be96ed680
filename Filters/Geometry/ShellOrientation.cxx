#include "ShellOrientation.h"

#include "BezierEvaluation.h"
#include "ModelEvaluation.h"
#include "Sectors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace nurbs
{
namespace
{

/// Sets of faces, each with its orientation relative to the root of its set.
class OrientedSets
{
public:
  explicit OrientedSets(int count)
    : Parent(count)
    , Sign(count, 1)
  {
    std::iota(this->Parent.begin(), this->Parent.end(), 0);
  }
  int Find(int face, int& sign) const
  {
    sign = 1;
    while (this->Parent[face] != face)
    {
      sign *= this->Sign[face];
      face = this->Parent[face];
    }
    return face;
  }
  /// A contradiction (a Moebius band) leaves what was found first.
  void Join(int a, int b, int relative)
  {
    int signA, signB;
    const int rootA = this->Find(a, signA), rootB = this->Find(b, signB);
    if (rootA != rootB)
    {
      this->Parent[rootB] = rootA;
      this->Sign[rootB] = signA * signB * relative;
    }
  }

private:
  std::vector<int> Parent;
  std::vector<int> Sign;
};

/// Votes of all places where two faces share an edge: > 0 if they are oriented alike.
using Votes = std::map<std::pair<int, int>, int>;

/// Whether two rays are one edge of two faces, and do not run on along one free border: beside a
/// narrow face the next one may be nearer than the gap.
bool ShareEdge(
  const Sector& a, const BorderRay& rayA, const Sector& b, const BorderRay& rayB, bool closely)
{
  return rayA.Direction.dot(rayB.Direction) > 0.95 &&
    (closely || InsideOf(a, rayA).dot(InsideOf(b, rayB)) < 0.9);
}

/// Loops of faces that have an edge in common lie that near to each other: so many times as far as
/// the nearest, or within that share of the gap. Faces behind a narrow one are farther.
constexpr double LoopSpread = 3.0;
constexpr double LoopPrecision = 0.003;

/// Of the votes of two faces for others so small a share is one of places where they come near to
/// each other by chance, as where bodies touch.
constexpr double ChanceVotes = 0.1;

/// Cosine of the angle under which a place counts as ahead, not beside.
constexpr double Ahead = 0.87;

/// Whether a border ray is of the border that x lies on: of a face narrower than the gap the ends
/// of that border, and so the borders across it, come within the gap as well.
bool RunsThrough(const SurfaceModel& model, int face, const BorderRay& ray, const Vec3& x)
{
  const Vec3 way = x - FacePoint(model, face, ray.From);
  return way.norm() <= 4 * model.Resolution || way.dot(ray.Direction) > Ahead * way.norm();
}

/// A border ray of another face, or of a seam's other side, that is the same edge.
struct Partner
{
  int Face;
  bool InsideIsLeft;
  double Angle; ///< round the edge, from the first face to this one, 0 to 2 pi
};

/// Of several faces at an edge, as where bodies touch each other along it, those next to the first
/// one to either side: what lies between is on one side of both. Where faces touch under no angle
/// it is not known which these are.
std::vector<Partner> KeepNeighbours(std::vector<Partner> partners)
{
  constexpr double certain = 0.02;
  if (partners.size() < 2)
  {
    return partners;
  }
  std::sort(partners.begin(), partners.end(),
    [](const Partner& a, const Partner& b) { return a.Angle < b.Angle; });
  const std::size_t last = partners.size() - 1;
  std::vector<Partner> neighbours;
  if (partners[0].Angle > certain && partners[1].Angle - partners[0].Angle > certain)
  {
    neighbours.push_back(partners[0]);
  }
  if (2 * M_PI - partners[last].Angle > certain &&
    partners[last].Angle - partners[last - 1].Angle > certain)
  {
    neighbours.push_back(partners[last]);
  }
  return neighbours;
}

/// Gives the vote of a border ray through x, with the faces that lie nearest beside it: behind a
/// narrow one there may be others within the gap, and others at the ends of a short one.
/// @return false if there is none.
bool VoteAlong(const SurfaceModel& model, const std::vector<Sector>& sectors, const Vec3& x,
  const Sector& sector, const BorderRay& ray, bool closely, Votes& votes)
{
  const auto forPartners = [&](const auto& visit)
  {
    for (const Sector& other : sectors)
    {
      const double ahead = std::abs((other.Nearest - x).dot(ray.Direction));
      const bool beside = ahead <= Ahead * other.Away + 4 * model.Resolution;
      for (int j = 0; j < other.RayCount && beside && &other != &sector; ++j)
      {
        if (ShareEdge(sector, ray, other, other.Rays[j], closely))
        {
          visit(other, other.Rays[j]);
        }
      }
    }
  };
  double nearest = std::numeric_limits<double>::infinity();
  forPartners(
    [&](const Sector& other, const BorderRay&) { nearest = std::min(nearest, other.Away); });
  const Vec3 inside = InsideOf(sector, ray), up = sector.Weighted.normalized();
  std::vector<Partner> partners;
  forPartners(
    [&](const Sector& other, const BorderRay& partner)
    {
      if (other.Away <= LoopSpread * nearest + LoopPrecision * model.Gap)
      {
        const Vec3 way = InsideOf(other, partner);
        const double angle = std::atan2(way.dot(up), way.dot(inside));
        partners.push_back(
          { other.Face, partner.InsideIsLeft, angle < 0 ? angle + 2 * M_PI : angle });
      }
    });
  for (const Partner& partner : KeepNeighbours(std::move(partners)))
  {
    // Along one direction the inside is left of one face and right of the other.
    if (partner.Face != sector.Face)
    {
      votes[std::minmax(sector.Face, partner.Face)] +=
        ray.InsideIsLeft != partner.InsideIsLeft ? 1 : -1;
    }
  }
  return nearest < std::numeric_limits<double>::infinity();
}

/// False if no other face shares an edge with the face there.
bool VoteWithin(const SurfaceModel& model, const Vec3& x, double gap, int face, Votes& votes)
{
  bool voted = false;
  const std::vector<Sector> sectors = FindSectors(model, x, gap);
  for (const Sector& sector : sectors)
  {
    for (int i = 0; i < sector.RayCount && sector.Face == face; ++i)
    {
      const BorderRay& ray = sector.Rays[i];
      voted = (RunsThrough(model, face, ray, x) &&
                VoteAlong(model, sectors, x, sector, ray, gap <= model.Gap, votes)) ||
        voted;
    }
  }
  return voted;
}

void VoteAt(const SurfaceModel& model, const Vec3& x, int face, Votes& votes)
{
  double gap = model.Gap;
  while (gap > 0 && !VoteWithin(model, x, gap, face, votes))
  {
    gap = model.NextGap(gap);
  }
}

/// Calls visit(patch, kind, place) for the borders of all patches: by side, and 4 for a loop's
/// curve.
template <typename Visit>
void ForBorders(const SurfaceModel& model, const Visit& visit)
{
  const double s[5] = { 0, 1, 0.5, 0.5, 0.5 }, t[5] = { 0.5, 0.5, 0, 1, 0 };
  for (const BezierPatch& patch : model.Patches)
  {
    for (int kind = patch.Curve ? 4 : 0; kind < (patch.Curve ? 5 : 4); ++kind)
    {
      if (patch.Curve || (patch.Sides[kind] == SideKind::Border && !patch.Collapsed[kind]))
      {
        visit(patch, kind, Vec2(s[kind], t[kind]));
      }
    }
  }
}

Votes CollectVotes(const SurfaceModel& model)
{
  constexpr int most = 64; // a loop of thousands of points need not vote with each
  std::vector<std::array<int, 5>> count(model.Faces.size()), seen(model.Faces.size());
  ForBorders(
    model, [&](const BezierPatch& patch, int kind, const Vec2&) { ++count[patch.Face][kind]; });
  Votes votes;
  ForBorders(model,
    [&](const BezierPatch& patch, int kind, const Vec2& place)
    {
      const int stride = 1 + count[patch.Face][kind] / most;
      if (seen[patch.Face][kind]++ % stride == 0)
      {
        VoteAt(
          model, BezierPoint(patch, model.Net(patch), place.x(), place.y()), patch.Face, votes);
      }
    });
  return votes;
}

}

void OrientShells(SurfaceModel& model)
{
  const int count = static_cast<int>(model.Faces.size());
  if (count < 2)
  {
    return;
  }
  const Votes votes = CollectVotes(model);
  std::vector<int> most(count, 0); // of the votes with one other face
  for (const auto& vote : votes)
  {
    most[vote.first.first] = std::max(most[vote.first.first], std::abs(vote.second));
    most[vote.first.second] = std::max(most[vote.first.second], std::abs(vote.second));
  }
  std::vector<std::pair<int, std::pair<int, int>>> order;
  for (const auto& vote : votes)
  {
    const int least = std::min(most[vote.first.first], most[vote.first.second]);
    if (std::abs(vote.second) > ChanceVotes * least)
    {
      order.push_back({ -std::abs(vote.second), vote.first });
    }
  }
  std::sort(order.begin(), order.end()); // the clearest first
  OrientedSets sets(count);
  for (const auto& entry : order)
  {
    sets.Join(entry.second.first, entry.second.second, votes.at(entry.second) >= 0 ? 1 : -1);
  }
  std::vector<int> largest(count, -1);
  int sign;
  for (int face = 0; face < count; ++face)
  {
    int& best = largest[sets.Find(face, sign)];
    if (best < 0 || model.Data[face].Area > model.Data[best].Area)
    {
      best = face;
    }
  }
  for (int face = 0; face < count; ++face)
  {
    int reference;
    const int root = sets.Find(face, sign);
    sets.Find(largest[root], reference);
    model.Data[face].Sign = sign * reference;
  }
}

}
