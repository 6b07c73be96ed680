#include "CADSides.h"

#include <BOPTools_AlgoTools3D.hxx>
#include <BRepBndLib.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <IntTools_Context.hxx>
#include <Poly_Triangulation.hxx>
#include <TopExp_Explorer.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>
#include <gp_Dir.hxx>
#include <gp_Pnt.hxx>
#include <gp_Pnt2d.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace nurbs
{
namespace
{
/// How far beside a face a place is, as a share of the face's size.
constexpr double FaceStep = 1e-2;
/// And at least so much of the size of all, as cracks between bodies may be closed.
constexpr double LeastStep = 4e-4;
/// Of triangles from the faces, as a share of the size of all, and in radians: less than the steps.
constexpr double Deflection = 1e-4;
constexpr double Angle = 0.25;
/// A winding number so far from a whole one says nothing: the place is on a face.
constexpr double Doubt = 0.2;
/// Faces that are looked at.
constexpr size_t MostFaces = 300;

double SizeOf(const TopoDS_Shape& shape)
{
  Bnd_Box box;
  BRepBndLib::Add(shape, box, false);
  return box.IsVoid() ? 0.0 : std::sqrt(box.SquareExtent());
}

/// The boundary of solids as triangles.
class Triangles
{
public:
  Triangles(const TopoDS_Shape& shape, double deflection)
  {
    BRepBndLib::Add(shape, this->Box, false);
    BRepMesh_IncrementalMesh(shape, deflection, false, Angle);
    for (TopExp_Explorer it(shape, TopAbs_FACE); it.More(); it.Next())
    {
      this->Append(TopoDS::Face(it.Current()));
    }
  }

  /// How often the boundary goes round a place: 1 in the solids, 0 outside. The angles that
  /// triangles take up as seen from it, by Van Oosterom and Strackee (1983).
  double WindingNumber(const gp_XYZ& place) const
  {
    if (this->Box.IsOut(gp_Pnt(place)))
    {
      return 0.0;
    }
    double angle = 0.0;
    for (const std::array<gp_XYZ, 3>& corners : this->Corners)
    {
      const gp_XYZ a = corners[0] - place, b = corners[1] - place, c = corners[2] - place;
      const double la = a.Modulus(), lb = b.Modulus(), lc = c.Modulus();
      angle += 2.0 *
        std::atan2(
          a.Dot(b.Crossed(c)), la * lb * lc + a.Dot(b) * lc + b.Dot(c) * la + c.Dot(a) * lb);
    }
    return angle / (4.0 * M_PI);
  }

private:
  void Append(const TopoDS_Face& face)
  {
    TopLoc_Location location;
    const Handle(Poly_Triangulation) mesh = BRep_Tool::Triangulation(face, location);
    for (int i = 1; !mesh.IsNull() && i <= mesh->NbTriangles(); ++i)
    {
      std::array<int, 3> nodes;
      mesh->Triangle(i).Get(nodes[0], nodes[1], nodes[2]);
      if (face.Orientation() == TopAbs_REVERSED)
      {
        std::swap(nodes[1], nodes[2]);
      }
      std::array<gp_XYZ, 3> corners;
      for (size_t k = 0; k < 3; ++k)
      {
        corners[k] = mesh->Node(nodes[k]).Transformed(location.Transformation()).XYZ();
      }
      this->Corners.push_back(corners);
    }
  }

  Bnd_Box Box;
  std::vector<std::array<gp_XYZ, 3>> Corners;
};

/// A place on either side of the middle of a face; none if the middle cannot be found.
std::vector<gp_XYZ> PlacesBeside(
  const TopoDS_Face& face, double leastStep, const Handle(IntTools_Context) & context)
{
  gp_Pnt middle;
  gp_Pnt2d parameters;
  gp_Dir normal;
  if (BOPTools_AlgoTools3D::PointInFace(face, middle, parameters, context) != 0 ||
    !BOPTools_AlgoTools3D::GetNormalToSurface(
      BRep_Tool::Surface(face), parameters.X(), parameters.Y(), normal))
  {
    return {};
  }
  const gp_XYZ step = std::max(leastStep, FaceStep * SizeOf(face)) * normal.XYZ();
  return { middle.XYZ() + step, middle.XYZ() - step };
}

/// Whether a winding number is of a place inside; false with `certain` unset if it says nothing.
bool IsInside(double winding, bool& certain)
{
  certain = certain && std::abs(winding - std::round(winding)) < Doubt;
  return winding > 0.5;
}
}

//------------------------------------------------------------------------------
bool FillTheSame(const std::vector<TopoDS_Shape>& bodies, const TopoDS_Shape& shape)
{
  const double size = SizeOf(shape);
  const Triangles whole(shape, Deflection * size);
  std::vector<Triangles> parts;
  std::vector<TopoDS_Face> faces;
  for (const TopoDS_Shape& body : bodies)
  {
    parts.emplace_back(body, Deflection * size);
    for (TopExp_Explorer it(body, TopAbs_FACE); it.More(); it.Next())
    {
      faces.push_back(TopoDS::Face(it.Current()));
    }
  }
  const Handle(IntTools_Context) context = new IntTools_Context;
  const size_t stride = 1 + faces.size() / MostFaces;
  for (size_t i = 0; i < faces.size(); i += stride)
  {
    for (const gp_XYZ& place : PlacesBeside(faces[i], LeastStep * size, context))
    {
      bool certain = true;
      bool before = false;
      for (const Triangles& part : parts)
      {
        before = IsInside(part.WindingNumber(place), certain) || before;
      }
      const bool after = IsInside(whole.WindingNumber(place), certain);
      if (certain && before != after)
      {
        return false;
      }
    }
  }
  return true;
}
}
