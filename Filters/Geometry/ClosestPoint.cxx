#include "ClosestPoint.h"

#include "BezierEvaluation.h"
#include "BezierRestriction.h"
#include "BoxHalving.h"
#include "PointInversion.h"
#include "SquaredDistanceForm.h"

#include <algorithm>
#include <cmath>

namespace nurbs
{

bool IsInsideTrim(const SurfaceModel& model, int index, double s, double t)
{
  const BezierPatch& patch = model.Patches[index];
  const TrimLoops& loops = model.Data[patch.Face].Loops;
  if (patch.Curve || loops.Empty())
  {
    return true;
  }
  const TrimState state = model.TrimStates[model.LeafAt(patch, s, t)];
  return state == TrimState::Inside ||
    (state == TrimState::Crossed && loops.Inside(patch.U(s, t), patch.V(s, t)));
}

namespace
{

/// The net of a part of a patch about a point, and the box along the axes that it lies in.
struct PartAbout
{
  PartAbout(const BezierPatch& patch, const Vec4* net, const PartDomain& box, const Vec3& p)
    : P(patch.DegreeU)
    , Q(patch.DegreeV)
  {
    RestrictNet(patch, net, box.S0, box.S1, box.T0, box.T1, this->Net);
    for (int k = 0; k < this->Size(); ++k)
    {
      this->Net[k].head<3>() -= this->Net[k].w() * p;
      const Vec3 point = this->Net[k].head<3>() / this->Net[k].w();
      this->Low = this->Low.cwiseMin(point);
      this->High = this->High.cwiseMax(point);
    }
  }

  int Size() const { return (this->P + 1) * (this->Q + 1); }
  double Extent() const { return (this->High - this->Low).norm(); }
  /// From the point to the box.
  double SquaredDistance() const
  {
    return this->Low.cwiseMax(-this->High).cwiseMax(0.0).squaredNorm();
  }

  int P, Q;
  Vec4 Net[(MaximumDegree + 1) * (MaximumDegree + 1)]; ///< homogeneous
  Vec3 Low = Vec3::Constant(HUGE_VAL), High = -Low;
};

/// Halves the box of a part across its longer side.
void HalveNearerFirst(const PartAbout& part, const PartDomain& box, PartDomain* halves)
{
  const int p = part.P, q = part.Q;
  Vec2 sides = MeasureSides(p, q, part.Net);
  // A side that is curved may be longer than from corner to corner.
  sides.x() += part.Extent() * (p > 1 ? 1e-3 : 0);
  sides.y() += part.Extent() * (q > 1 ? 1e-3 : 0);
  const auto squared = [&](int i, int j)
  { return CartesianPoint(part.Net[i + j * (p + 1)]).squaredNorm(); };
  const bool acrossS = q == 0 || sides.x() >= sides.y();
  const double nearHigh = acrossS
    ? std::min(squared(0, 0), squared(0, q)) - std::min(squared(p, 0), squared(p, q))
    : std::min(squared(0, 0), squared(p, 0)) - std::min(squared(0, q), squared(p, q));
  HalveBox(box, acrossS, nearHigh > 0, halves);
}

class ClosestPointSearch
{
public:
  ClosestPointSearch(const SurfaceModel& model, const Vec3& p, double maximumSquared)
    : Model(model)
    , P(p)
  {
    this->Best.Squared = maximumSquared;
    this->UpdateBound();
  }

  SurfacePoint Best;

  /// Takes a foot that was found otherwise, inside its patch.
  void Start(const SurfacePoint& foot)
  {
    this->Walked = true;
    if (foot.Squared < this->Best.Squared && IsInsideTrim(this->Model, foot.Patch, foot.S, foot.T))
    {
      this->Best = foot;
      this->BestDomain = { 0, 1, 0, 1 };
      this->UpdateBound();
    }
  }

  /// Newton from a point of the surface, on into the next patch where it leaves one.
  void Walk(int patch, double s, double t);

  void Run();

private:
  /// Distances within rounding of the best one are not worth looking for.
  void UpdateBound()
  {
    const double d = std::sqrt(this->Best.Squared);
    const double bound = d * (1 - 1e-12) - 4e-3 * this->Model.Resolution;
    this->Bound = bound > 0 ? bound * bound : 0;
  }

  /// @param domain where the foot is a local minimum
  void Consider(int patch, const LocalFoot& foot, const PartDomain& domain)
  {
    if (foot.Squared < this->Best.Squared && IsInsideTrim(this->Model, patch, foot.S, foot.T))
    {
      this->Best = { patch, foot.S, foot.T, foot.Point, foot.Squared };
      this->BestDomain = domain;
      this->UpdateBound();
    }
  }

  /// True if the best foot is a local minimum of the domain, as far as its own domain tells.
  bool BestIsMinimumOf(const PartDomain& domain) const
  {
    const double s = this->Best.S, t = this->Best.T;
    const bool holds = s >= domain.S0 && s <= domain.S1 && t >= domain.T0 && t <= domain.T1;
    const PartDomain& known = this->BestDomain;
    return holds && known.S0 <= domain.S0 && known.S1 >= domain.S1 && known.T0 <= domain.T0 &&
      known.T1 >= domain.T1;
  }

  void VisitLeaf(int boxIndex);
  void SearchLeaf(int index);
  bool SearchBox(const BezierPatch& patch, int index, const PartDomain& box, PartDomain* halves);
  bool IsCutAway(const BezierPatch& patch, const PartDomain& box) const;
  bool IsDecided(const BezierPatch& patch, int index, const PartDomain& box, const PartAbout& part);

  const SurfaceModel& Model;
  const Vec3 P;
  double Bound = 0;   ///< squared
  int Budget = 50000; ///< of boxes; beyond it the best found so far stands
  bool Walked = false;
  PartDomain BestDomain{ 0, 0, 0, 0 };
};

void ClosestPointSearch::Walk(int index, double s, double t)
{
  constexpr int MaximumPatches = 8;
  this->Walked = true;
  const PartDomain whole{ 0, 1, 0, 1 };
  for (int k = 0; k < MaximumPatches; ++k)
  {
    const BezierPatch& patch = this->Model.Patches[index];
    const LocalFoot foot = InvertPoint(patch, this->Model.Net(patch), this->P, s, t, whole);
    const bool nearer = foot.Squared < this->Best.Squared;
    this->Consider(index, foot, whole);
    if (patch.Curve || !nearer)
    {
      return;
    }
    const int stepU = foot.S == 0 ? -1 : (foot.S == 1 ? 1 : 0);
    const int stepV = foot.T == 0 ? -1 : (foot.T == 1 ? 1 : 0);
    const FaceData& data = this->Model.Data[patch.Face];
    const int countU = data.SpansU.Count(), countV = data.SpansV.Count();
    const int i = (index - data.FirstPatch) % countU + stepU;
    const int j = (index - data.FirstPatch) / countU + stepV;
    if ((stepU == 0 && stepV == 0) || i < 0 || i >= countU || j < 0 || j >= countV)
    {
      return;
    }
    index = data.PatchOf(i, j);
    s = stepU == 0 ? foot.S : 0.5 - 0.5 * stepU;
    t = stepV == 0 ? foot.T : 0.5 - 0.5 * stepV;
  }
}

void ClosestPointSearch::Run()
{
  struct Entry
  {
    int Child;
    float Squared;
  };
  const TreePoint point(this->P);
  Entry stack[TreeStackSize];
  int size = 0;
  stack[size++] = { 0, 0.0f };
  while (size > 0)
  {
    const Entry entry = stack[--size];
    // A distance of zero must be looked at unless the best is zero as well.
    if (entry.Squared > this->Bound ||
      (entry.Squared == this->Bound && this->Bound == 0 && this->Best.Patch >= 0 &&
        this->Best.Squared == 0))
    {
      continue;
    }
    if (entry.Child < 0)
    {
      this->VisitLeaf(~entry.Child);
      continue;
    }
    const TreeNode& node = this->Model.Nodes[entry.Child];
    const Eigen::Array4f distances = point.SquaredDistances(node);
    // Push the farthest first: insertion into the top of the stack, sorted.
    const int base = size;
    for (int c = 0; c < 4; ++c)
    {
      const float squared = distances[c];
      if (node.Child[c] == TreeNode::Empty || squared > this->Bound)
      {
        continue;
      }
      this->Model.Prefetch(node.Child[c]);
      int k = size++;
      while (k > base && stack[k - 1].Squared < squared)
      {
        stack[k] = stack[k - 1];
        --k;
      }
      stack[k] = { node.Child[c], squared };
    }
  }
}

void ClosestPointSearch::VisitLeaf(int boxIndex)
{
  const LeafBox& oriented = this->Model.BoxAt(boxIndex);
  __builtin_prefetch(&this->Model.Leaves[oriented.Leaf()].Patch);
  if (SquaredDistanceToLeaf(oriented, this->P) > this->Bound)
  {
    return;
  }
  const int index = oriented.Leaf();
  const Leaf& leaf = this->Model.Leaves[index];
  const BezierPatch& patch = this->Model.Patches[leaf.Patch];
  const Vec4* net = this->Model.Net(patch);
  const PartDomain domain = DomainOf(patch, index);
  const Vec3 d = this->P - leaf.Center;
  const double x = leaf.X.cast<double>().dot(d), y = leaf.Y.cast<double>().dot(d);
  const double z = leaf.Z.cast<double>().dot(d);
  const double squaredSide = x * x + (patch.Curve ? 0 : y * y);
  const double squaredHeight = z * z + (patch.Curve ? y * y : 0);
  const bool certain =
    leaf.SideCost * std::sqrt(squaredSide) + leaf.HeightCost * std::sqrt(squaredHeight) < 1;
  if (certain && this->Best.Patch == leaf.Patch && this->BestIsMinimumOf(domain))
  {
    return; // a local minimum here is the only one
  }
  const Vec2 start = leaf.ParametersAt(x, y, domain);
  const double s = start.x(), t = start.y();
  if (!this->Walked && !patch.Curve)
  {
    // The first leaf is mostly beside the right one: a walk gives a bound that excludes the rest.
    this->Walk(leaf.Patch, s, t);
    if (SquaredDistanceToLeaf(oriented, this->P) > this->Bound ||
      (certain && this->Best.Patch == leaf.Patch && this->BestIsMinimumOf(domain)))
    {
      return;
    }
  }
  this->Consider(leaf.Patch, InvertPoint(patch, net, this->P, s, t, domain), domain);
  if (!certain)
  {
    this->SearchLeaf(index);
  }
}

void ClosestPointSearch::SearchLeaf(int index)
{
  const int patchIndex = this->Model.Leaves[index].Patch;
  const BezierPatch& patch = this->Model.Patches[patchIndex];
  VisitHalves(DomainOf(patch, index), this->Budget,
    [&](const PartDomain& box, PartDomain* halves)
    { return this->SearchBox(patch, patchIndex, box, halves); });
}

/// False if nothing in the box is closer than the best; else its two halves, the nearer first.
bool ClosestPointSearch::SearchBox(
  const BezierPatch& patch, int index, const PartDomain& box, PartDomain* halves)
{
  const Vec4* net = this->Model.Net(patch);
  const PartAbout part(patch, net, box, this->P);
  if ((part.SquaredDistance() >= this->Bound && this->Bound > 0) || this->IsCutAway(patch, box))
  {
    return false;
  }
  const double s = 0.5 * (box.S0 + box.S1), t = 0.5 * (box.T0 + box.T1);
  if ((BezierPoint(patch, net, s, t) - this->P).squaredNorm() < this->Bound)
  {
    this->Consider(index, InvertPoint(patch, net, this->P, s, t, box), box);
  }
  if (part.Extent() < 1e-3 * this->Model.Resolution || this->IsDecided(patch, index, box, part))
  {
    return false;
  }
  HalveNearerFirst(part, box, halves);
  return true;
}

/// Whether the loops leave nothing of the box.
bool ClosestPointSearch::IsCutAway(const BezierPatch& patch, const PartDomain& box) const
{
  const TrimLoops& loops = this->Model.Data[patch.Face].Loops;
  if (patch.Curve || loops.Empty())
  {
    return false;
  }
  const Vec2 low(patch.U(box.S0, box.T0), patch.V(box.S0, box.T0));
  const Vec2 high(patch.U(box.S1, box.T1), patch.V(box.S1, box.T1));
  return loops.Classify(low, high) == TrimState::Outside;
}

/// True if the form of the distance proves that the box holds nothing closer than the best; where
/// it proves that there is one minimum, that one is considered first.
bool ClosestPointSearch::IsDecided(
  const BezierPatch& patch, int index, const PartDomain& box, const PartAbout& part)
{
  SquaredDistanceForm form;
  form.Set(part.P, part.Q, part.Net, this->Bound);
  if (form.Minimum() >= 0)
  {
    return true;
  }
  // Where the distance has a slope all over the box its minimum is elsewhere: in the next box,
  // or on a loop, whose curve is searched by itself; unless the patch ends on that side.
  int slopeS, slopeT;
  form.FindSlopes(part.Net, slopeS, slopeT);
  if ((slopeS > 0 && box.S0 > 0) || (slopeS < 0 && box.S1 < 1) || (slopeT > 0 && box.T0 > 0) ||
    (slopeT < 0 && box.T1 < 1))
  {
    return true;
  }
  if (!form.IsConvex())
  {
    return false;
  }
  const LocalFoot foot = InvertPoint(
    patch, this->Model.Net(patch), this->P, 0.5 * (box.S0 + box.S1), 0.5 * (box.T0 + box.T1), box);
  this->Consider(index, foot, box);
  if (!patch.Rational)
  {
    return true;
  }
  // With weights the certificate has to hold for the distance that was found.
  form.Set(part.P, part.Q, part.Net, foot.Squared);
  return form.IsConvex();
}

}

SurfacePoint FindClosestPoint(
  const SurfaceModel& model, const Vec3& p, double maximumSquared, const SurfacePoint& guess)
{
  SurfacePoint start = guess;
  start.Squared = HUGE_VAL;
  if (model.Blocks.FindFoot(model, p, start) && start.Squared < maximumSquared)
  {
    return start;
  }
  ClosestPointSearch search(model, p, maximumSquared);
  if (start.Squared < HUGE_VAL)
  {
    search.Start(start);
  }
  else if (guess.Patch >= 0)
  {
    search.Walk(guess.Patch, guess.S, guess.T);
  }
  search.Run();
  return search.Best;
}

}
