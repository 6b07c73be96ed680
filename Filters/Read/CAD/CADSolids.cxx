#include "CADSolids.h"

#include <BRepCheck_Analyzer.hxx>
#include <BRepGProp.hxx>
#include <BRepTools_History.hxx>
#include <BRep_Tool.hxx>
#include <GProp_GProps.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopTools_ListOfShape.hxx>

#include <utility>

namespace nurbs
{
double VolumeOf(const TopoDS_Shape& shape)
{
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties);
  return properties.Mass();
}

//------------------------------------------------------------------------------
bool AreSoundSolids(const TopoDS_Shape& shape)
{
  bool closed = true;
  for (TopExp_Explorer it(shape, TopAbs_SHELL); it.More(); it.Next())
  {
    closed = closed && BRep_Tool::IsClosed(it.Current());
  }
  return closed && BRepCheck_Analyzer(shape).IsValid();
}

//------------------------------------------------------------------------------
std::vector<std::vector<CADFace>> PartsOf(
  const std::vector<CADFace>& faces, BRepTools_History& history, const TopoDS_Shape& result)
{
  TopTools_DataMapOfShapeInteger origins;
  for (size_t i = 0; i < faces.size(); ++i)
  {
    const TopoDS_Shape& face = faces[i].InBody.IsNull() ? faces[i].Shape : faces[i].InBody;
    const TopTools_ListOfShape& parts = history.Modified(face);
    // Bind leaves what is bound already.
    if (parts.IsEmpty() && !history.IsRemoved(face))
    {
      origins.Bind(face, static_cast<int>(i));
    }
    for (const TopoDS_Shape& part : parts)
    {
      origins.Bind(part, static_cast<int>(i));
    }
  }
  std::vector<std::vector<CADFace>> parts(faces.size());
  for (TopExp_Explorer it(result, TopAbs_FACE); it.More(); it.Next())
  {
    const int* origin = origins.Seek(it.Current());
    if (!origin)
    {
      return {};
    }
    const size_t i = static_cast<size_t>(*origin);
    parts[i].push_back(faces[i]);
    parts[i].back().Shape = it.Current();
    parts[i].back().InBody.Nullify();
  }
  return parts;
}

//------------------------------------------------------------------------------
std::set<int> BodiesOfOtherParts(const CADModel& model)
{
  std::set<int> bodies;
  for (const CADFace& face : model.Faces)
  {
    if (face.IsOtherPart)
    {
      bodies.insert(face.Body);
    }
  }
  return bodies;
}

//------------------------------------------------------------------------------
std::vector<bool> FacesOf(const CADModel& model, const std::function<bool(int)>& isBody)
{
  std::vector<bool> isMarked;
  for (const CADFace& face : model.Faces)
  {
    isMarked.push_back(isBody(face.Body));
  }
  return isMarked;
}

//------------------------------------------------------------------------------
std::vector<CADFace> TakeMarked(const CADModel& model, const std::vector<bool>& isMarked)
{
  std::vector<CADFace> marked;
  for (size_t i = 0; i < model.Faces.size(); ++i)
  {
    if (isMarked[i])
    {
      marked.push_back(model.Faces[i]);
    }
  }
  return marked;
}

//------------------------------------------------------------------------------
void ReplaceFaces(CADModel& model, const std::vector<bool>& isMarked,
  std::vector<std::vector<CADFace>> parts, const std::function<int(const CADFace&)>& bodyOf)
{
  std::vector<CADFace> faces;
  size_t next = 0;
  for (size_t i = 0; i < model.Faces.size(); ++i)
  {
    if (!isMarked[i])
    {
      faces.push_back(model.Faces[i]);
      continue;
    }
    for (CADFace& part : parts[next])
    {
      part.Body = bodyOf(part);
      faces.push_back(std::move(part));
    }
    ++next;
  }
  model.Faces.swap(faces);
}
}
