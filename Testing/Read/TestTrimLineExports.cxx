/**
 * vtkTrimLineSource reads one and the same contour from all the files in which CAD programs write
 * it: edges, wires and composite curves, in IGES and STEP, in millimetres, inches and metres,
 * moved.
 */
#include "LineTesting.h"
#include "ReadTesting.h"
#include "vtkTrimLineSource.h"

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRep_Builder.hxx>
#include <GeomAPI_ProjectPointOnCurve.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BezierCurve.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <Interface_Static.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TopLoc_Location.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Ax1.hxx>
#include <gp_Ax2.hxx>
#include <gp_Circ.hxx>
#include <gp_Elips.hxx>
#include <gp_Trsf.hxx>

#include <algorithm>
#include <cmath>
#include <sstream>

using nurbs::NurbsSurface;
using nurbs::Vec3;

namespace
{
const double Pi = std::acos(-1.0);

/// The contour, all in the plane z = 2, millimetres: two straight sides y = -5 and y = 5 over
/// 0 <= x <= 10, a half circle beyond, and half an ellipse of semiaxes 3 and 5 before.
double Contour(const Vec3& p)
{
  const double y = std::abs(p.y()) / 5.0;
  const double across = p.x() > 10.0 ? std::hypot((p.x() - 10.0) / 5.0, y)
    : p.x() < 0.0                    ? std::hypot(p.x() / 3.0, y)
                                     : y;
  return std::max(std::abs(across - 1.0), std::abs(p.z() - 2.0));
}

const double ContourArea = 100.0 + 12.5 * Pi + 7.5 * Pi;

double Area(const NurbsSurface& surface)
{
  const std::vector<Vec3> places = Places(surface, 20000);
  double area = 0.0;
  for (size_t i = 1; i < places.size(); ++i)
  {
    area += 0.5 * (places[i - 1].x() * places[i].y() - places[i].x() * places[i - 1].y());
  }
  return std::abs(area);
}

/// The file holds the contour and nothing else, as exactly as its digits tell.
void CheckContour(
  const std::string& path, const gp_Trsf& moved = gp_Trsf(), double tolerance = 1e-12)
{
  const LineResult result = ReadGood(path, 1);
  if (result.Surfaces.size() != 1)
  {
    return;
  }
  const gp_Trsf back = moved.Inverted();
  const double residual = LargestResidual(result.Surfaces[0],
    [&back](const Vec3& p)
    {
      const gp_Pnt q = gp_Pnt(p.x(), p.y(), p.z()).Transformed(back);
      return Contour(Vec3(q.X(), q.Y(), q.Z()));
    });
  CHECK(residual < tolerance, path << ": off by " << residual);
  if (moved.Form() == gp_Identity)
  {
    const double area = Area(result.Surfaces[0]);
    CHECK(std::abs(area - ContourArea) < 1e-4, path << ": area " << area);
  }
}

/// The upper side as a rational spline of degree 3 whose parameter does not run evenly.
TopoDS_Edge SplineSide()
{
  TColgp_Array1OfPnt poles(1, 5);
  TColStd_Array1OfReal weights(1, 5);
  const double x[] = { 10.0, 8.5, 6.0, 1.0, 0.0 };
  for (int i = 1; i <= 5; ++i)
  {
    poles(i) = gp_Pnt(x[i - 1], 5, 2);
    weights(i) = 1.0 + 0.25 * i;
  }
  TColStd_Array1OfReal knots(1, 3);
  TColStd_Array1OfInteger multiplicities(1, 3);
  knots(1) = 0.0;
  knots(2) = 0.3;
  knots(3) = 1.0;
  multiplicities(1) = multiplicities(3) = 4;
  multiplicities(2) = 1;
  return BRepBuilderAPI_MakeEdge(new Geom_BSplineCurve(poles, weights, knots, multiplicities, 3));
}

std::vector<TopoDS_Edge> ContourEdges()
{
  const gp_Dir up(0, 0, 1);
  const gp_Circ circle(gp_Ax2(gp_Pnt(10, 0, 2), up), 5.0);
  const gp_Elips ellipse(gp_Ax2(gp_Pnt(0, 0, 2), up, gp_Dir(0, 1, 0)), 5.0, 3.0);
  return { BRepBuilderAPI_MakeEdge(gp_Pnt(0, -5, 2), gp_Pnt(10, -5, 2)),
    BRepBuilderAPI_MakeEdge(circle, -0.5 * Pi, 0.5 * Pi), SplineSide(),
    BRepBuilderAPI_MakeEdge(ellipse, 0.0, Pi) };
}

TopoDS_Shape ContourWire()
{
  BRepBuilderAPI_MakeWire wire;
  for (const TopoDS_Edge& edge : ContourEdges())
  {
    wire.Add(edge);
  }
  return wire.Wire();
}

/// The edges by themselves, in no order, one of them reversed.
TopoDS_Shape ContourCompound()
{
  const std::vector<TopoDS_Edge> edges = ContourEdges();
  TopoDS_Compound compound;
  BRep_Builder builder;
  builder.MakeCompound(compound);
  for (const int i : { 2, 0, 3, 1 })
  {
    builder.Add(compound, i == 3 ? edges[i].Reversed() : TopoDS_Shape(edges[i]));
  }
  return compound;
}

void CheckWritten(const TopoDS_Shape& shape, const std::string& name, const gp_Trsf& moved)
{
  for (const char* unit : { "MM", "INCH", "M" })
  {
    for (const auto mode : { STEPControl_AsIs, STEPControl_GeometricCurveSet })
    {
      Interface_Static::SetCVal("write.step.unit", unit);
      STEPControl_Writer writer;
      const std::string path =
        OutputPath(name + "-" + unit + "-" + std::to_string(static_cast<int>(mode)) + ".step");
      CHECK(writer.Transfer(shape, mode) == IFSelect_RetDone &&
          writer.Write(path.c_str()) == IFSelect_RetDone,
        path << ": not written");
      CheckContour(path, moved, 1e-10);
    }
  }
  for (const char* unit : { "MM", "IN", "M" })
  {
    for (const int breps : { 0, 1 })
    {
      IGESControl_Writer writer(unit, breps);
      const std::string path = OutputPath(name + "-" + unit + "-" + std::to_string(breps) + ".igs");
      CHECK(writer.AddShape(shape) && writer.Write(path.c_str()), path << ": not written");
      // OpenCASCADE writes ten digits.
      CheckContour(path, moved, 1e-7);
    }
  }
}

void TestWriters()
{
  gp_Trsf turn, move;
  turn.SetRotation(gp_Ax1(gp_Pnt(1, 2, 3), gp_Dir(0, 0, 1)), 0.7);
  move.SetTranslation(gp_Vec(100, -200, 5));
  const gp_Trsf moved = move * turn;
  CheckWritten(ContourWire(), "wire", gp_Trsf());
  CheckWritten(ContourCompound(), "edges", gp_Trsf());
  CheckWritten(ContourWire().Moved(TopLoc_Location(moved)), "moved", moved);
}

/// A STEP file with these curves; the plane's and the pieces' entities come from the caller.
std::string StepText(const std::string& unit, const std::string& entities, const std::string& items,
  const std::string& kind)
{
  std::ostringstream text;
  text << "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\n"
          "FILE_NAME('lines','2024-01-01T00:00:00',(''),(''),'','','');\n"
          "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));\nENDSEC;\nDATA;\n"
          "#1=APPLICATION_CONTEXT('automotive design');\n"
          "#2=PRODUCT_CONTEXT('',#1,'mechanical');\n#3=PRODUCT('lines','lines','',(#2));\n"
          "#4=PRODUCT_DEFINITION_FORMATION('','',#3);\n"
          "#5=PRODUCT_DEFINITION_CONTEXT('part definition',#1,'design');\n"
          "#6=PRODUCT_DEFINITION('design','',#4,#5);\n#7=PRODUCT_DEFINITION_SHAPE('','',#6);\n"
          "#8=SHAPE_DEFINITION_REPRESENTATION(#7,#9);\n"
       << "#9=" << kind << "_SHAPE_REPRESENTATION('',(" << items << "),#10);\n"
       << "#10=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#14))"
          "GLOBAL_UNIT_ASSIGNED_CONTEXT((#11,#12,#13))REPRESENTATION_CONTEXT('',''));\n"
       << unit << "#14=UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-05),#11,'','');\n"
       << entities << "ENDSEC;\nEND-ISO-10303-21;\n";
  return text.str();
}

const char* const Millimetres = "#11=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n";
const char* const Inches = "#11=(CONVERSION_BASED_UNIT('INCH',#20)LENGTH_UNIT()NAMED_UNIT(#22));\n"
                           "#20=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#21);\n"
                           "#21=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"
                           "#22=DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);\n";
const char* const Radians = "#12=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));\n"
                            "#13=(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT());\n";
const char* const Degrees =
  "#12=(CONVERSION_BASED_UNIT('DEGREE',#23)NAMED_UNIT(#24)PLANE_ANGLE_UNIT());\n"
  "#23=PLANE_ANGLE_MEASURE_WITH_UNIT(PLANE_ANGLE_MEASURE(0.0174532925199432958),#25);\n"
  "#24=DIMENSIONAL_EXPONENTS(0.,0.,0.,0.,0.,0.,0.);\n"
  "#25=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));\n"
  "#13=(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT());\n";

std::string Number(double value)
{
  std::ostringstream text;
  text.precision(17);
  text << std::showpoint << value;
  return text.str();
}

std::string Point(double x, double y, double scale)
{
  return "CARTESIAN_POINT('',(" + Number(scale * x) + "," + Number(scale * y) + "," +
    Number(scale * 2.0) + "))";
}

/// The contour's four pieces #101 to #104: trimmed line, trimmed circle, spline, trimmed ellipse,
/// lengths divided by the unit. The circle runs backwards, from its end.
std::string Pieces(double scale, double right)
{
  std::ostringstream text;
  text << "#30=" << Point(0, -5, scale) << ";\n#31=" << Point(10, -5, scale)
       << ";\n#32=" << Point(10, 5, scale) << ";\n#33=" << Point(0, 5, scale)
       << ";\n#34=DIRECTION('',(1.,0.,0.));\n#35=DIRECTION('',(0.,0.,1.));\n"
          "#36=DIRECTION('',(0.,1.,0.));\n#37=VECTOR('',#34,"
       << Number(scale) << ");\n#38=LINE('',#30,#37);\n"
       << "#101=TRIMMED_CURVE('',#38,(#30,PARAMETER_VALUE(0.)),(#31,PARAMETER_VALUE(10.)),.T.,"
          ".PARAMETER.);\n#40="
       << Point(10, 0, scale) << ";\n#41=AXIS2_PLACEMENT_3D('',#40,#35,#34);\n#42=CIRCLE('',#41,"
       << Number(5 * scale) << ");\n#102=TRIMMED_CURVE('',#42,(#32,PARAMETER_VALUE("
       << Number(right) << ")),(#31,PARAMETER_VALUE(" << Number(-right)
       << ")),.F.,.PARAMETER.);\n#50=" << Point(8, 5, scale) << ";\n#51=" << Point(3, 5, scale)
       << ";\n#103=B_SPLINE_CURVE_WITH_KNOTS('',3,(#32,#50,#51,#33),.UNSPECIFIED.,.F.,.F.,(4,4),"
          "(0.,1.),.UNSPECIFIED.);\n#60="
       << Point(0, 0, scale) << ";\n#61=AXIS2_PLACEMENT_3D('',#60,#35,#36);\n#62=ELLIPSE('',#61,"
       << Number(5 * scale) << "," << Number(3 * scale)
       << ");\n#104=TRIMMED_CURVE('',#62,(#33,PARAMETER_VALUE(0.)),(#30,PARAMETER_VALUE("
       << Number(2 * right) << ")),.T.,.PARAMETER.);\n";
  return text.str();
}

/// The pieces as one composite curve, and as a set of curves.
void TestStepEntities()
{
  const std::string segments =
    "#111=COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#101);\n"
    "#112=COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.F.,#102);\n"
    "#113=COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#103);\n"
    "#114=COMPOSITE_CURVE_SEGMENT(.CONTINUOUS.,.T.,#104);\n"
    "#120=COMPOSITE_CURVE('',(#111,#112,#113,#114),.F.);\n#130=GEOMETRIC_CURVE_SET('',(#120));\n";
  const std::string set = "#130=GEOMETRIC_CURVE_SET('',(#104,#102,#101,#103));\n";
  for (const bool inches : { false, true })
  {
    const double scale = inches ? 1.0 / 25.4 : 1.0;
    for (const bool degrees : { false, true })
    {
      const std::string unit =
        std::string(inches ? Inches : Millimetres) + (degrees ? Degrees : Radians);
      const std::string pieces = Pieces(scale, degrees ? 90.0 : 0.5 * Pi);
      for (const std::string& what : { segments, set })
      {
        const std::string path = OutputPath("entities-" + std::to_string(inches) +
          std::to_string(degrees) + (what == set ? "-set.step" : "-composite.step"));
        WriteText(path, StepText(unit, pieces + what, "#130", "GEOMETRICALLY_BOUNDED_WIREFRAME"));
        CheckContour(path);
      }
    }
  }
}

/// Edges between vertices, in a wireframe and in a set of connected edges.
void TestStepEdges()
{
  std::ostringstream text;
  text << Pieces(1.0, 0.5 * Pi)
       << "#70=VERTEX_POINT('',#30);\n#71=VERTEX_POINT('',#31);\n#72=VERTEX_POINT('',#32);\n"
          "#73=VERTEX_POINT('',#33);\n#81=EDGE_CURVE('',#70,#71,#38,.T.);\n"
          "#82=EDGE_CURVE('',#71,#72,#42,.T.);\n#83=EDGE_CURVE('',#72,#73,#103,.T.);\n"
          "#84=EDGE_CURVE('',#73,#70,#62,.T.);\n"
          "#90=CONNECTED_EDGE_SET('',(#81,#82,#83,#84));\n"
          "#130=EDGE_BASED_WIREFRAME_MODEL('',(#90));\n";
  const std::string path = OutputPath("edge-wireframe.step");
  WriteText(
    path, StepText(std::string(Millimetres) + Radians, text.str(), "#130", "EDGE_BASED_WIREFRAME"));
  CheckContour(path);
}

/// A polyline, closed, of corners (0, 0), (8, 0), (8, 6), each of which may be there twice.
void TestStepPolyline()
{
  for (const std::string points :
    { "#30,#31,#32,#30", "#30,#31,#31,#32,#30", "#30,#30,#31,#32,#32,#32,#30,#30" })
  {
    const std::string text = "#30=CARTESIAN_POINT('',(0.,0.,0.));\n"
                             "#31=CARTESIAN_POINT('',(8.,0.,0.));\n"
                             "#32=CARTESIAN_POINT('',(8.,6.,0.));\n#40=POLYLINE('',(" +
      points + "));\n#130=GEOMETRIC_SET('',(#40));\n";
    const std::string path = OutputPath("polyline.step");
    WriteText(path,
      StepText(
        std::string(Millimetres) + Radians, text, "#130", "GEOMETRICALLY_BOUNDED_WIREFRAME"));
    const LineResult result = ReadGood(path, 1);
    if (result.Surfaces.size() == 1)
    {
      const double residual = LargestResidual(result.Surfaces[0],
        [](const Vec3& p)
        {
          return std::min(
            { std::abs(p.y()), std::abs(p.x() - 8.0), std::abs(6.0 * p.x() - 8.0 * p.y()) / 10.0 });
        });
      CHECK(residual < 1e-12, points << ": off by " << residual);
      CHECK(std::abs(Area(result.Surfaces[0]) - 24.0) < 0.01, "area of " << points);
      CHECK(result.Surfaces[0].CountU == 4, points << ": " << result.Surfaces[0].CountU);
    }
  }
}

/// The offset, to the left, of a cubic spline with simple inner knots.
std::string OffsetText(const std::vector<Vec3>& poles, double distance)
{
  const int spans = static_cast<int>(poles.size()) - 3;
  std::ostringstream text;
  std::string points, multiplicities = "4", knots = "0.";
  for (size_t i = 0; i < poles.size(); ++i)
  {
    const std::string name = "#" + std::to_string(1000 + i);
    text << name << "=CARTESIAN_POINT('',(" << Number(poles[i].x()) << "," << Number(poles[i].y())
         << ",0.));\n";
    points += (i > 0 ? "," : "") + name;
  }
  for (int i = 1; i <= spans; ++i)
  {
    multiplicities += i < spans ? ",1" : ",4";
    knots += "," + Number(i);
  }
  text << "#30=B_SPLINE_CURVE_WITH_KNOTS('',3,(" << points << "),.UNSPECIFIED.,.F.,.F.,("
       << multiplicities << "),(" << knots << "),.UNSPECIFIED.);\n#31=DIRECTION('',(0.,0.,1.));\n"
       << "#32=OFFSET_CURVE_3D('',#30," << Number(distance) << ",.F.,#31);\n"
       << "#130=GEOMETRIC_CURVE_SET('',(#32));\n";
  return StepText(
    std::string(Millimetres) + Radians, text.str(), "#130", "GEOMETRICALLY_BOUNDED_WIREFRAME");
}

/// Largest deviation from a distance of 0.2 between places on the line and a spline.
double OffsetError(const NurbsSurface& line, const std::vector<Vec3>& poles)
{
  TColgp_Array1OfPnt points(1, static_cast<int>(poles.size()));
  const int spans = points.Size() - 3;
  TColStd_Array1OfReal knots(1, spans + 1);
  TColStd_Array1OfInteger multiplicities(1, spans + 1);
  for (int i = 1; i <= points.Size(); ++i)
  {
    points(i) = gp_Pnt(poles[i - 1].x(), poles[i - 1].y(), 0.0);
  }
  for (int i = 1; i <= spans + 1; ++i)
  {
    knots(i) = i;
    multiplicities(i) = i == 1 || i > spans ? 4 : 1;
  }
  const Handle(Geom_BSplineCurve) spline = new Geom_BSplineCurve(points, knots, multiplicities, 3);
  double error = 0.0;
  for (const Vec3& place : Places(line, 500))
  {
    const GeomAPI_ProjectPointOnCurve foot(gp_Pnt(place.x(), place.y(), place.z()), spline);
    // Beyond the ends there is no foot.
    error = foot.NbPoints() > 0 ? std::max(error, std::abs(foot.LowerDistance() - 0.2)) : error;
  }
  return error;
}

/// Offsets of splines with many spans are as exact as of short ones; what cannot be approximated
/// is no line.
void TestStepOffsets()
{
  for (const int count : { 40, 300, 900 })
  {
    std::vector<Vec3> poles;
    for (int i = 1; i <= count; ++i)
    {
      poles.emplace_back(2.0 * i, 3.0 * std::sin(1.1 * i), 0.0);
    }
    const std::string path = OutputPath("offset.step");
    WriteText(path, OffsetText(poles, 0.2));
    const LineResult result = ReadGood(path, 1);
    if (result.Surfaces.size() == 1)
    {
      const double error = OffsetError(result.Surfaces[0], poles);
      CHECK(error < 1e-7 * 2.0 * count, "offset of " << count << " points: off by " << error);
    }
  }
  // (t^2, t^3) from -1 to 1.7: its normal turns round at the cusp, where the offset jumps.
  const std::string path = OutputPath("cusp.step");
  WriteText(path,
    OffsetText({ { 1, -1, 0 }, { -0.8, 1.7, 0 }, { -0.17, -2.89, 0 }, { 2.89, 4.913, 0 } }, 0.2));
  const LineResult cusp = ReadLines(path);
  CHECK(cusp.Errors.size() == 1 &&
      cusp.Errors[0].find("the offset curve cannot be approximated") != std::string::npos,
    "an offset with a jump: " << (cusp.Errors.empty() ? "no error" : cusp.Errors[0]));
}
}

int main()
{
  IGESControl_Controller::Init();
  STEPControl_Controller::Init();
  TestWriters();
  TestStepEntities();
  TestStepEdges();
  TestStepPolyline();
  TestStepOffsets();
  return Failures != 0;
}
