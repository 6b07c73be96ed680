#include "Sectors.h"

#include "BezierEvaluation.h"
#include "ClosestPoint.h"
#include "ModelEvaluation.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace nurbs
{
namespace
{

/// A place where a patch comes within the gap of the point.
struct Contact
{
  int Patch;
  LocalFoot Foot;
};

/// A place of a loop and where the loop goes on to either way, in (u, v).
struct LoopPlace
{
  Vec2 At, Forward, Backward;
  bool Straight; ///< in the middle of an edge
};

/// The unit tangent of a patch along a direction in (u, v); zero along a collapsed side, where
/// there is no way to go.
Vec3 TangentAlong(const BezierPatch& patch, const SurfaceJet& jet, const Vec2& d)
{
  const Vec2 local(d.x() / (patch.U1 - patch.U0), d.y() / (patch.V1 - patch.V0));
  const Vec3 x = local.x() * jet.Su + local.y() * jet.Sv;
  const double length = x.norm();
  return length > 1e-9 * local.norm() * (jet.Su.norm() + jet.Sv.norm()) ? Vec3(x / length)
                                                                        : Vec3(Vec3::Zero());
}

/// Where a patch goes from one place towards another one, also where its derivative vanishes.
Vec3 WayAlong(const BezierPatch& patch, const Vec4* net, const Vec2& from, const Vec2& to)
{
  SurfaceJet jet;
  EvaluateBezier(patch, net, from.x(), from.y(), jet);
  const Vec2 d = to - from;
  const Vec3 tangent = d.x() * jet.Su + d.y() * jet.Sv;
  const Vec3 chord = BezierPoint(patch, net, to.x(), to.y()) - jet.S;
  if (tangent.norm() > 1e-6 * chord.norm())
  {
    return tangent;
  }
  Vec3 way = Vec3::Zero();
  for (double part = 1e-3; part < 1 && !(way.norm() > 1e-9 * chord.norm()); part *= 4)
  {
    const Vec2 near = from + part * d;
    way = BezierPoint(patch, net, near.x(), near.y()) - jet.S;
  }
  return way;
}

/// The angle of a face at a vertex of a loop that goes on forward and backward.
double AngleInside(const Vec3& forward, const Vec3& backward, const Vec3& normal, bool insideIsLeft)
{
  // From forward round to backward.
  double angle = std::atan2(forward.cross(backward).dot(normal), forward.dot(backward));
  angle = angle < 0 ? angle + 2 * M_PI : angle;
  return insideIsLeft ? angle : 2 * M_PI - angle;
}

class SectorFinder
{
public:
  SectorFinder(const SurfaceModel& model, const Vec3& x, double gap)
    : Model(model)
    , X(x)
    , Gap(gap)
  {
  }

  std::vector<Sector> Find()
  {
    this->FindContacts();
    // The nearest first: of a face that is narrower than the gap both borders come here as one
    // place, of which the first is taken.
    std::stable_sort(this->Contacts.begin(), this->Contacts.end(),
      [](const Contact& a, const Contact& b) { return a.Foot.Squared < b.Foot.Squared; });
    for (const Contact& contact : this->Contacts)
    {
      if (this->Model.Patches[contact.Patch].Curve)
      {
        this->AddLoopSector(contact);
      }
    }
    const std::size_t loopSectors = this->Sectors.size();
    for (const Contact& contact : this->Contacts)
    {
      if (!this->Model.Patches[contact.Patch].Curve)
      {
        this->AddPatchSector(contact, loopSectors);
      }
    }
    return std::move(this->Sectors);
  }

private:
  LocalFoot FootOn(int index) const;
  void FindContacts();
  void AddLoopSector(const Contact& contact);
  void AddPatchSector(const Contact& contact, std::size_t loopSectors);
  void AddCollapsedSector(const Contact& contact, int side);
  template <typename Place>
  void AddRaysFromPole(const BezierPatch& patch, int pole, const Place& place, Sector& sector);
  void AddRay(Sector& sector, const BezierPatch& patch, double s0, double t0, double s1, double t1,
    bool insideIsLeft);
  bool SamePlace(int face, const Vec2& a, const Vec2& b) const;
  bool IsKnown(const Sector& sector, std::size_t count) const;
  LoopPlace PlaceOnLoop(const Contact& contact, const Vec2& foot) const;
  std::array<bool, 4> SidesAt(const Contact& contact) const;
  double AddSideRays(
    Sector& sector, const BezierPatch& patch, double s, double t, const std::array<bool, 4>& on);

  const SurfaceModel& Model;
  const Vec3 X;
  const double Gap;
  std::vector<Contact> Contacts;
  std::vector<Sector> Sectors;
  std::vector<std::pair<int, int>> Poles; ///< patch and side of those that were added
};

/// The foot on a leaf. Newton's steps towards a side where the derivative vanishes are short: what
/// is nearest there is looked for along the side.
LocalFoot SectorFinder::FootOn(int index) const
{
  const SurfaceModel& model = this->Model;
  const BezierPatch& patch = model.Patches[model.Leaves[index].Patch];
  const PartDomain domain = DomainOf(patch, index);
  LocalFoot foot = FootOnLeaf(model, index, this->X);
  const double ends[4] = { domain.S0, domain.S1, domain.T0, domain.T1 };
  for (int side = 0; side < 4 && !patch.Curve; ++side)
  {
    if (patch.Sides[side] == SideKind::Sharp && ends[side] == side % 2)
    {
      PartDomain line = domain;
      (side < 2 ? line.S0 : line.T0) = (side < 2 ? line.S1 : line.T1) = side % 2;
      const double s = std::clamp(foot.S, line.S0, line.S1);
      const double t = std::clamp(foot.T, line.T0, line.T1);
      const LocalFoot onSide = InvertPoint(patch, model.Net(patch), this->X, s, t, line);
      foot = onSide.Squared < foot.Squared ? onSide : foot;
    }
  }
  return foot;
}

void SectorFinder::FindContacts()
{
  const SurfaceModel& model = this->Model;
  model.ForLeavesNear(this->X, this->Gap,
    [&](int index)
    {
      const Leaf& leaf = model.Leaves[index];
      const LocalFoot foot = this->FootOn(index);
      if (foot.Squared > this->Gap * this->Gap)
      {
        return;
      }
      for (Contact& other : this->Contacts)
      {
        // The same place seen from a neighbouring leaf; opposite ends of a patch are not.
        if (other.Patch == leaf.Patch && std::abs(other.Foot.S - foot.S) < 0.5 &&
          std::abs(other.Foot.T - foot.T) < 0.5)
        {
          if (foot.Squared < other.Foot.Squared)
          {
            other.Foot = foot;
          }
          return;
        }
      }
      this->Contacts.push_back({ leaf.Patch, foot });
    });
}

/// Both points are near X already; they are one place unless a seam lies between them.
bool SectorFinder::SamePlace(int face, const Vec2& a, const Vec2& b) const
{
  const FaceData& data = this->Model.Data[face];
  const Vec2 size = data.High() - data.Low();
  return std::abs(a.x() - b.x()) < 0.1 * size.x() && std::abs(a.y() - b.y()) < 0.1 * size.y();
}

/// Whether one of the first sectors is of the same face and place.
bool SectorFinder::IsKnown(const Sector& sector, std::size_t count) const
{
  return std::any_of(this->Sectors.begin(), this->Sectors.begin() + count,
    [&](const Sector& other)
    {
      return other.Face == sector.Face &&
        this->SamePlace(sector.Face, other.Parameters, sector.Parameters);
    });
}

/// The foot on the loop, or the end of its edge if that is near.
LoopPlace SectorFinder::PlaceOnLoop(const Contact& contact, const Vec2& foot) const
{
  const SurfaceModel& model = this->Model;
  const BezierPatch& curve = model.Patches[contact.Patch];
  const FaceData& data = model.Data[curve.Face];
  const TrimLoops::Edge& edge = data.Loops.LoopEdge(curve.Loop, curve.LoopEdge);
  LoopPlace place{ foot, edge.To, edge.From, true };
  const double toFirst = (contact.Foot.Point - FacePoint(model, curve.Face, edge.From)).norm();
  const double toLast = (contact.Foot.Point - FacePoint(model, curve.Face, edge.To)).norm();
  if (toFirst <= this->Gap && toFirst <= toLast)
  {
    place.At = edge.From;
    place.Backward = data.Loops.LoopEdge(curve.Loop, curve.LoopEdge - 1).From;
    place.Straight = false;
  }
  else if (toLast <= this->Gap)
  {
    place.At = edge.To;
    place.Forward = data.Loops.LoopEdge(curve.Loop, curve.LoopEdge + 1).To;
    place.Straight = false;
  }
  const Vec2 low = data.Low(), high = data.High();
  place.At.x() = std::clamp(place.At.x(), low.x(), high.x());
  place.At.y() = std::clamp(place.At.y(), low.y(), high.y());
  return place;
}

void SectorFinder::AddLoopSector(const Contact& contact)
{
  const SurfaceModel& model = this->Model;
  const BezierPatch& curve = model.Patches[contact.Patch];
  Sector sector;
  sector.Face = curve.Face;
  sector.Nearest = contact.Foot.Point;
  sector.Away = std::sqrt(contact.Foot.Squared);
  sector.Parameters = Vec2(curve.U(contact.Foot.S, 0), curve.V(contact.Foot.S, 0));
  if (this->IsKnown(sector, this->Sectors.size()))
  {
    return;
  }
  const LoopPlace place = this->PlaceOnLoop(contact, sector.Parameters);
  sector.Parameters = place.At;
  const BezierPatch& patch = model.Patches[model.PatchAt(curve.Face, place.At.x(), place.At.y())];
  const Vec2 local = patch.Local(place.At);
  SurfaceJet jet;
  EvaluateBezier(patch, model.Net(patch), local.x(), local.y(), jet);
  const Vec3 normal = UnitNormal(model, patch, local.x(), local.y());
  const Vec3 a = TangentAlong(patch, jet, place.Forward - place.At);
  const Vec3 b = TangentAlong(patch, jet, place.Backward - place.At);
  const bool left = model.Data[curve.Face].Loops.InsideIsLeft(curve.Loop);
  const double angle = place.Straight ? M_PI : AngleInside(a, b, normal, left);
  // Straight is also a vertex of a polygon along a curve.
  sector.Straight = place.Straight || std::abs(angle - M_PI) < 0.3;
  const Vec3 size = 1e-9 * (jet.Su.cwiseAbs() + jet.Sv.cwiseAbs() + jet.Suv.cwiseAbs());
  const bool atPole = jet.Su.norm() <= size.norm() || jet.Sv.norm() <= size.norm();
  if (!atPole) // else the collapsed side of the patch has the angle
  {
    sector.Weighted = angle * normal;
  }
  if (a.norm() > 0)
  {
    sector.Rays[sector.RayCount++] = { place.At, place.Forward, a, left };
  }
  if (b.norm() > 0)
  {
    sector.Rays[sector.RayCount++] = { place.At, place.Backward, b, !left };
  }
  this->Sectors.push_back(sector);
}

void SectorFinder::AddRay(Sector& sector, const BezierPatch& patch, double s0, double t0, double s1,
  double t1, bool insideIsLeft)
{
  const Vec3 direction = WayAlong(patch, this->Model.Net(patch), Vec2(s0, t0), Vec2(s1, t1));
  if (!(direction.norm() > 0))
  {
    return;
  }
  const Vec2 from(patch.U(s0, t0), patch.V(s0, t0)), to(patch.U(s1, t1), patch.V(s1, t1));
  const TrimLoops& loops = this->Model.Data[patch.Face].Loops;
  const Vec2 ahead = from + 1e-6 * (to - from);
  if (loops.Empty() || loops.Inside(ahead.x(), ahead.y()))
  {
    sector.Rays[sector.RayCount++] = { from, to, direction.normalized(), insideIsLeft };
  }
}

/// The sides of its patch that a contact lies on.
std::array<bool, 4> SectorFinder::SidesAt(const Contact& contact) const
{
  const BezierPatch& patch = this->Model.Patches[contact.Patch];
  const double s = contact.Foot.S, t = contact.Foot.T;
  const double sideS[4] = { 0, 1, s, s }, sideT[4] = { t, t, 0, 1 };
  std::array<bool, 4> on;
  for (int side = 0; side < 4; ++side)
  {
    const double away = std::abs(side < 2 ? s - sideS[side] : t - sideT[side]);
    on[side] = away < 0.5 &&
      (away == 0 ||
        (BezierPoint(patch, this->Model.Net(patch), sideS[side], sideT[side]) - contact.Foot.Point)
            .norm() <= this->Gap);
  }
  return on;
}

void SectorFinder::AddPatchSector(const Contact& contact, std::size_t loopSectors)
{
  const BezierPatch& patch = this->Model.Patches[contact.Patch];
  const std::array<bool, 4> on = this->SidesAt(contact);
  for (int side = 0; side < 4; ++side)
  {
    if (on[side] && patch.Collapsed[side])
    {
      return this->AddCollapsedSector(contact, side);
    }
  }
  const double s = on[0] ? 0 : (on[1] ? 1 : contact.Foot.S);
  const double t = on[2] ? 0 : (on[3] ? 1 : contact.Foot.T);
  Sector sector;
  sector.Face = patch.Face;
  sector.Nearest = contact.Foot.Point;
  sector.Away = std::sqrt(contact.Foot.Squared);
  sector.Parameters = Vec2(patch.U(s, t), patch.V(s, t));
  // Where a loop runs it says what of the face is here.
  if (this->IsKnown(sector, loopSectors) ||
    !IsInsideTrim(this->Model, contact.Patch, contact.Foot.S, contact.Foot.T))
  {
    return;
  }
  const double angle = this->AddSideRays(sector, patch, s, t, on);
  sector.Weighted = angle * UnitNormal(this->Model, patch, s, t);
  this->Sectors.push_back(sector);
}

/// Adds rays along the sides of a patch that are borders; returns the angle that it fills.
double SectorFinder::AddSideRays(
  Sector& sector, const BezierPatch& patch, double s, double t, const std::array<bool, 4>& on)
{
  const bool onS = on[0] || on[1], onT = on[2] || on[3];
  const auto border = [&](int side)
  { return on[side] && patch.Sides[side] == SideKind::Border && !patch.Collapsed[side]; };
  if (onS && onT)
  {
    const Vec3 a = WayAlong(patch, this->Model.Net(patch), Vec2(s, t), Vec2(1 - s, t));
    const Vec3 b = WayAlong(patch, this->Model.Net(patch), Vec2(s, t), Vec2(s, 1 - t));
    const bool even = (s == 0) == (t == 0);
    if (border(s == 0 ? 0 : 1))
    {
      this->AddRay(sector, patch, s, t, s, 1 - t, !even);
    }
    if (border(t == 0 ? 2 : 3))
    {
      this->AddRay(sector, patch, s, t, 1 - s, t, even);
    }
    return std::atan2(a.cross(b).norm(), a.dot(b));
  }
  if (onS && border(s == 0 ? 0 : 1))
  {
    this->AddRay(sector, patch, s, t, s, 1, s == 1);
    this->AddRay(sector, patch, s, t, s, 0, s == 0);
    sector.Straight = true;
  }
  else if (onT && border(t == 0 ? 2 : 3))
  {
    this->AddRay(sector, patch, s, t, 1, t, t == 0);
    this->AddRay(sector, patch, s, t, 0, t, t == 1);
    sector.Straight = true;
  }
  return onS || onT ? M_PI : 2 * M_PI;
}

/// The rays of the sides that run down from a pole.
/// @param place place(along, depth): from 0 to 1 along the collapsed side, and from it into the
/// patch.
template <typename Place>
void SectorFinder::AddRaysFromPole(
  const BezierPatch& patch, int pole, const Place& place, Sector& sector)
{
  if (!this->Model.Data[patch.Face].Loops.Empty())
  {
    return;
  }
  const int sides[2] = { pole < 2 ? 2 : 0, pole < 2 ? 3 : 1 }; // at along = 0 and 1
  for (int k = 0; k < 2; ++k)
  {
    if (patch.Sides[sides[k]] == SideKind::Border && !patch.Collapsed[sides[k]])
    {
      const Vec2 from = place(k, 0), to = place(k, 1);
      // Left of the ray is inside where (ray, inwards from it) is counter-clockwise.
      const Vec2 d = to - from, in = place(0.5, 0.5) - from;
      this->AddRay(
        sector, patch, from.x(), from.y(), to.x(), to.y(), d.x() * in.y() - d.y() * in.x() > 0);
    }
  }
}

/// A pole: the sector opens over the whole length of the collapsed side.
void SectorFinder::AddCollapsedSector(const Contact& contact, int side)
{
  constexpr int Samples = 16;
  // Every leaf along the side comes here with the same point.
  const std::pair<int, int> pole(contact.Patch, side);
  if (std::find(this->Poles.begin(), this->Poles.end(), pole) != this->Poles.end())
  {
    return;
  }
  this->Poles.push_back(pole);
  const SurfaceModel& model = this->Model;
  const BezierPatch& patch = model.Patches[contact.Patch];
  const Vec4* net = model.Net(patch);
  const TrimLoops& loops = model.Data[patch.Face].Loops;
  const double end = side % 2, inwards = side % 2 == 0 ? 1 : -1;
  const auto place = [&](double along, double depth)
  {
    const double across = end + inwards * depth;
    return side < 2 ? Vec2(across, along) : Vec2(along, across);
  };
  const auto direction = [&](double along) -> Vec3
  {
    const Vec2 x = place(along, 0);
    SurfaceJet jet;
    EvaluateBezier(patch, net, x.x(), x.y(), jet);
    Vec3 d = inwards * (side < 2 ? jet.Su : jet.Sv);
    const Vec2 deep = place(along, 1e-3);
    const Vec3 chord = BezierPoint(patch, net, deep.x(), deep.y()) - jet.S;
    return d.norm() > chord.norm() ? d : chord;
  };
  Sector sector;
  sector.Face = patch.Face;
  sector.Patch = contact.Patch;
  sector.Pole = side;
  sector.Nearest = contact.Foot.Point;
  sector.Away = std::sqrt(contact.Foot.Squared);
  Vec3 last = direction(0);
  for (int k = 0; k < Samples; ++k)
  {
    const Vec3 next = direction((k + 1.0) / Samples);
    const Vec2 middle = place((k + 0.5) / Samples, 0), inner = place((k + 0.5) / Samples, 1e-6);
    if (loops.Empty() || loops.Inside(patch.U(inner.x(), inner.y()), patch.V(inner.x(), inner.y())))
    {
      sector.Weighted += std::atan2(last.cross(next).norm(), last.dot(next)) *
        UnitNormal(model, patch, middle.x(), middle.y());
    }
    last = next;
  }
  const Vec2 middle = place(0.5, 0);
  sector.Parameters = Vec2(patch.U(middle.x(), middle.y()), patch.V(middle.x(), middle.y()));
  this->AddRaysFromPole(patch, side, place, sector);
  this->Sectors.push_back(sector);
}

}

std::vector<Sector> FindSectors(const SurfaceModel& model, const Vec3& x, double gap)
{
  return SectorFinder(model, x, gap).Find();
}

const BorderRay* FindPartner(
  const std::vector<Sector>& sectors, const Sector& sector, const BorderRay& ray)
{
  for (const Sector& other : sectors)
  {
    for (int k = 0; k < other.RayCount && &other != &sector; ++k)
    {
      if (other.Rays[k].Direction.dot(ray.Direction) > 0.95)
      {
        return &other.Rays[k];
      }
    }
  }
  return nullptr;
}

}
