#include "Returner.h"

#include "AddUnique.h"
#include "JointRelaxation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

namespace trim
{
namespace
{

/// Scaled Jacobians that elements have to keep when a node returns: first those that cost little.
constexpr std::array<double, 2> Limits{ 0.5, 0.0 };
/// Scaled Jacobian of a corner whose edges lie in one plane.
constexpr double Flat = 1e-6;
/// What relaxing nodes one by one leaves below this share of the limit, and this far below it, all
/// together find no room for: 3 of 5 000 did, and took two fifths of the time of all that tried.
constexpr double HopelessShare = 0.125;
constexpr double HopelessGap = 0.17;
/// Halvings of a node's way to the surface, and sweeps over all nodes: one makes room for the next.
/// What brings a node nearer by less than this share of its distance is no step.
constexpr int WayHalvings = 6;
constexpr int ApproachSweeps = 4;
constexpr double LeastStep = 0.02;

}

bool Returner::Run(const std::vector<int>& left)
{
  std::vector<int> rest = left;
  for (const double limit : Limits)
  {
    this->Limit = std::max(limit, this->Given.Least);
    while (this->Sweep(rest, &Returner::Return))
    {
    }
  }
  return rest.size() < left.size();
}

Returner::Outcome Returner::Foresee(int node, int most)
{
  const std::vector<int> at = this->ElementsAt({ node });
  const State before = this->StateOf(this->RoundLeft(node, at));
  const std::vector<Standard> standards =
    this->StandardsOf(this->ElementsAt(before.Nodes), this->Limit);
  const char boundary = this->OnCut[node];
  Outcome outcome;
  for (const Place& place : this->PlacesFor(node))
  {
    if (outcome.Moved || outcome.Relaxations == most)
    {
      break;
    }
    this->Put(node, place);
    if (std::none_of(at.begin(), at.end(), [&](int e) { return this->IsFlat(e); }))
    {
      ++outcome.Relaxations;
      if (this->MakesRoom(node, at, before, standards))
      {
        outcome.Moved = this->StateOf(before.Nodes);
      }
    }
    this->Restore(before);
    this->TheMoves.Left[node] = 1;
    this->Given.Fixed[node] = 1;
    this->SetOnCut(node, boundary);
  }
  return outcome;
}

void Returner::Take(const State& moved)
{
  const int node = moved.Nodes.back();
  this->Restore(moved);
  this->TellReturned(node);
}

bool Returner::Approach(const std::vector<int>& left)
{
  this->Limit = GoalMargin * this->Given.Least;
  bool any = false;
  bool changed = true;
  for (int sweep = 0; changed && sweep < ApproachSweeps; ++sweep)
  {
    changed = false;
    for (const int node : left)
    {
      changed |= !this->Given.ToRelax.Aborted() && this->ComeNearer(node, left);
    }
    any |= changed;
  }
  return any;
}

bool Returner::Sweep(std::vector<int>& nodes, bool (Returner::*attempt)(int))
{
  std::vector<int> rest;
  for (const int node : nodes)
  {
    if (this->Given.ToRelax.Aborted() || !(this->*attempt)(node))
    {
      rest.push_back(node);
    }
  }
  nodes.swap(rest);
  return nodes.size() < rest.size();
}

bool Returner::OthersStand(const std::vector<int>& nodes) const
{
  return !this->Given.OthersStand ||
    std::all_of(nodes.begin(), nodes.end(), this->Given.OthersStand);
}

std::vector<Returner::Place> Returner::PlacesFor(int node)
{
  std::vector<Place> places;
  const auto add = [&](const NodeMove& move)
  {
    if (move.Found)
    {
      places.push_back({ AsStored(this->TheBand, move.Target), move.By });
    }
  };
  add(this->Mover.Project(node));
  for (const int edge : this->Mover.SlidingEdges(node))
  {
    add(this->Mover.SlideAlong(node, edge));
  }
  if (places.empty() && !this->Mover.IsInSheet(node))
  {
    add(this->BetweenNeighbours(node));
  }
  return places;
}

NodeMove Returner::BetweenNeighbours(int node) const
{
  std::vector<int> beside;
  const auto offer = [&](int other)
  {
    if (this->OnCut[other] && !this->TheMoves.Left[other])
    {
      AddUnique(beside, other);
    }
  };
  bool onSkin = false;
  for (const int f : this->TheBand.FacesOfNode(node))
  {
    const BandFace& face = this->TheBand.Faces[f];
    if (face.Exterior)
    {
      onSkin = true;
      const auto ends = NeighboursOf(face, node);
      std::for_each(ends.begin(), ends.end(), offer);
    }
  }
  for (const int edge : onSkin ? Band::Range() : this->TheBand.EdgesOfNode(node))
  {
    offer(this->TheBand.OtherEnd(edge, node));
  }
  if (beside.size() < 2 || (onSkin && beside.size() > 2))
  {
    return {};
  }
  Vec3 middle = Vec3::Zero();
  for (const int other : beside)
  {
    middle += this->TheMoves.Position[other] / static_cast<double>(beside.size());
  }
  const Vec3 along =
    this->TheMoves.Position[beside.back()] - this->TheMoves.Position[beside.front()];
  return this->Mover.Between(node, middle, along.normalized());
}

bool Returner::Return(int node)
{
  const std::vector<int> elements = this->ElementsAt({ node });
  const std::vector<Standard> before = this->StandardsOf(elements, this->Limit);
  const Vec3 from = this->TheMoves.Position[node];
  double best = -1.0;
  Place found;
  for (const Place& place : this->PlacesFor(node))
  {
    this->TheMoves.Position[node] = place.At;
    const double lowest = this->LowestOf(elements, before);
    if (lowest > best && !this->IsCoincident(node) && this->OthersStand({ node }))
    {
      best = lowest;
      found = place;
    }
  }
  this->TheMoves.Position[node] = from;
  if (best < 0.0)
  {
    return false;
  }
  this->Put(node, found);
  return true;
}

bool Returner::ComeNearer(int node, const std::vector<int>& left)
{
  const Vec3 from = this->TheMoves.Position[node];
  std::vector<Place> places = this->PlacesFor(node);
  if (places.empty() && this->ComeToCorner(node, left))
  {
    return true;
  }
  Vec3 nearest;
  if (this->Mover.Constrained(node, this->FreedomOf(node), from, true, nearest))
  {
    places.push_back({ nearest, Correction::Relax });
  }
  double rest = std::numeric_limits<double>::infinity();
  for (const Place& place : places)
  {
    rest = std::min(rest, (1.0 - LeastStep) * (place.At - from).norm());
  }
  const std::vector<int> elements = this->ElementsAt({ node });
  const std::vector<Standard> before = this->StandardsOf(elements, this->Limit);
  Vec3 best = from;
  for (const Place& place : places)
  {
    const Vec3 reached = this->GoTowards(node, place.At, elements, before);
    const double distance = (place.At - reached).norm();
    if (distance < rest)
    {
      rest = distance;
      best = reached;
    }
  }
  this->TheMoves.Position[node] = best;
  this->TheMoves.Applied[node] = best != from ? Correction::Relax : this->TheMoves.Applied[node];
  this->TellPlaced({ node });
  return best != from;
}

bool Returner::ComeToCorner(int node, const std::vector<int>& left)
{
  std::vector<int> pillar;
  std::copy_if(left.begin(), left.end(), std::back_inserter(pillar),
    [&](int n) { return this->Mover.PillarOf(n) == this->Mover.PillarOf(node); });
  const State before = this->StateOf(pillar);
  const std::vector<int> elements = this->ElementsAt(pillar);
  const std::vector<Standard> standards = this->StandardsOf(elements, this->Limit);
  bool any = false;
  for (const int n : pillar)
  {
    const NodeMove corner = this->Mover.ComeToCorner(n, this->TheMoves.Position[n]);
    if (corner.Found)
    {
      any = true;
      this->TheMoves.Position[n] = AsStored(this->TheBand, corner.Target);
      this->TheMoves.Applied[n] = Correction::Relax;
    }
  }
  if (any && this->LowestOf(elements, standards) >= 0.0 && !this->HasCoincident(before) &&
    this->OthersStand(pillar))
  {
    return true;
  }
  this->Restore(before);
  return false;
}

Vec3 Returner::GoTowards(
  int node, const Vec3& goal, const std::vector<int>& elements, const std::vector<Standard>& before)
{
  const Vec3 from = this->TheMoves.Position[node];
  Vec3 reached = from;
  double gone = 0.0, step = 0.5;
  for (int halving = 0; halving < WayHalvings; ++halving, step *= 0.5)
  {
    Vec3 at;
    if (!this->Mover.Constrained(
          node, this->FreedomOf(node), from + (gone + step) * (goal - from), false, at))
    {
      continue;
    }
    this->TheMoves.Position[node] = AsStored(this->TheBand, at);
    if (this->LowestOf(elements, before) >= 0.0 && !this->IsCoincident(node) &&
      this->OthersStand({ node }))
    {
      gone += step;
      reached = this->TheMoves.Position[node];
    }
  }
  this->TheMoves.Position[node] = from;
  return reached;
}

void Returner::Put(int node, const Place& place)
{
  this->TheMoves.Position[node] = place.At;
  this->TellPlaced({ node });
  this->TheMoves.Applied[node] =
    place.At != this->TheBand.Point[node] ? place.By : Correction::None;
  this->TellReturned(node);
}

void Returner::TellReturned(int node)
{
  this->TheMoves.Failed[node] = 0;
  this->TheMoves.Left[node] = 0;
  this->Given.Fixed[node] = 0;
  this->SetOnCut(node, 1);
}

void Returner::SetOnCut(int node, char onCut)
{
  if (this->Given.OnCut[node] != onCut)
  {
    this->Given.OnCut[node] = onCut;
    this->ForgetFreedom(node);
  }
}

std::vector<int> Returner::RoundLeft(int node, const std::vector<int>& at) const
{
  std::vector<int> nodes = this->NodesRound(at, RelaxedRings);
  nodes.push_back(node);
  return nodes;
}

bool Returner::MakesRoom(
  int node, const std::vector<int>& at, const State& before, const std::vector<Standard>& standards)
{
  FailedReturns::Key key;
  if (this->Failures)
  {
    key = this->KeyOf(node, at, before);
    if (this->Failures->Contain(key))
    {
      return false;
    }
  }
  const RelaxationGoal goal{ this->Limit, this->Limit, Decisive };
  Relax(this->Given.ToRelax, at, goal, this->TheMoves);
  const double least = std::min(HopelessShare * this->Limit, this->Limit - HopelessGap);
  bool stood = std::all_of(at.begin(), at.end(), [&](int e) { return this->Quality(e) >= least; });
  if (stood)
  {
    RelaxJointly(this->Given.ToRelax, at, goal, this->TheMoves);
    stood = this->LowestOf(this->ElementsAt(before.Nodes), standards) >= 0.0;
  }
  if (!stood && this->Failures)
  {
    this->Failures->Add(key);
  }
  // Coincident nodes may be anywhere, so that this is no matter of the neighbours alone.
  return stood && !this->HasCoincident(before);
}

FailedReturns::Key Returner::KeyOf(int node, const std::vector<int>& at, const State& before) const
{
  FailedReturns::Key key = StateRound(*this, this->Given.Fixed, at, RelaxedRings);
  AppendBytes(node, key);
  AppendBytes(this->Limit, key);
  const Vec3& from = before.Position.back();
  for (int c = 0; c < 3; ++c)
  {
    AppendBytes(from[c], key);
  }
  return key;
}

bool Returner::IsFlat(int e) const
{
  if (std::abs(this->Quality(e)) > Flat)
  {
    return false;
  }
  const auto& element = this->Elements[e];
  const auto& topology = TopologyOf(element.Count);
  std::array<char, 8> open{};
  const auto isOn = [&](int n) { return this->OnCut[n] && !this->TheMoves.Left[n]; };
  for (int i = 0; i < topology.NumberOfEdges; ++i)
  {
    const auto& edge = topology.Edges[i];
    open[edge.First] |= !isOn(element.Node[edge.Second]);
    open[edge.Second] |= !isOn(element.Node[edge.First]);
  }
  for (int i = 0; i < element.Count; ++i)
  {
    if (!open[i] && isOn(element.Node[i]))
    {
      return true;
    }
  }
  return false;
}

}
