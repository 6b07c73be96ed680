#include "CADCurveFile.h"

#include "CADCurveConversion.h"
#include "CADModel.h"

#include <BRep_Tool.hxx>
#include <Geom_Curve.hxx>
#include <Precision.hxx>
#include <TopExp.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Vertex.hxx>

#include <algorithm>
#include <sstream>

namespace nurbs
{
namespace
{
/// Share of the progress that reading and transferring take; the rest is conversion.
constexpr double TransferShare = 0.8;

double ToleranceOf(const TopoDS_Edge& edge)
{
  double tolerance = 0.0;
  for (const TopoDS_Vertex& vertex : { TopExp::FirstVertex(edge), TopExp::LastVertex(edge) })
  {
    tolerance = std::max(tolerance, vertex.IsNull() ? 0.0 : BRep_Tool::Tolerance(vertex));
  }
  return tolerance;
}

/// @return empty, or in a few words why the edge has no NURBS form.
std::string ConvertEdge(const TopoDS_Edge& edge, double scale, FileCurve& result)
{
  double first = 0.0;
  double last = 0.0;
  const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
  if (curve.IsNull())
  {
    return "it has no curve in space";
  }
  if (Precision::IsInfinite(first) || Precision::IsInfinite(last))
  {
    return "it is not bounded";
  }
  if (!(first < last))
  {
    return "it has no length";
  }
  result.Curve = ConvertCurve(curve, first, last);
  for (Vec4& point : result.Curve.Points)
  {
    point.head<3>() *= scale;
  }
  result.Tolerance = scale * ToleranceOf(edge);
  return FindDefect(Extrude(result.Curve, Vec3::UnitZ(), 0.0, 1.0).Surface);
}

/// What was left out, as one line; empty: nothing.
std::string DescribeOmissions(
  const std::string& path, const CADModel& model, const std::vector<std::string>& omissions)
{
  if (model.UntransferredCurves == 0 && omissions.empty())
  {
    return {};
  }
  std::ostringstream text;
  text << "CAD file \"" << path << "\": ";
  if (model.UntransferredCurves > 0)
  {
    text << model.UntransferredCurves << " curve entities could not be understood";
  }
  if (!omissions.empty())
  {
    text << (model.UntransferredCurves > 0 ? ", " : "") << omissions.size() << " of "
         << model.Edges.size() << " curves are not usable (first: " << omissions[0] << ")";
  }
  text << " and are left out; repair them in the CAD program if they are needed";
  return text.str();
}

bool ConvertEdges(const std::string& path, const CADModel& model, double scale,
  std::vector<FileCurve>& curves, std::string& error, const ReadProgress& progress)
{
  std::vector<std::string> omissions;
  for (size_t i = 0; i < model.Edges.size(); ++i)
  {
    const double share = static_cast<double>(i) / static_cast<double>(model.Edges.size());
    if (progress && !progress(TransferShare + (1.0 - TransferShare) * share))
    {
      return false;
    }
    FileCurve curve;
    curve.Name = model.Edges[i].Name;
    const std::string reason =
      CatchReason([&] { return ConvertEdge(TopoDS::Edge(model.Edges[i].Shape), scale, curve); });
    if (reason.empty())
    {
      curves.push_back(std::move(curve));
    }
    else
    {
      omissions.push_back(reason);
    }
  }
  error = DescribeOmissions(path, model, omissions);
  return !curves.empty();
}
}

//------------------------------------------------------------------------------
bool ReadCADCurves(const std::string& path, double unitInMillimetres,
  std::vector<FileCurve>& curves, std::string& error, const ReadProgress& progress)
{
  const auto take = [&](const CADModel& model)
  {
    if (model.Edges.empty() && model.UntransferredCurves == 0)
    {
      error = "CAD file \"" + path + "\" holds no curve" +
        (model.Faces.empty() ? "; export the trim lines into it as curves"
                             : ", only surfaces; open it with File > Open and trim with those");
      return false;
    }
    return ConvertEdges(path, model, 1.0 / unitInMillimetres, curves, error, progress);
  };
  return ReadItems(path, curves, error, progress, TransferShare, take);
}
}
