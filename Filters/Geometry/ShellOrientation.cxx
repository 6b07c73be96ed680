#include "ShellOrientation.h"

#include "FacePlaces.h"
#include "ModelEvaluation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

namespace nurbs
{
namespace
{

/// Sets of faces, each with its orientation relative to the root of its set, and votes between
/// sets: > 0 if their roots are oriented alike.
class OrientedSets
{
public:
  explicit OrientedSets(int count)
    : Parent(count)
    , Sign(count, 1)
    , Between(count)
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
  /// Gives two sets their votes for each other.
  void Set(int a, int b, double votes)
  {
    this->Between[a][b] = votes;
    this->Between[b][a] = votes;
    this->Links.push({ votes, std::min(a, b), std::max(a, b) });
  }
  /// The clearest first, by all votes of a set: a single pair of faces may be mistaken. What
  /// contradicts (a Moebius band) leaves what was found first.
  void JoinAll()
  {
    while (!this->Links.empty())
    {
      const Link link = this->Links.top();
      this->Links.pop();
      const auto known = this->Between[link.A].find(link.B);
      if (known != this->Between[link.A].end() && known->second == link.Votes)
      {
        this->Join(link.A, link.B, link.Votes >= 0 ? 1 : -1);
      }
    }
  }

private:
  struct Link
  {
    double Votes;
    int A, B;
    bool operator<(const Link& other) const
    {
      return std::make_tuple(std::abs(this->Votes), other.A, other.B) <
        std::make_tuple(std::abs(other.Votes), this->A, this->B);
    }
  };

  void Join(int a, int b, int relative)
  {
    const bool swapped = this->Between[a].size() < this->Between[b].size();
    const int root = swapped ? b : a, joined = swapped ? a : b;
    this->Parent[joined] = root;
    this->Sign[joined] = relative;
    this->Between[root].erase(joined);
    const std::map<int, double> moved = std::move(this->Between[joined]);
    this->Between[joined].clear();
    for (const auto& [other, votes] : moved)
    {
      if (other != root)
      {
        this->Between[other].erase(joined);
        this->Set(root, other, this->Between[root][other] + relative * votes);
      }
    }
  }

  std::vector<int> Parent;
  std::vector<int> Sign;
  std::vector<std::map<int, double>> Between; ///< of roots
  std::priority_queue<Link> Links;
};

/// Of all places where two faces share an edge, by the length of border that each stands for:
/// > 0 if they are oriented alike. A straight border has one place, a curved one may have many:
/// counted alike, those of a sliver of a face would outvote all that is around it.
struct Vote
{
  double Sum = 0;
  double Back = 0; ///< of this, where one runs back along the other one
};
using Votes = std::map<std::pair<int, int>, Vote>;

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

/// Two faces of which one runs back from the other one's edge under a smaller angle may be one
/// lying on the other, as in a file that has a face twice, or the two sides of a sharp edge.
constexpr double CertainAngle = 0.02;

/// Of several faces at an edge, as where bodies touch each other along it, those next to the first
/// one to either side: what lies between is on one side of both. Where faces touch under no angle
/// it is not known which these are.
std::vector<Partner> KeepNeighbours(std::vector<Partner> partners)
{
  if (partners.size() < 2)
  {
    return partners;
  }
  std::sort(partners.begin(), partners.end(),
    [](const Partner& a, const Partner& b) { return a.Angle < b.Angle; });
  const std::size_t last = partners.size() - 1;
  std::vector<Partner> neighbours;
  if (partners[0].Angle > CertainAngle && partners[1].Angle - partners[0].Angle > CertainAngle)
  {
    neighbours.push_back(partners[0]);
  }
  if (2 * M_PI - partners[last].Angle > CertainAngle &&
    partners[last].Angle - partners[last - 1].Angle > CertainAngle)
  {
    neighbours.push_back(partners[last]);
  }
  return neighbours;
}

/// Gives the vote of a border ray through x, with its weight, with the faces that lie nearest
/// beside it: behind a narrow one there may be others within the gap, and others at the ends of a
/// short one.
/// @return false if there is none.
bool VoteAlong(const SurfaceModel& model, const std::vector<Sector>& sectors, const Vec3& x,
  const Sector& sector, const BorderRay& ray, bool closely, double weight, Votes& votes)
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
      Vote& vote = votes[std::minmax(sector.Face, partner.Face)];
      const bool turnsBack = std::min(partner.Angle, 2 * M_PI - partner.Angle) < CertainAngle;
      const double own = ray.InsideIsLeft != partner.InsideIsLeft ? weight : -weight;
      vote.Sum += own;
      vote.Back += turnsBack ? own : 0.0;
    }
  }
  return nearest < std::numeric_limits<double>::infinity();
}

/// False if no other face shares an edge with the face there.
bool VoteWithin(
  const SurfaceModel& model, const Vec3& x, double gap, int face, double weight, Votes& votes)
{
  bool voted = false;
  const std::vector<Sector> sectors = FindSectors(model, x, gap);
  for (const Sector& sector : sectors)
  {
    for (int i = 0; i < sector.RayCount && sector.Face == face; ++i)
    {
      const BorderRay& ray = sector.Rays[i];
      voted = (RunsThrough(model, face, ray, x) &&
                VoteAlong(model, sectors, x, sector, ray, gap <= model.Gap, weight, votes)) ||
        voted;
    }
  }
  return voted;
}

void VoteAt(const SurfaceModel& model, const Vec3& x, int face, double weight, Votes& votes)
{
  double gap = model.Gap;
  while (gap > 0 && !VoteWithin(model, x, gap, face, weight, votes))
  {
    gap = model.NextGap(gap);
  }
}

/// Length of a border of a patch, by side, or of a loop's curve: of its control polygon.
double MeasureBorder(const BezierPatch& patch, const Vec4* net, int kind)
{
  const NetSide points(patch, patch.Curve ? 2 : kind);
  double length = 0;
  for (int k = 1; k <= points.Degree; ++k)
  {
    length += (CartesianPoint(net[points.At(k)]) - CartesianPoint(net[points.At(k - 1)])).norm();
  }
  return length;
}

/// How many borders of one kind a face has, how many of them were visited, and their length.
struct BorderCount
{
  int Count = 0, Seen = 0;
  double Length = 0;
};

Votes CollectVotes(const SurfaceModel& model)
{
  constexpr int most = 64; // a loop of thousands of points need not vote with each
  std::vector<std::array<BorderCount, 5>> borders(model.Faces.size());
  ForBorders(model,
    [&](const BezierPatch& patch, int kind, const Vec2&)
    {
      BorderCount& border = borders[patch.Face][kind];
      ++border.Count;
      border.Length += MeasureBorder(patch, model.Net(patch), kind);
    });
  Votes votes;
  ForBorders(model,
    [&](const BezierPatch& patch, int kind, const Vec2& place)
    {
      BorderCount& border = borders[patch.Face][kind];
      const Vec4* net = model.Net(patch);
      const double length = MeasureBorder(patch, net, kind);
      const bool isLong = most * length > border.Length; // it stands for itself alone
      const int stride = 1 + border.Count / most;
      if (border.Seen++ % stride == 0 || isLong)
      {
        VoteAt(model, BezierPoint(patch, net, place.x(), place.y()), patch.Face,
          isLong ? length : stride * length, votes);
      }
    });
  return votes;
}

/// To which side the largest faces of a shell look as they came, relative to its root. A box that
/// was written as separate faces has several of one size: most of them decide, as else rounding
/// would tell which is the largest. Of as many either way the first one decides.
class ShellSide
{
public:
  double Largest = 0.0;

  void Add(double area, int sign)
  {
    constexpr double rounding = 1e-6;
    if (area >= (1 - rounding) * this->Largest)
    {
      this->First = this->First == 0 ? sign : this->First;
      this->Votes += sign;
    }
  }
  /// 1 or -1: like the root or not.
  int Decide() const { return this->Votes == 0 ? this->First : this->Votes > 0 ? 1 : -1; }

private:
  int First = 0, Votes = 0;
};

}

void OrientShells(SurfaceModel& model)
{
  const int count = static_cast<int>(model.Faces.size());
  if (count < 2)
  {
    return;
  }
  Votes votes = CollectVotes(model);
  std::vector<double> most(count, 0.0); // of the votes with one other face
  for (auto& [faces, vote] : votes)
  {
    const auto [a, b] = faces;
    // The same twice: the edge of the one is that of the other, and no turn.
    if (vote.Back != 0 && (LiesOn(model, a, b, model.Gap) || LiesOn(model, b, a, model.Gap)))
    {
      vote.Sum -= 2 * vote.Back;
    }
    most[a] = std::max(most[a], std::abs(vote.Sum));
    most[b] = std::max(most[b], std::abs(vote.Sum));
  }
  OrientedSets sets(count);
  for (const auto& [faces, vote] : votes)
  {
    const auto [a, b] = faces;
    if (std::abs(vote.Sum) > ChanceVotes * std::min(most[a], most[b]))
    {
      sets.Set(a, b, vote.Sum);
    }
  }
  sets.JoinAll();
  std::vector<ShellSide> sides(count);
  int sign;
  for (int face = 0; face < count; ++face)
  {
    ShellSide& side = sides[sets.Find(face, sign)];
    side.Largest = std::max(side.Largest, model.Data[face].Area);
  }
  for (int face = 0; face < count; ++face)
  {
    sides[sets.Find(face, sign)].Add(model.Data[face].Area, sign);
  }
  for (int face = 0; face < count; ++face)
  {
    const int reference = sides[sets.Find(face, sign)].Decide();
    model.Data[face].Sign = sign * reference;
  }
}

}
