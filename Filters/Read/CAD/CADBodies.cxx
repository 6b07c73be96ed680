#include "CADBodies.h"

#include "CADFins.h"
#include "CADProgress.h"
#include "CADShells.h"
#include "CADSolids.h"
#include "CADUnion.h"

#include <BRepBndLib.hxx>
#include <Bnd_Box.hxx>
#include <Message_ProgressScope.hxx>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace nurbs
{
namespace
{
/// A body as it may be joined.
struct Candidate
{
  size_t Index; ///< in the model
  Bnd_Box Box;
  double Volume = 0.0;
};

using Group = std::vector<Candidate>;

std::vector<Candidate> FindBoxes(const CADModel& model)
{
  std::vector<Candidate> candidates;
  for (size_t i = 0; i < model.Bodies.size(); ++i)
  {
    CatchReason(
      [&]
      {
        Candidate candidate{ i, Bnd_Box() };
        BRepBndLib::Add(model.Bodies[i], candidate.Box, false);
        candidates.push_back(candidate);
        return std::string();
      });
  }
  return candidates;
}

/// Bodies that hang together by their boxes, two at least, in the order of the file.
std::vector<Group> GroupByBoxes(std::vector<Candidate> left)
{
  std::vector<Group> groups;
  while (!left.empty())
  {
    Group group{ left.back() };
    left.pop_back();
    for (size_t k = 0; k < group.size(); ++k)
    {
      const Bnd_Box box = group[k].Box;
      const auto apart = std::stable_partition(
        left.begin(), left.end(), [&box](const Candidate& other) { return box.IsOut(other.Box); });
      group.insert(group.end(), apart, left.end());
      left.erase(apart, left.end());
    }
    if (group.size() > 1)
    {
      std::sort(group.begin(), group.end(),
        [](const Candidate& one, const Candidate& other) { return one.Index < other.Index; });
      groups.push_back(group);
    }
  }
  return groups;
}

/// Measures those of a group and leaves out what cannot be joined: what is inside out, or cannot be
/// measured, and what has a face whose other part is taken, as its solid still has the wrong one.
/// @return how many of the latter there are.
size_t TakeOutUnfit(const CADModel& model, Group& group)
{
  const std::set<int> isWrong = BodiesOfOtherParts(model);
  Group fit;
  size_t wrong = 0;
  for (Candidate& body : group)
  {
    CatchReason(
      [&]
      {
        body.Volume = VolumeOf(model.Bodies[body.Index]);
        return std::string();
      });
    const bool isRight = isWrong.count(static_cast<int>(body.Index)) == 0;
    wrong += body.Volume > 0.0 && !isRight;
    if (body.Volume > 0.0 && isRight)
    {
      fit.push_back(body);
    }
  }
  group.swap(fit);
  return wrong;
}

std::vector<TopoDS_Shape> ShapesOf(const CADModel& model, const Group& group)
{
  std::vector<TopoDS_Shape> shapes;
  for (const Candidate& body : group)
  {
    shapes.push_back(model.Bodies[body.Index]);
  }
  return shapes;
}

/// Joins those of one group, if it can be done: the first of them is the union then.
UnionOutcome JoinGroup(CADModel& model, const Group& group, const Message_ProgressRange& progress)
{
  CADUnion joined(ShapesOf(model, group), progress);
  const UnionOutcome outcome = joined.Judge();
  if (outcome != UnionOutcome::Joined)
  {
    return outcome;
  }
  const std::vector<bool> isOfGroup = FacesOf(model,
    [&group](int body)
    {
      return std::any_of(group.begin(), group.end(),
        [body](const Candidate& member) { return static_cast<int>(member.Index) == body; });
    });
  const std::vector<CADFace> given = TakeMarked(model, isOfGroup);
  if (joined.SwallowsSewn(given))
  {
    return group.size() == 2 ? UnionOutcome::Apart : UnionOutcome::Failed;
  }
  std::vector<std::vector<CADFace>> taken = joined.TakeFaces(given);
  if (taken.empty())
  {
    return UnionOutcome::Failed;
  }
  ReplaceFaces(model, isOfGroup, std::move(taken),
    [&group](const CADFace&) { return static_cast<int>(group.front().Index); });
  model.Bodies[group.front().Index] = joined.Shape();
  return UnionOutcome::Joined;
}

/// What is thrown over one group is not to lose the rest.
UnionOutcome TryGroup(CADModel& model, const Group& group, const Message_ProgressRange& progress)
{
  UnionOutcome outcome = UnionOutcome::Failed;
  CatchReason(
    [&]
    {
      outcome = group.size() < 2 ? UnionOutcome::Apart : JoinGroup(model, group, progress);
      return std::string();
    });
  return outcome;
}

/// Those near a box are to be tried again: what has that box was apart from them before.
void ForgetApart(const Bnd_Box& box, const Group& left, std::map<size_t, UnionOutcome>& known)
{
  for (const Candidate& body : left)
  {
    const auto found = known.find(body.Index);
    if (found != known.end() && found->second == UnionOutcome::Apart && !box.IsOut(body.Box))
    {
      known.erase(found);
    }
  }
}

/**
 * Joins one body with all that it can be joined with, which are taken from `left`, one after the
 * other: what touches one of them is near it then.
 *
 * @param spoilers gets those that it cannot be joined with, and itself if there are no others.
 */
void Grow(CADModel& model, Candidate core, Group& left, std::set<size_t>& spoilers,
  Message_ProgressScope& scope)
{
  std::map<size_t, UnionOutcome> known;
  bool fails = false;
  bool grows = false;
  for (size_t i = 0; i < left.size() && scope.More();)
  {
    const Candidate body = left[i];
    if (core.Box.IsOut(body.Box) || known.count(body.Index) != 0)
    {
      ++i;
      continue;
    }
    const UnionOutcome outcome = TryGroup(model, { core, body }, scope.Next());
    known[body.Index] = outcome;
    if (outcome == UnionOutcome::Failed)
    {
      spoilers.insert(body.Index);
      fails = true;
    }
    if (outcome == UnionOutcome::Joined)
    {
      grows = true;
      core.Box.Add(body.Box);
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
      ForgetApart(body.Box, left, known);
      i = 0;
    }
  }
  if (fails && !grows)
  {
    spoilers.insert(core.Index);
  }
}

/// Joins those of a group one by one, the largest first; the number of those that cannot be.
size_t JoinOneByOne(CADModel& model, Group left, const Message_ProgressRange& progress)
{
  std::stable_sort(left.begin(), left.end(),
    [](const Candidate& one, const Candidate& other) { return one.Volume > other.Volume; });
  Message_ProgressScope scope(progress, "Joining one by one", static_cast<double>(left.size()));
  std::set<size_t> spoilers;
  while (left.size() > 1 && scope.More())
  {
    const Candidate core = left.front();
    left.erase(left.begin());
    Grow(model, core, left, spoilers, scope);
  }
  return spoilers.size();
}

/**
 * Joins those of a group that can be: all at once, which is fastest and mostly works, or one by
 * one, as often a single one spoils all, such as a letter on a chip that crosses itself.
 *
 * @return how many could not be joined.
 */
size_t JoinMost(CADModel& model, const Group& group, const Message_ProgressRange& progress)
{
  Message_ProgressScope scope(progress, "Joining a group", 2);
  if (TryGroup(model, group, scope.Next()) != UnionOutcome::Failed)
  {
    return 0;
  }
  return group.size() == 2 ? 2 : JoinOneByOne(model, group, scope.Next());
}
}

//------------------------------------------------------------------------------
bool JoinBodies(CADModel& model, const std::function<bool(double)>& progress)
{
  CatchReason(
    [&]
    {
      SewBodies(model);
      return std::string();
    });
  Handle(ProgressBridge) bridge = new ProgressBridge(progress, 0.0);
  Message_ProgressScope whole(bridge->Start(), "Bodies", 2);
  RemoveFins(model, whole.Next());
  std::vector<Group> groups = GroupByBoxes(FindBoxes(model));
  Message_ProgressScope scope(whole.Next(), "Joining bodies", static_cast<double>(groups.size()));
  for (size_t i = 0; i < groups.size() && scope.More(); ++i)
  {
    const size_t unfit = TakeOutUnfit(model, groups[i]);
    model.Unjoined += static_cast<int>(unfit + JoinMost(model, groups[i], scope.Next()));
  }
  return !bridge->Stopped;
}
}
