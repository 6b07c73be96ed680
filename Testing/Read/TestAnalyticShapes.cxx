/**
 * Solids that OpenCASCADE makes and writes as STEP and IGES, read back: every face lies on the
 * solid, its normal points outwards, and the areas add up. The solid itself is the judge, by
 * OpenCASCADE's own distances and classification, which the reader does not use.
 */
#include "CADFaceConversion.h"
#include "CADModel.h"
#include "ReadTesting.h"
#include "SolidTesting.h"
#include "TrimmingSurface.h"

#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepClass3d_SolidClassifier.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Geom2d_BSplineCurve.hxx>
#include <Geom2d_Line.hxx>
#include <GeomAPI_PointsToBSpline.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_ConicalSurface.hxx>
#include <Geom_CylindricalSurface.hxx>
#include <Geom_Hyperbola.hxx>
#include <Geom_Line.hxx>
#include <Geom_OffsetSurface.hxx>
#include <Geom_Parabola.hxx>
#include <Geom_Plane.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_ConstructionError.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Shape.hxx>
#include <gp_Ax2.hxx>
#include <gp_Elips.hxx>

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <new>
#include <stdexcept>

using nurbs::NurbsSurface;
using nurbs::Vec3;

namespace
{
struct Case
{
  std::string Name;
  TopoDS_Shape Shape;
  /// Largest distance allowed between a point read from IGES and the shape, relative to its
  /// size. OpenCASCADE's writer approximates some curves, which is not the reader's fault.
  double IgesTolerance = 1e-9;
  /// OpenCASCADE 7.6 cannot read back every STEP file that it writes.
  bool Step = true;
};

gp_Ax2 Leaning(double x = 3, double y = -2, double z = 5)
{
  return gp_Ax2(gp_Pnt(x, y, z), gp_Dir(1, 2, 4), gp_Dir(2, -1, 0.3));
}

TopoDS_Shape RoundedBox()
{
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(Leaning(), 40, 30, 20).Shape();
  BRepFilletAPI_MakeFillet fillet(box);
  for (TopExp_Explorer it(box, TopAbs_EDGE); it.More(); it.Next())
  {
    fillet.Add(4.0, TopoDS::Edge(it.Current()));
  }
  return fillet.Shape();
}

Handle(Geom_BSplineCurve) Wave()
{
  TColgp_Array1OfPnt points(1, 6);
  for (int i = 1; i <= 6; ++i)
  {
    points(i) = gp_Pnt(20 + 4 * std::sin(1.3 * i), 0, 8.0 * i);
  }
  return GeomAPI_PointsToBSpline(points).Curve();
}

/// A face between a curve in the plane y = 0 and the z axis.
TopoDS_Face Profile(const TopoDS_Edge& curve, const gp_Pnt& first, const gp_Pnt& last)
{
  const gp_Pnt low(0, 0, first.Z());
  const gp_Pnt high(0, 0, last.Z());
  BRepBuilderAPI_MakeWire wire(curve);
  wire.Add(BRepBuilderAPI_MakeEdge(last, high));
  wire.Add(BRepBuilderAPI_MakeEdge(high, low));
  wire.Add(BRepBuilderAPI_MakeEdge(low, first));
  return BRepBuilderAPI_MakeFace(wire.Wire());
}

TopoDS_Face Profile(const Handle(Geom_Curve) & curve, double first, double last)
{
  return Profile(
    BRepBuilderAPI_MakeEdge(curve, first, last), curve->Value(first), curve->Value(last));
}

TopoDS_Shape Revolved(const TopoDS_Face& profile, double angle)
{
  return BRepPrimAPI_MakeRevol(profile, gp_Ax1(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), angle).Shape();
}

/// An ellipse swept round an axis: closed both ways, with seams, and no elementary surface.
TopoDS_Shape Ring()
{
  const gp_Elips ellipse(gp_Ax2(gp_Pnt(30, 0, 4), gp_Dir(0, 1, 0)), 12, 5);
  const TopoDS_Edge edge = BRepBuilderAPI_MakeEdge(ellipse);
  return Revolved(BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakeWire(edge).Wire()), 2 * M_PI);
}

/// A sphere with a hole that is away from its seam and its poles.
TopoDS_Shape Drilled(const gp_Ax2& axis, double radius)
{
  return BRepAlgoAPI_Cut(
    BRepPrimAPI_MakeSphere(15).Shape(), BRepPrimAPI_MakeCylinder(axis, radius, 30).Shape())
    .Shape();
}

TopoDS_Shape Moved(const TopoDS_Shape& shape)
{
  gp_Trsf turn, shift;
  turn.SetRotation(gp_Ax1(gp_Pnt(1, 2, 3), gp_Dir(1, 1, 1)), 0.7);
  shift.SetTranslation(gp_Vec(100, -50, 20));
  return shape.Moved(TopLoc_Location(shift * turn));
}

TopoDS_Shape Mirrored(const TopoDS_Shape& shape)
{
  gp_Trsf mirror;
  mirror.SetMirror(gp_Ax2(gp_Pnt(7, 0, 0), gp_Dir(1, 1, 0)));
  return BRepBuilderAPI_Transform(shape, mirror, true).Shape();
}

TopoDS_Shape Assembly(const TopoDS_Shape& part)
{
  TopoDS_Compound compound;
  BRep_Builder builder;
  builder.MakeCompound(compound);
  builder.Add(compound, part);
  builder.Add(compound, Moved(part));
  return compound;
}

std::vector<Case> Cases()
{
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(Leaning(), 40, 30, 20).Shape();
  const TopoDS_Shape upright = BRepPrimAPI_MakeBox(gp_Pnt(0, 0, 0), gp_Pnt(40, 30, 20)).Shape();
  const TopoDS_Shape cylinder = BRepPrimAPI_MakeCylinder(Leaning(), 10, 35).Shape();
  const TopoDS_Shape torus = BRepPrimAPI_MakeTorus(Leaning(), 30, 8).Shape();
  const TopoDS_Shape sphere = BRepPrimAPI_MakeSphere(Leaning(), 15).Shape();
  const gp_Ax2 inside(gp_Pnt(20, 15, -1), gp_Dir(0, 0, 1));
  const gp_Ax2 slanted(gp_Pnt(15, 15, -10), gp_Dir(0.3, 0.1, 1));
  const TopoDS_Edge ellipse =
    BRepBuilderAPI_MakeEdge(gp_Elips(gp_Ax2(gp_Pnt(5, 5, 5), gp_Dir(0, 1, 3)), 20, 9));
  const TopoDS_Face elliptic = BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakeWire(ellipse).Wire());
  const gp_Ax2 sideways(gp_Pnt(10, 0, 0), gp_Dir(0, 1, 0), gp_Dir(1, 0, 0));
  const TopoDS_Shape drilled =
    BRepAlgoAPI_Cut(upright, BRepPrimAPI_MakeCylinder(inside, 8, 30).Shape()).Shape();
  return { { "box", box }, { "cylinder", cylinder },
    { "frustum", BRepPrimAPI_MakeCone(Leaning(), 12, 5, 30).Shape() },
    { "cone", BRepPrimAPI_MakeCone(Leaning(), 12, 0, 30).Shape() }, { "sphere", sphere },
    { "torus", torus }, { "ring", Ring() },
    { "bowl", Drilled(gp_Ax2(gp_Pnt(-1, 0, 0), gp_Dir(-1, 0, 0)), 14) },
    { "drilled-sphere", Moved(Drilled(gp_Ax2(gp_Pnt(-1, 0, 0), gp_Dir(-3, 1, 1)), 4)) },
    { "rounded-box", RoundedBox() }, { "drilled", drilled },
    { "slanted-hole",
      BRepAlgoAPI_Cut(upright, BRepPrimAPI_MakeCylinder(slanted, 6, 60).Shape()).Shape() },
    { "part-of-cylinder", BRepPrimAPI_MakeCylinder(Leaning(), 10, 35, 4.0).Shape() },
    { "across-the-seam",
      BRepAlgoAPI_Common(BRepPrimAPI_MakeCylinder(gp_Ax2(), 20, 30).Shape(),
        BRepPrimAPI_MakeBox(gp_Pnt(5, -9, 3), gp_Pnt(30, 12, 25)).Shape())
        .Shape() },
    { "cut-sphere",
      BRepAlgoAPI_Cut(sphere, BRepPrimAPI_MakeBox(gp_Pnt(0, -30, -30), gp_Pnt(9, 30, 30)).Shape())
        .Shape() },
    { "torus-piece",
      BRepAlgoAPI_Common(
        torus, BRepPrimAPI_MakeBox(gp_Pnt(-10, -60, -60), gp_Pnt(70, 60, 60)).Shape())
        .Shape() },
    { "vase", Revolved(Profile(Wave(), 0, 1), 2 * M_PI) },
    { "part-of-vase", Revolved(Profile(Wave(), 0, 1), 4.5) },
    { "prism", BRepPrimAPI_MakePrism(Profile(Wave(), 0, 1), gp_Vec(2, 30, 5)).Shape() },
    { "elliptic-prism", BRepPrimAPI_MakePrism(elliptic, gp_Vec(3, 10, 20)).Shape(), 1e-7 },
    { "hyperbolic",
      Revolved(Profile(new Geom_Hyperbola(gp_Hypr(sideways, 7, 5)), -1.2, 1.4), 2 * M_PI), 1e-9,
      false },
    { "parabolic", Revolved(Profile(new Geom_Parabola(gp_Parab(sideways, 6)), -9, 13), 2 * M_PI) },
    { "mirrored", Mirrored(drilled) }, { "moved", Moved(RoundedBox()) },
    { "assembly", Assembly(drilled) } };
}

size_t CountFaces(const TopoDS_Shape& shape)
{
  size_t count = 0;
  for (TopExp_Explorer it(shape, TopAbs_FACE); it.More(); it.Next())
  {
    ++count;
  }
  return count;
}

/// The solid of a shape that is closest to a point.
TopoDS_Shape SolidAt(const TopoDS_Shape& shape, const gp_Pnt& point, double& distance)
{
  TopoDS_Shape closest;
  distance = 1e300;
  const TopoDS_Shape vertex = BRepBuilderAPI_MakeVertex(point).Vertex();
  for (TopExp_Explorer it(shape, TopAbs_SOLID); it.More(); it.Next())
  {
    // To the faces: within a solid the distance would be zero.
    for (TopExp_Explorer face(it.Current(), TopAbs_FACE); face.More(); face.Next())
    {
      const BRepExtrema_DistShapeShape extrema(vertex, face.Current());
      if (extrema.IsDone() && extrema.Value() < distance)
      {
        distance = extrema.Value();
        closest = it.Current();
      }
    }
  }
  return closest;
}

void CheckFace(const Case& one, const std::string& file, const NurbsSurface& surface, double scale,
  double tolerance)
{
  double largest = 0.0;
  int wrong = 0;
  int places = 0;
  for (double s : { 0.0317, 0.3171, 0.8713 })
  {
    for (double t : { 0.0231, 0.5519, 0.9637 })
    {
      const double u = surface.FirstU() + s * (surface.LastU() - surface.FirstU());
      const double v = surface.FirstV() + t * (surface.LastV() - surface.FirstV());
      if (!IsInside(surface, u, v))
      {
        continue;
      }
      ++places;
      const Vec3 p = scale * nurbs::Evaluate(surface, u, v);
      const Vec3 n = UnitNormal(surface, u, v);
      double distance = 0.0;
      const TopoDS_Shape solid = SolidAt(one.Shape, gp_Pnt(p.x(), p.y(), p.z()), distance);
      largest = std::max(largest, distance);
      for (double side : { -1e-4, 1e-4 })
      {
        const Vec3 beside = p + side * n;
        const BRepClass3d_SolidClassifier classifier(
          solid, gp_Pnt(beside.x(), beside.y(), beside.z()), 1e-7);
        wrong += classifier.State() != (side < 0 ? TopAbs_IN : TopAbs_OUT);
      }
    }
  }
  CHECK(largest <= tolerance * 50.0, file << ": a point is off by " << largest);
  CHECK(wrong == 0, file << ": " << wrong << " normals of " << places << " places are wrong");
}

/// That the faces have the area of the shape.
void CheckArea(
  const Case& one, const std::string& file, const std::vector<NurbsSurface>& faces, double scale)
{
  double area = 0.0;
  for (const NurbsSurface& surface : faces)
  {
    area += scale * scale * Area(surface, 200);
  }
  const double expected = AreaOf(one.Shape);
  CHECK(
    std::abs(area - expected) < 3e-3 * expected, file << ": area " << area << ", not " << expected);
}

void CheckFile(const Case& one, const std::string& file, int unit, double scale, double tolerance)
{
  const ReadResult result = ReadFaces(file, CountFaces(one.Shape), unit);
  for (const NurbsSurface& surface : result.Surfaces)
  {
    CheckFace(one, file, surface, scale, tolerance);
  }
  CheckArea(one, file, result.Surfaces, scale);
}

void WriteStep(const TopoDS_Shape& shape, const std::string& file, const char* unit)
{
  // The writer takes the unit when it is made.
  STEPControl_Controller::Init();
  Interface_Static::SetCVal("write.step.unit", unit);
  STEPControl_Writer writer;
  writer.Transfer(shape, STEPControl_AsIs);
  CHECK(writer.Write(file.c_str()) == IFSelect_RetDone, file);
}

void WriteIges(const TopoDS_Shape& shape, const std::string& file, const char* unit, int mode)
{
  IGESControl_Controller::Init();
  IGESControl_Writer writer(unit, mode);
  writer.AddShape(shape);
  CHECK(writer.Write(file.c_str()), file);
}
}

namespace
{
/// As trimmed surfaces (144) of IGES, their borders with curves in the parameters and without. Of a
/// whole sphere or torus OpenCASCADE may read a part of the seams only.
void CheckTrimmed(const Case& one)
{
  for (int curves : { 1, 0 })
  {
    if (curves == 0 && one.Name == "slanted-hole")
    {
      continue; // OpenCASCADE writes its ellipses turned about their centres
    }
    const std::string file = OutputPath(one.Name + "-trimmed.igs");
    Interface_Static::SetIVal("write.surfacecurve.mode", curves);
    WriteIges(one.Shape, file, "MM", 0);
    const ReadResult result = ReadFile(file);
    CHECK(result.Errors.empty() && result.Warnings.empty(), file << ": is not read whole");
    CheckArea(one, file, result.Surfaces, 1.0);
  }
  Interface_Static::SetIVal("write.surfacecurve.mode", 1);
}

/// Every pairing of the file's unit and the reader's: the box is as large as it was made.
void CheckUnits()
{
  const TopoDS_Shape box = BRepPrimAPI_MakeBox(gp_Pnt(1, 2, 3), gp_Pnt(41, 32, 23)).Shape();
  const double inMillimetres[] = { 1.0, 10.0, 1000.0, 25.4, 304.8, 1e-3 };
  for (const char* unit : { "MM", "INCH", "M", "FT", "CM" })
  {
    const std::string step = OutputPath(std::string("units-") + unit + ".stp");
    WriteStep(box, step, unit);
    const std::string iges = OutputPath(std::string("units-") + unit + ".igs");
    WriteIges(box, iges, unit, 1);
    for (int lengthUnit = 0; lengthUnit < 6; ++lengthUnit)
    {
      for (const std::string& file : { step, iges })
      {
        Eigen::AlignedBox3d bounds;
        for (const NurbsSurface& surface : ReadFaces(file, 6, lengthUnit).Surfaces)
        {
          for (const nurbs::Vec4& point : surface.ControlPoints)
          {
            bounds.extend(Vec3(point.head<3>() * inMillimetres[lengthUnit]));
          }
        }
        const double off =
          (bounds.min() - Vec3(1, 2, 3)).norm() + (bounds.max() - Vec3(41, 32, 23)).norm();
        // OpenCASCADE's IGES writer drops digits.
        CHECK(off < (file == step ? 1e-9 : 1e-8) * 50,
          file << " read in unit " << lengthUnit << " is off by " << off);
      }
    }
  }
}

/// Of a face with edges of another one: converted, a single surface.
/// @param take take(edge, face) tells which edges; it may give them other curves.
template <typename Take>
NurbsSurface ConvertRewired(
  const Handle(Geom_Surface) & surface, const TopoDS_Face& whole, const Take& take)
{
  const BRep_Builder builder;
  TopoDS_Face face;
  builder.MakeFace(face, surface, 1e-7);
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  for (TopExp_Explorer it(whole, TopAbs_EDGE); it.More(); it.Next())
  {
    const TopoDS_Edge edge = TopoDS::Edge(it.Current());
    if (take(edge, face))
    {
      builder.Add(wire, edge);
    }
  }
  builder.Add(face, wire);
  std::vector<NurbsSurface> surfaces;
  const std::string reason = nurbs::ConvertFace(face, {}, 1.0, surfaces);
  CHECK(reason.empty() && surfaces.size() == 1, reason);
  return surfaces.at(0);
}

/// Half a cone as OpenCASCADE makes it of some files of Creo: no edge runs along the apex.
void CheckOpenApex()
{
  const double angle = M_PI / 6;
  const Handle(Geom_ConicalSurface) cone =
    new Geom_ConicalSurface(gp_Ax3(Leaning()), angle, 12 - 20 * std::sin(angle));
  const double apex = 20 - 12 / std::sin(angle);
  const TopoDS_Face whole = BRepBuilderAPI_MakeFace(cone, 0.0, M_PI, apex, 20.0, 1e-7);
  const NurbsSurface surface = ConvertRewired(cone, whole,
    [](const TopoDS_Edge& edge, const TopoDS_Face&) { return !BRep_Tool::Degenerated(edge); });
  const double expected = 0.5 * M_PI * 12 * 12 / std::sin(angle);
  CHECK(std::abs(Area(surface) - expected) < 1e-3 * expected,
    "half a cone has area " << Area(surface) << ", not " << expected);
}

/// A curve in the parameters of a surface that begins elsewhere along the pole than the edge, of
/// constant first parameter, and swings there.
Handle(Geom2d_Curve) SwingingCurve(double u, double pole, double other, double first, double last)
{
  TColgp_Array1OfPnt2d poles(1, 4);
  TColStd_Array1OfReal knots(1, 4);
  TColStd_Array1OfInteger multiplicities(1, 4);
  const double shares[] = { 0.0, 0.02, 0.04, 1.0 }, beside[] = { 1.9, 0.5, 0.0, 0.0 };
  for (int i = 0; i < 4; ++i)
  {
    poles(i + 1) = gp_Pnt2d(u - beside[i], pole + shares[i] * (other - pole));
    knots(i + 1) = first + shares[i] * (last - first);
    multiplicities(i + 1) = i == 0 || i == 3 ? 2 : 1;
  }
  return new Geom2d_BSplineCurve(poles, knots, multiplicities, 1);
}

/// The same, with edges whose curves in the parameters stray from them at the apex, as
/// OpenCASCADE finds them for surfaces of revolution of some files.
void CheckStrayingCurves()
{
  const Handle(Geom_Line) line = new Geom_Line(gp_Pnt(0, 0, 0), gp_Dir(1, 0, 1));
  const Handle(Geom_Surface) cone = new Geom_SurfaceOfRevolution(line, gp_Ax1());
  const TopoDS_Face whole = BRepBuilderAPI_MakeFace(cone, 0.0, M_PI, 0.0, 10.0, 1e-7);
  const auto take = [&whole](const TopoDS_Edge& edge, const TopoDS_Face& face)
  {
    double first = 0.0, last = 0.0;
    const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(edge, whole, first, last);
    const gp_Pnt2d start = curve->Value(first), end = curve->Value(last);
    if (start.X() == M_PI && end.X() == M_PI)
    {
      BRep_Builder().UpdateEdge(edge, SwingingCurve(M_PI, 0.0, 10.0, first, last), face, 1e-7);
    }
    return start.Y() != 0.0 || end.Y() != 0.0; // else it is the apex
  };
  const NurbsSurface surface = ConvertRewired(cone, whole, take);
  const double expected = 0.5 * M_PI * 10 * 10 / std::sqrt(2);
  CHECK(std::abs(Area(surface) - expected) < 1e-4 * expected && surface.TrimLoops.empty(),
    "half a cone with a straying edge has area " << Area(surface) << ", not " << expected);
}

/// The tip of a cone that the digits of a file leave open by a ring is no border.
void CheckRoundedTip()
{
  constexpr double ring = 5e-6;
  const gp_Ax3 axes(Leaning());
  const Handle(Geom_Surface) cone = new Geom_ConicalSurface(axes, M_PI / 4, ring);
  const TopoDS_Face face = BRepBuilderAPI_MakeFace(cone, 0.0, 2 * M_PI, 0.0, 20.0, 1e-7);
  std::vector<NurbsSurface> surfaces;
  const std::string reason = nurbs::ConvertFace(face, {}, 1.0, surfaces);
  CHECK(reason.empty() && surfaces.size() == 1, "a cone: " << reason);
  const nurbs::TrimmingSurface trimming(surfaces, 1e-4);
  const gp_XYZ before = axes.Location().XYZ() - axes.Direction().XYZ();
  const nurbs::Foot foot = trimming.ClosestPoint(Vec3(before.X(), before.Y(), before.Z()));
  CHECK(std::abs(foot.Distance - 1.0) < 1e-5, "the tip is at " << foot.Distance);
  CHECK(foot.Kind == nurbs::FootKind::Interior, "the tip of a cone is a border");
}

/// Whatever is thrown over one face is the reason why that one is left out.
void CheckReasons()
{
  const auto reason = [](const auto& exception)
  { return nurbs::CatchReason([&]() -> std::string { throw exception; }); };
  CHECK(reason(std::length_error("a vector")) == "a vector", "length_error");
  CHECK(reason(std::bad_alloc()) == "it needs too much memory", "bad_alloc");
  CHECK(reason(Standard_ConstructionError("none")).find("none") != std::string::npos, "failure");
}

/// A hole that is a slit without width, run through twice, is none, and no reason to leave the face
/// out.
void CheckSlit()
{
  const Handle(Geom_Plane) plane = new Geom_Plane(gp_Ax3());
  const gp_Pnt a(2, 2, 0), b(7, 3, 0);
  const BRep_Builder builder;
  TopoDS_Wire wire;
  builder.MakeWire(wire);
  for (int turn = 0; turn < 2; ++turn)
  {
    builder.Add(wire, BRepBuilderAPI_MakeEdge(a, b).Edge());
    builder.Add(wire, BRepBuilderAPI_MakeEdge(b, a).Edge());
  }
  TopoDS_Face holed = BRepBuilderAPI_MakeFace(plane, 0.0, 10.0, 0.0, 10.0, 1e-7);
  builder.Add(holed, wire);
  std::vector<NurbsSurface> surfaces;
  const std::string reason = nurbs::ConvertFace(holed, {}, 1.0, surfaces);
  CHECK(reason.empty() && surfaces.size() == 1, "a slit: " << reason);
  CHECK(surfaces.size() != 1 || std::abs(Area(surfaces[0]) - 100.0) < 1e-9, "area with a slit");
}

/// A parallelogram in the parameters of a surface, from (first, 0) to (last, rise) and as wide in
/// v.
TopoDS_Face Band(
  const Handle(Geom_Surface) & surface, double first, double last, double rise, double width)
{
  const std::array<gp_Pnt2d, 4> corners = { gp_Pnt2d(first, 0), gp_Pnt2d(last, rise),
    gp_Pnt2d(last, rise + width), gp_Pnt2d(first, width) };
  BRepBuilderAPI_MakeWire wire;
  for (size_t i = 0; i < 4; ++i)
  {
    const gp_Pnt2d& a = corners[i];
    const gp_Pnt2d& b = corners[(i + 1) % 4];
    const Handle(Geom2d_Curve) line = new Geom2d_Line(a, gp_Dir2d(gp_Vec2d(a, b)));
    wire.Add(BRepBuilderAPI_MakeEdge(line, surface, 0.0, a.Distance(b)));
  }
  return BRepBuilderAPI_MakeFace(surface, wire);
}

/// A band that winds round a cylinder, as a thread does: one surface for each turn, without gaps.
void CheckWinding()
{
  constexpr double radius = 5.0, pitch = 2.0, width = 1.0, turns = 3.4, first = 0.7;
  const Handle(Geom_Surface) cylinder = new Geom_CylindricalSurface(gp_Ax3(Leaning()), radius);
  const double last = first + turns * 2.0 * M_PI, rise = turns * pitch;
  std::vector<NurbsSurface> surfaces;
  const std::string reason =
    nurbs::ConvertFace(Band(cylinder, first, last, rise, width), {}, 1.0, surfaces);
  CHECK(reason.empty() && surfaces.size() == 4, reason << surfaces.size() << " turns");
  double area = 0.0;
  for (const NurbsSurface& surface : surfaces)
  {
    area += Area(surface);
  }
  const double expected = turns * 2.0 * M_PI * radius * width;
  CHECK(std::abs(area - expected) < 5e-3 * expected, "area " << area << ", not " << expected);

  const nurbs::TrimmingSurface trimming(surfaces, 1e-6);
  double onBand = 0.0, between = 1.0;
  int onBorder = 0;
  for (int i = 1; i < 340; ++i)
  {
    const double share = i / 340.0;
    const auto footAt = [&](double height)
    {
      const gp_Pnt p = cylinder->Value(first + share * (last - first), share * rise + height);
      return trimming.ClosestPoint(Vec3(p.X(), p.Y(), p.Z()));
    };
    const nurbs::Foot foot = footAt(0.5 * width);
    onBand = std::max(onBand, foot.Distance);
    onBorder += foot.Kind != nurbs::FootKind::Interior;
    between = std::min(between, footAt(-0.5).Distance);
  }
  CHECK(onBand < 1e-9, "a place on the band is " << onBand << " from it");
  CHECK(between > 0.4, "a place between the turns is " << between << " from the band");
  CHECK(onBorder == 0, onBorder << " places of the band lie on a border");

  std::vector<NurbsSurface> none;
  const std::string refusal = nurbs::ConvertFace(Band(cylinder, 0, 1e6, 1, 1), {}, 1.0, none);
  CHECK(refusal.find("too many times") != std::string::npos && none.empty(),
    "150 000 turns: \"" << refusal << "\", " << none.size() << " surfaces");
}

/// The offset of a wavy bicubic surface with a net of 6 mm.
struct Offset
{
  int Spans, Multiplicity; ///< of inner knots
  double Place;            ///< the net begins there on all three axes
  bool Rough = false;      ///< bent with radii below the offset

  Handle(Geom_Surface) Surface() const
  {
    const int count = this->Count();
    TColgp_Array2OfPnt poles(1, count, 1, count);
    for (int i = 1; i <= count; ++i)
    {
      for (int j = 1; j <= count; ++j)
      {
        const double height =
          this->Rough ? 4.5 * ((i * 7 + j * 13) % 5) : 3 * std::sin(0.9 * i) * std::cos(0.7 * j);
        poles(i, j) = gp_Pnt(this->Place + 6 * i, this->Place + 6 * j, this->Place + height);
      }
    }
    TColStd_Array1OfReal knots(1, this->Spans + 1);
    TColStd_Array1OfInteger multiplicities(1, this->Spans + 1);
    for (int i = 1; i <= this->Spans + 1; ++i)
    {
      knots(i) = i;
      multiplicities(i) = i == 1 || i > this->Spans ? 4 : this->Multiplicity;
    }
    return new Geom_OffsetSurface(
      new Geom_BSplineSurface(poles, knots, knots, multiplicities, multiplicities, 3, 3),
      this->Rough ? 1.2 : 0.3);
  }
  int Count() const { return 4 + (this->Spans - 1) * this->Multiplicity; }
};

/// Offset surfaces have no NURBS form: they are as close as said whatever their number of spans,
/// their smoothness and their place.
void CheckOffsets()
{
  for (const Offset& one : { Offset{ 5, 1, 0 }, { 13, 1, 0 }, { 13, 1, 3000 }, { 30, 1, 1e6 },
         { 4, 2, 0 }, { 12, 2, 3000 }, { 21, 1, 0, true } })
  {
    const Handle(Geom_Surface) offset = one.Surface();
    const TopoDS_Face face = BRepBuilderAPI_MakeFace(offset, 1e-7);
    std::vector<NurbsSurface> surfaces;
    const std::string reason =
      nurbs::CatchReason([&] { return nurbs::ConvertFace(face, {}, 1.0, surfaces); });
    double error = surfaces.size() == 1 ? 0.0 : 1e300;
    for (int k = 0; k < 14400 && surfaces.size() == 1; ++k)
    {
      const double u = 1 + one.Spans * (k % 120 + 0.37) / 120;
      const double v = 1 + one.Spans * (k / 120 + 0.61) / 120;
      const gp_Pnt p = offset->Value(u, v);
      error =
        std::max(error, (nurbs::Evaluate(surfaces[0], u, v) - Vec3(p.X(), p.Y(), p.Z())).norm());
    }
    const double size = 8.5 * (one.Count() - 1);
    CHECK(error < 2e-7 * size,
      one.Spans << " spans, knots of multiplicity " << one.Multiplicity << ", at " << one.Place
                << ": off by " << error << " of " << size << " " << reason);
  }
}

/// Over the cusp of (t^2, t^3) the normal turns round, and the offset jumps.
void CheckTornOffset()
{
  const double x[] = { 1, -1.0 / 3, -1.0 / 3, 1 }, y[] = { -1, 1, -1, 1 };
  TColgp_Array2OfPnt poles(1, 4, 1, 2);
  for (int i = 0; i < 4; ++i)
  {
    poles(i + 1, 1) = gp_Pnt(x[i], y[i], 0);
    poles(i + 1, 2) = gp_Pnt(x[i], y[i], 2);
  }
  const Handle(Geom_Surface) offset = new Geom_OffsetSurface(new Geom_BezierSurface(poles), 0.2);
  std::vector<NurbsSurface> surfaces;
  const std::string reason = nurbs::CatchReason(
    [&] { return nurbs::ConvertFace(BRepBuilderAPI_MakeFace(offset, 1e-7), {}, 1.0, surfaces); });
  CHECK(surfaces.empty() && reason.find("cannot be approximated") != std::string::npos,
    "an offset with a jump: \"" << reason << "\", " << surfaces.size() << " surfaces");
}
}

int main(int argc, char* argv[])
{
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_PrinterOStream));
  const std::string only = argc > 1 ? argv[1] : "";
  if (only.empty())
  {
    CheckUnits();
    CheckOpenApex();
    CheckStrayingCurves();
    CheckRoundedTip();
    CheckReasons();
    CheckSlit();
    CheckWinding();
    CheckOffsets();
    CheckTornOffset();
  }
  for (const Case& one : Cases())
  {
    if (!only.empty() && one.Name != only)
    {
      continue;
    }
    if (one.Step)
    {
      const std::string step = OutputPath(one.Name + ".stp");
      WriteStep(one.Shape, step, "MM");
      CheckFile(one, step, 0, 1.0, 1e-9);
    }
    CheckTrimmed(one);
    // Solids (186) keep their orientation in IGES; trimmed surfaces (144) need not.
    const std::string iges = OutputPath(one.Name + ".igs");
    WriteIges(one.Shape, iges, "MM", 1);
    CheckFile(one, iges, 0, 1.0, one.IgesTolerance);
  }
  return Failures != 0;
}
