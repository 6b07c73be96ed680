#include "CADFile.h"

#include "CADBodies.h"
#include "CADFaceConversion.h"
#include "CADModel.h"

#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>

#include <map>
#include <sstream>

namespace nurbs
{
namespace
{
/// Share of the progress after which bodies are joined.
constexpr double TransferShare = JoiningBegins;

/// A name for each face, made unique among the faces of one owner by a number.
std::vector<std::string> NameFaces(const std::vector<CADFace>& faces)
{
  std::map<std::string, int> owned;
  for (const CADFace& face : faces)
  {
    if (face.Name.empty())
    {
      ++owned[face.OwnerName];
    }
  }
  std::map<std::string, int> count;
  std::vector<std::string> names;
  for (size_t i = 0; i < faces.size(); ++i)
  {
    const CADFace& face = faces[i];
    std::ostringstream name;
    if (!face.Name.empty())
    {
      name << face.Name;
    }
    else if (face.OwnerName.empty())
    {
      name << "Face " << i + 1;
    }
    else
    {
      name << face.OwnerName;
      if (owned[face.OwnerName] > 1)
      {
        name << " face " << ++count[face.OwnerName];
      }
    }
    names.push_back(name.str());
  }
  return names;
}

/// What was left out, which is something.
std::string DescribeOmissions(
  size_t faces, const std::vector<std::string>& omissions, int untransferred)
{
  std::ostringstream text;
  if (untransferred > 0)
  {
    text << untransferred << " surface entities could not be understood and are left out";
  }
  if (!omissions.empty())
  {
    text << (untransferred > 0 ? "; " : "") << omissions.size() << " of " << faces
         << " faces are left out, first " << omissions[0];
  }
  text << (omissions.size() == faces
      ? "; nothing else is in it: export it again from the CAD program, as STEP if it is IGES"
      : "; repair them in the CAD program if they are needed");
  return text.str();
}

/// Why a file without surfaces has none, and what to do.
std::string DescribeLack(const CADModel& model)
{
  if (!model.References.empty())
  {
    return " holds no surface but the names of other files, first \"" + model.References[0] +
      "\"; open those, or export all parts into one file";
  }
  return model.Edges.empty()
    ? " holds no surface; export the trimming surfaces into it"
    : " holds curves but no surface; sweep the curves to surfaces in the CAD program, or use them "
      "with the trim line source";
}

bool ConvertFaces(const std::string& path, const CADModel& model, double scale,
  std::vector<NamedSurface>& surfaces, std::string& error, const ReadProgress& progress)
{
  const std::vector<std::string> names = NameFaces(model.Faces);
  std::vector<std::string> omissions;
  for (size_t i = 0; i < model.Faces.size(); ++i)
  {
    if (progress &&
      !progress(JoiningEnds +
        (1.0 - JoiningEnds) * static_cast<double>(i) / static_cast<double>(model.Faces.size())))
    {
      return false;
    }
    std::vector<NurbsSurface> turns;
    const std::string reason = CatchReason(
      [&]
      {
        const CADFace& face = model.Faces[i];
        return ConvertFace(TopoDS::Face(face.Shape), face.Range, scale, turns, face.IsOtherPart);
      });
    if (!reason.empty())
    {
      omissions.push_back("\"" + names[i] + "\" (" + reason + ")");
      continue;
    }
    for (NurbsSurface& surface : turns)
    {
      surfaces.push_back({ names[i], std::move(surface) });
    }
  }
  error.clear();
  if (!omissions.empty() || model.Untransferred > 0)
  {
    AddRemark(path, DescribeOmissions(model.Faces.size(), omissions, model.Untransferred), error);
  }
  if (model.Unjoined > 0)
  {
    AddRemark(path,
      std::to_string(model.Unjoined) +
        (model.Unjoined == 1 ? " body could not be joined with others near it"
                             : " bodies near each other could not be joined") +
        ": join those that touch in the CAD program",
      error);
  }
  return !surfaces.empty();
}
}

//------------------------------------------------------------------------------
bool ReadCADFile(const std::string& path, double unitInMillimetres, bool joinBodies,
  std::vector<NamedSurface>& surfaces, std::string& error, const ReadProgress& progress)
{
  const auto joinProgress = [&](double share)
  { return !progress || progress(JoiningBegins + (JoiningEnds - JoiningBegins) * share); };
  const auto take = [&](CADModel& model)
  {
    if (model.Faces.empty() && model.Untransferred == 0)
    {
      error = "CAD file \"" + path + "\"" + DescribeLack(model);
      return false;
    }
    if (joinBodies && (!joinProgress(0.0) || !JoinBodies(model, joinProgress)))
    {
      return false;
    }
    return ConvertFaces(path, model, 1.0 / unitInMillimetres, surfaces, error, progress);
  };
  return ReadItems(path, surfaces, error, progress, TransferShare, take);
}
}
