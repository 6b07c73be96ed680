#include "CADShells.h"

#include <BRepAdaptor_Curve.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepLib.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Geom_Surface.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Shell.hxx>
#include <TopoDS_Solid.hxx>
#include <gp_Pnt.hxx>

#include <algorithm>
#include <cmath>

namespace nurbs
{
namespace
{
/// How far edges that are one may lie apart, as a share of the size of all: as far as programs
/// round. Where they gape more, nothing is sewn.
constexpr double SewingShare = 1e-5;

/// Whether the file takes a part of the surface only, which OpenCASCADE does not.
bool IsRestricted(const CADFace& face)
{
  if (face.Range.empty())
  {
    return false;
  }
  double bounds[4];
  BRep_Tool::Surface(TopoDS::Face(face.Shape))->Bounds(bounds[0], bounds[1], bounds[2], bounds[3]);
  return !std::equal(face.Range.begin(), face.Range.end(), bounds);
}

std::vector<CADFace*> FindLoose(CADModel& model)
{
  std::vector<CADFace*> loose;
  for (CADFace& face : model.Faces)
  {
    if (face.Body < 0 && !IsRestricted(face))
    {
      loose.push_back(&face);
    }
  }
  return loose;
}

double SizeOf(const std::vector<CADFace*>& faces)
{
  Bnd_Box box;
  for (const CADFace* face : faces)
  {
    BRepBndLib::Add(face->Shape, box, false);
  }
  return box.IsVoid() ? 0.0 : std::sqrt(box.SquareExtent());
}

/// The edges of faces that no other face has, told by three places on them.
class OpenEdges
{
public:
  explicit OpenEdges(double tolerance)
    : Tolerance(tolerance)
  {
  }

  void Add(const TopoDS_Shape& face)
  {
    for (TopExp_Explorer it(face, TopAbs_EDGE); it.More(); it.Next())
    {
      const TopoDS_Edge edge = TopoDS::Edge(it.Current());
      if (!BRep_Tool::Degenerated(edge))
      {
        const BRepAdaptor_Curve curve(edge);
        const double first = curve.FirstParameter(), last = curve.LastParameter();
        this->Toggle({ curve.Value(first), curve.Value(0.5 * (first + last)), curve.Value(last) });
      }
    }
  }

  bool IsEmpty() const { return this->Edges.empty(); }

private:
  struct Places
  {
    gp_Pnt First, Middle, Last;
  };

  /// The middles by their parameters may differ a little where the ends do not.
  bool AreSame(const Places& one, const Places& other) const
  {
    constexpr double nearMiddle = 0.2;
    const auto near = [this](const gp_Pnt& from, const gp_Pnt& to)
    { return from.Distance(to) <= this->Tolerance; };
    return one.Middle.Distance(other.Middle) <=
      this->Tolerance + nearMiddle * one.Middle.Distance(one.First) &&
      ((near(one.First, other.First) && near(one.Last, other.Last)) ||
        (near(one.First, other.Last) && near(one.Last, other.First)));
  }

  void Toggle(const Places& edge)
  {
    const auto known = std::find_if(this->Edges.begin(), this->Edges.end(),
      [&](const Places& other) { return this->AreSame(edge, other); });
    if (known == this->Edges.end())
    {
      this->Edges.push_back(edge);
    }
    else
    {
      this->Edges.erase(known);
    }
  }

  double Tolerance;
  std::vector<Places> Edges;
};

/// Faces that close one after the other, and what is left. Those of a body follow each other in a
/// file, and sewn with those of others that share edges with them they would not close.
std::vector<std::vector<CADFace*>> SplitWhereClosed(
  const std::vector<CADFace*>& faces, double tolerance)
{
  std::vector<std::vector<CADFace*>> runs(1);
  OpenEdges open(tolerance);
  for (CADFace* face : faces)
  {
    if (!runs.back().empty() && open.IsEmpty())
    {
      runs.emplace_back();
    }
    runs.back().push_back(face);
    open.Add(face->Shape);
  }
  return runs;
}

/// A solid that is not inside out, bounded by a closed shell.
TopoDS_Solid MakeSolid(const TopoDS_Shape& shell)
{
  TopoDS_Solid solid = BRepBuilderAPI_MakeSolid(TopoDS::Shell(shell));
  BRepLib::OrientClosedSolid(solid);
  return solid;
}

/// A shell of one face, as of a sphere, which sewing leaves as it is.
TopoDS_Shell MakeShell(const TopoDS_Shape& face)
{
  const BRep_Builder builder;
  TopoDS_Shell shell;
  builder.MakeShell(shell);
  builder.Add(shell, face);
  shell.Closed(BRep_Tool::IsClosed(shell));
  return shell;
}

void SewRun(CADModel& model, const std::vector<CADFace*>& run, double tolerance)
{
  BRepBuilderAPI_Sewing sewing(tolerance);
  for (const CADFace* face : run)
  {
    sewing.Add(face->Shape);
  }
  sewing.Perform();
  TopoDS_Shape sewn = sewing.SewedShape();
  if (sewn.IsNull())
  {
    return;
  }
  sewn = sewn.ShapeType() == TopAbs_FACE ? MakeShell(sewn) : sewn;
  TopTools_DataMapOfShapeInteger bodyOf;
  for (TopExp_Explorer shell(sewn, TopAbs_SHELL); shell.More(); shell.Next())
  {
    if (BRep_Tool::IsClosed(shell.Current()))
    {
      const TopoDS_Solid solid = MakeSolid(shell.Current());
      for (TopExp_Explorer face(solid, TopAbs_FACE); face.More(); face.Next())
      {
        bodyOf.Bind(face.Current(), static_cast<int>(model.Bodies.size()));
      }
      model.Bodies.push_back(solid);
    }
  }
  for (CADFace* face : run)
  {
    const TopoDS_Shape inShell = sewing.ModifiedSubShape(face->Shape);
    if (const int* body = bodyOf.Seek(inShell))
    {
      face->Body = *body;
      face->InBody = inShell;
    }
  }
}
}

//------------------------------------------------------------------------------
void SewBodies(CADModel& model)
{
  const std::vector<CADFace*> loose = FindLoose(model);
  const double tolerance = SewingShare * SizeOf(loose);
  if (!(tolerance > 0.0))
  {
    return;
  }
  for (const std::vector<CADFace*>& run : SplitWhereClosed(loose, tolerance))
  {
    SewRun(model, run, tolerance);
  }
}
}
