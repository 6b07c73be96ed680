#include "CADUnion.h"

#include "CADSides.h"
#include "CADSolids.h"

#include <TopTools_ListOfShape.hxx>

#include <algorithm>
#include <map>

namespace nurbs
{
CADUnion::CADUnion(const std::vector<TopoDS_Shape>& bodies, const Message_ProgressRange& progress)
  : Given(bodies)
{
  TopTools_ListOfShape first;
  TopTools_ListOfShape others;
  for (const TopoDS_Shape& body : bodies)
  {
    (first.IsEmpty() ? first : others).Append(body);
  }
  this->Fuse.SetArguments(first);
  this->Fuse.SetTools(others);
  this->Fuse.SetNonDestructive(true);
  this->Fuse.Build(progress);
}

//------------------------------------------------------------------------------
UnionOutcome CADUnion::Judge()
{
  // Warnings say little: most of them come with a sound result, and some faults without one.
  if (this->Fuse.HasErrors() || this->Fuse.Shape().IsNull())
  {
    return UnionOutcome::Failed;
  }
  const TopoDS_Shape& result = this->Fuse.Shape();
  const int solids = CountShapes(TopAbs_SOLID, result);
  if (solids >= static_cast<int>(this->Given.size()))
  {
    return UnionOutcome::Apart;
  }
  double largest = 0.0;
  double sum = 0.0;
  for (const TopoDS_Shape& body : this->Given)
  {
    const double volume = VolumeOf(body);
    largest = std::max(largest, volume);
    sum += volume;
  }
  const double volume = VolumeOf(result);
  const bool sound = solids > 0 && AreSoundSolids(result) &&
    volume >= largest * (1.0 - VolumeTolerance) && volume <= sum * (1.0 + VolumeTolerance) &&
    FillTheSame(this->Given, result);
  return sound ? UnionOutcome::Joined : UnionOutcome::Failed;
}

//------------------------------------------------------------------------------
bool CADUnion::SwallowsSewn(const std::vector<CADFace>& faces)
{
  std::map<int, bool> isGone;
  for (const CADFace& face : faces)
  {
    if (!face.InBody.IsNull())
    {
      const auto known = isGone.emplace(face.Body, true).first;
      known->second = known->second && this->Fuse.IsDeleted(face.InBody);
    }
  }
  return std::any_of(isGone.begin(), isGone.end(), [](const auto& body) { return body.second; });
}
}
