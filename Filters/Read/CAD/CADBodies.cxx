#include "CADBodies.h"

#include "CADProgress.h"
#include "CADSides.h"

#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBndLib.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <Message_ProgressScope.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopTools_ListOfShape.hxx>

#include <algorithm>
#include <iterator>

namespace nurbs
{
namespace
{
/// Of the volumes that OpenCASCADE integrates over curved faces.
constexpr double VolumeTolerance = 1e-3;

double VolumeOf(const TopoDS_Shape& shape)
{
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties);
  return properties.Mass();
}

/// A body as it may be joined.
struct Candidate
{
  size_t Index; ///< in the model
  double Volume;
  Bnd_Box Box;
  bool IsRight; ///< has the faces that it is to have
};

/// Those that are not inside out, and are measured without an exception.
std::vector<Candidate> FindCandidates(const CADModel& model)
{
  std::vector<bool> isRight(model.Bodies.size(), true);
  for (const CADFace& face : model.Faces)
  {
    if (face.Body >= 0 && face.IsOtherPart)
    {
      isRight[static_cast<size_t>(face.Body)] = false;
    }
  }
  std::vector<Candidate> candidates;
  for (size_t i = 0; i < model.Bodies.size(); ++i)
  {
    CatchReason(
      [&]
      {
        Candidate candidate{ i, VolumeOf(model.Bodies[i]), Bnd_Box(), isRight[i] };
        BRepBndLib::Add(model.Bodies[i], candidate.Box, false);
        if (candidate.Volume > 0.0)
        {
          candidates.push_back(candidate);
        }
        return std::string();
      });
  }
  return candidates;
}

using Group = std::vector<Candidate>;

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

bool IsClosed(const TopoDS_Shape& shape)
{
  bool closed = true;
  for (TopExp_Explorer it(shape, TopAbs_SHELL); it.More(); it.Next())
  {
    closed = closed && BRep_Tool::IsClosed(it.Current());
  }
  return closed;
}

enum class Outcome
{
  Joined,
  Apart, ///< nothing to join
  Failed ///< not soundly
};

/// Bodies and what became of them.
class Union
{
public:
  Union(const CADModel& model, const Group& group, const Message_ProgressRange& progress)
  {
    TopTools_ListOfShape first;
    TopTools_ListOfShape others;
    for (const Candidate& body : group)
    {
      (first.IsEmpty() ? first : others).Append(model.Bodies[body.Index]);
      this->Given.push_back(model.Bodies[body.Index]);
    }
    this->Fuse.SetArguments(first);
    this->Fuse.SetTools(others);
    this->Fuse.SetNonDestructive(true);
    this->Fuse.Build(progress);
  }

  /// Warnings say little: most of them come with a sound result, and some faults without one.
  Outcome Judge(const Group& group)
  {
    if (this->Fuse.HasErrors() || this->Fuse.Shape().IsNull())
    {
      return Outcome::Failed;
    }
    const TopoDS_Shape& result = this->Fuse.Shape();
    const int solids = CountShapes(TopAbs_SOLID, result);
    if (solids >= static_cast<int>(this->Given.size()))
    {
      return Outcome::Apart;
    }
    double largest = 0.0;
    double sum = 0.0;
    for (const Candidate& body : group)
    {
      largest = std::max(largest, body.Volume);
      sum += body.Volume;
    }
    const double volume = VolumeOf(result);
    const bool sound = solids > 0 && IsClosed(result) && BRepCheck_Analyzer(result).IsValid() &&
      volume >= largest * (1.0 - VolumeTolerance) && volume <= sum * (1.0 + VolumeTolerance) &&
      FillTheSame(this->Given, result);
    return sound ? Outcome::Joined : Outcome::Failed;
  }

  /// Of each face given the faces of the union that are it, or a part of it; none if a face of the
  /// union is of none.
  std::vector<std::vector<CADFace>> TakeFaces(const std::vector<CADFace>& faces)
  {
    TopTools_DataMapOfShapeInteger origins;
    for (size_t i = 0; i < faces.size(); ++i)
    {
      const TopoDS_Shape& face = faces[i].Shape;
      const TopTools_ListOfShape& parts = this->Fuse.Modified(face);
      // Bind leaves what is bound already.
      if (parts.IsEmpty() && !this->Fuse.IsDeleted(face))
      {
        origins.Bind(face, static_cast<int>(i));
      }
      for (const TopoDS_Shape& part : parts)
      {
        origins.Bind(part, static_cast<int>(i));
      }
    }
    std::vector<std::vector<CADFace>> taken(faces.size());
    for (TopExp_Explorer it(this->Fuse.Shape(), TopAbs_FACE); it.More(); it.Next())
    {
      const int* origin = origins.Seek(it.Current());
      if (!origin)
      {
        return {};
      }
      const size_t i = static_cast<size_t>(*origin);
      taken[i].push_back(faces[i]);
      taken[i].back().Shape = it.Current();
    }
    return taken;
  }

private:
  std::vector<TopoDS_Shape> Given;
  BRepAlgoAPI_Fuse Fuse;
};

/// Joins those of one group, if it can be done.
Outcome JoinGroup(CADModel& model, const Group& group, const Message_ProgressRange& progress)
{
  Union joined(model, group, progress);
  const Outcome outcome = joined.Judge(group);
  if (outcome != Outcome::Joined)
  {
    return outcome;
  }
  const auto isOfGroup = [&](const CADFace& face)
  {
    return std::any_of(group.begin(), group.end(),
      [&face](const Candidate& body) { return static_cast<int>(body.Index) == face.Body; });
  };
  std::vector<CADFace> given;
  std::copy_if(model.Faces.begin(), model.Faces.end(), std::back_inserter(given), isOfGroup);
  const std::vector<std::vector<CADFace>> taken = joined.TakeFaces(given);
  if (taken.empty())
  {
    return Outcome::Failed;
  }
  std::vector<CADFace> faces;
  size_t next = 0;
  for (const CADFace& face : model.Faces)
  {
    if (isOfGroup(face))
    {
      faces.insert(faces.end(), taken[next].begin(), taken[next].end());
      ++next;
    }
    else
    {
      faces.push_back(face);
    }
  }
  model.Faces.swap(faces);
  return Outcome::Joined;
}
}

//------------------------------------------------------------------------------
bool JoinBodies(CADModel& model, const std::function<bool(double)>& progress)
{
  std::vector<Group> groups = GroupByBoxes(FindCandidates(model));
  for (Group& group : groups)
  {
    const auto wrong = std::stable_partition(
      group.begin(), group.end(), [](const Candidate& body) { return body.IsRight; });
    model.Unjoined += static_cast<int>(group.end() - wrong);
    group.erase(wrong, group.end());
  }
  Handle(ProgressBridge) bridge = new ProgressBridge(progress, 0.0);
  Message_ProgressScope scope(
    bridge->Start(), "Joining bodies", static_cast<double>(groups.size()));
  for (size_t i = 0; i < groups.size() && scope.More(); ++i)
  {
    // What is thrown over one group is not to lose the rest.
    Outcome outcome = Outcome::Failed;
    CatchReason(
      [&]
      {
        const Message_ProgressRange share = scope.Next();
        outcome = groups[i].size() < 2 ? Outcome::Apart : JoinGroup(model, groups[i], share);
        return std::string();
      });
    model.Unjoined += outcome == Outcome::Failed ? static_cast<int>(groups[i].size()) : 0;
  }
  return !bridge->Stopped;
}
}
