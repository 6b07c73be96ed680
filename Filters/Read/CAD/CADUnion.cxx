#include "CADUnion.h"

#include "CADSides.h"

#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopTools_ListOfShape.hxx>

#include <algorithm>
#include <map>

namespace nurbs
{
namespace
{
/// Of the volumes that OpenCASCADE integrates over curved faces.
constexpr double VolumeTolerance = 1e-3;

bool IsClosed(const TopoDS_Shape& shape)
{
  bool closed = true;
  for (TopExp_Explorer it(shape, TopAbs_SHELL); it.More(); it.Next())
  {
    closed = closed && BRep_Tool::IsClosed(it.Current());
  }
  return closed;
}
}

//------------------------------------------------------------------------------
double VolumeOf(const TopoDS_Shape& shape)
{
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties);
  return properties.Mass();
}

//------------------------------------------------------------------------------
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
  const bool sound = solids > 0 && IsClosed(result) && BRepCheck_Analyzer(result).IsValid() &&
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

//------------------------------------------------------------------------------
std::vector<std::vector<CADFace>> CADUnion::TakeFaces(const std::vector<CADFace>& faces)
{
  TopTools_DataMapOfShapeInteger origins;
  for (size_t i = 0; i < faces.size(); ++i)
  {
    const TopoDS_Shape& face = faces[i].InBody.IsNull() ? faces[i].Shape : faces[i].InBody;
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
    taken[i].back().InBody.Nullify();
  }
  return taken;
}
}
