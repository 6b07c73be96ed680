/**
 * @file TestBodies.cxx
 * @brief Files of several bodies: those that touch or cross each other are read as one, so that the
 * surface is the boundary of what they fill together.
 */
#include "ReadTesting.h"
#include "SolidTesting.h"

#include "vtkCADSurfaceReader.h"
#include "vtkMultiBlockDataSet.h"

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepBuilderAPI_Copy.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeSolid.hxx>
#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepBuilderAPI_Sewing.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <ShapeUpgrade_ShapeDivideAngle.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Shape.hxx>
#include <gp_Ax2.hxx>

#include <cmath>

namespace
{
TopoDS_Shape Box(double x, double y, double z, double dx, double dy, double dz)
{
  return BRepPrimAPI_MakeBox(gp_Pnt(x, y, z), dx, dy, dz).Shape();
}

TopoDS_Shape Cylinder(double x, double y, double z, double radius, double height)
{
  return BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(x, y, z), gp_Dir(0, 0, 1)), radius, height).Shape();
}

TopoDS_Shape Ball(double x, double y, double z, double radius)
{
  return BRepPrimAPI_MakeSphere(gp_Pnt(x, y, z), radius).Shape();
}

/// Its corners go round the middle twice, so that it crosses itself.
TopoDS_Shape Star(double x, double y, double z, double radius, double height)
{
  BRepBuilderAPI_MakePolygon polygon;
  for (int i = 0; i < 5; ++i)
  {
    const double angle = 0.8 * M_PI * i;
    polygon.Add(gp_Pnt(x + radius * std::cos(angle), y + radius * std::sin(angle), z));
  }
  polygon.Close();
  return BRepPrimAPI_MakePrism(
    BRepBuilderAPI_MakeFace(polygon.Wire()).Shape(), gp_Vec(0, 0, height))
    .Shape();
}

/// Its circles are two arcs each, as some programs write them.
TopoDS_Shape CylinderInHalves(double x, double y, double z, double radius, double height)
{
  ShapeUpgrade_ShapeDivideAngle divide(M_PI, Cylinder(x, y, z, radius, height));
  divide.Perform();
  return divide.Result();
}

/// A rectangle in a plane across z or x, and to which side it looks.
TopoDS_Shape Rectangle(const gp_Pnt& corner, const gp_Vec& one, const gp_Vec& other)
{
  BRepBuilderAPI_MakePolygon polygon(
    corner, corner.Translated(one), corner.Translated(one + other), corner.Translated(other), true);
  return BRepBuilderAPI_MakeFace(polygon.Wire()).Shape();
}

/// The faces of a body that close to a shell, but for one of them.
void AddFacesBut(const TopoDS_Shape& body, const gp_Pnt& onFace, std::vector<TopoDS_Shape>& faces)
{
  const TopoDS_Shape place = BRepBuilderAPI_MakeVertex(onFace).Shape();
  for (TopExp_Explorer it(body, TopAbs_FACE); it.More(); it.Next())
  {
    if (BRepExtrema_DistShapeShape(it.Current(), place).Value() > 1e-9)
    {
      faces.push_back(it.Current());
    }
  }
}

TopoDS_Shape SewnSolid(const std::vector<TopoDS_Shape>& faces)
{
  BRepBuilderAPI_Sewing sewing;
  for (const TopoDS_Shape& face : faces)
  {
    sewing.Add(face);
  }
  sewing.Perform();
  BRepBuilderAPI_MakeSolid solid;
  for (TopExp_Explorer it(sewing.SewedShape(), TopAbs_SHELL); it.More(); it.Next())
  {
    solid.Add(TopoDS::Shell(it.Current()));
  }
  return solid.Shape();
}

struct Assembly
{
  std::string Name;
  std::vector<TopoDS_Shape> Bodies;
  size_t Apart;  ///< faces of the bodies as they are
  size_t Joined; ///< faces of what they fill together
};

std::vector<Assembly> MakeAssemblies()
{
  const TopoDS_Shape block = Box(0, 0, 0, 10, 10, 4);
  const TopoDS_Shape pin = Cylinder(5, 5, -3, 2, 10);
  return {
    { "a block on a larger one", { block, Box(2, 3, 4, 5, 4, 3) }, 12, 11 },
    { "a pin in halves on a block", { block, CylinderInHalves(5, 5, 4, 2, 3) }, 10, 9 },
    { "two halves", { block, Box(10, 0, 0, 7, 10, 4) }, 12, 10 },
    { "a pin through a block", { block, pin }, 9, 10 },
    { "a pin in the bore that it fills",
      { BRepAlgoAPI_Cut(block, pin).Shape(), Cylinder(5, 5, 0, 2, 5) }, 10, 9 },
    { "a ball within a block", { block, Ball(5, 5, 2, 1) }, 7, 6 },
    { "a ball sunk in a block", { block, Ball(5, 5, 4, 2) }, 7, 7 },
    { "the same twice", { block, Box(0, 0, 0, 10, 10, 4) }, 12, 6 },
    { "a row of three, one apart",
      { block, Box(10, 2, 0, 5, 6, 4), Box(15, 0, 0, 5, 10, 4), Box(40, 0, 0, 5, 5, 5) }, 24, 24 },
    { "bodies with nothing in common", { block, Box(12, 0, 0, 7, 10, 4) }, 12, 12 },
    { "blocks along an edge", { block, Box(10, 0, 4, 7, 10, 4) }, 12, 12 },
    { "a ball in a hollow",
      { BRepAlgoAPI_Cut(block, Ball(5, 5, 2, 1.5)).Shape(), Ball(5, 5, 2, 1) }, 8, 8 },
  };
}

unsigned int CountUnjoined(const std::string& path)
{
  vtkNew<vtkCADSurfaceReader> reader;
  reader->SetFileName(path.c_str());
  CHECK(reader->GetJoinBodies(), "bodies are joined unless told otherwise");
  reader->JoinBodiesOff();
  reader->Update();
  return vtkMultiBlockDataSet::SafeDownCast(reader->GetOutputDataObject(0))->GetNumberOfBlocks();
}

void TestAssemblies()
{
  const std::string path = OutputPath("bodies.step");
  for (const Assembly& assembly : MakeAssemblies())
  {
    const TopoDS_Shape shape = Together(assembly.Bodies);
    WriteStep(shape, path);
    const size_t joined = ReadFile(path).Surfaces.size();
    CHECK(joined == assembly.Joined, assembly.Name << ": " << joined << " faces");
    CHECK(CountUnjoined(path) == assembly.Apart,
      assembly.Name << ": as they are, there are other faces");
    CHECK(IsBoundary(assembly.Name, path, shape), assembly.Name << ": a face is within the bodies");
  }
}

/// Walls without thickness, as programs write the leads of chips: one face goes on beyond the body,
/// and another one lies on the back of that.
void TestFins()
{
  const std::string path = OutputPath("fins.step");
  const TopoDS_Shape block = Box(0, 0, 0, 10, 10, 4);
  const TopoDS_Shape second = Box(25, 0, 0, 7, 10, 4);
  std::vector<TopoDS_Shape> standing;
  AddFacesBut(block, gp_Pnt(10, 5, 2), standing);
  standing.push_back(Rectangle(gp_Pnt(10, 0, 0), gp_Vec(0, 10, 0), gp_Vec(0, 0, 9)));
  standing.push_back(Rectangle(gp_Pnt(10, 0, 4), gp_Vec(0, 0, 5), gp_Vec(0, 10, 0)));
  std::vector<TopoDS_Shape> bridge;
  AddFacesBut(block, gp_Pnt(5, 5, 0), bridge);
  AddFacesBut(second, gp_Pnt(30, 5, 0), bridge);
  bridge.push_back(Rectangle(gp_Pnt(0, 0, 0), gp_Vec(0, 10, 0), gp_Vec(32, 0, 0)));
  bridge.push_back(Rectangle(gp_Pnt(10, 0, 0), gp_Vec(15, 0, 0), gp_Vec(0, 10, 0)));
  const struct
  {
    std::string Name;
    std::vector<TopoDS_Shape> Bodies, Without;
    size_t Faces;
  } cases[] = {
    { "a fin on a block", { SewnSolid(standing) }, { block }, 6 },
    { "a fin on a block on another one", { SewnSolid(standing), Box(2, 3, 4, 5, 4, 3) },
      { block, Box(2, 3, 4, 5, 4, 3) }, 11 },
    { "blocks that a fin holds together", { SewnSolid(bridge) }, { block, second }, 12 },
  };
  for (const auto& finned : cases)
  {
    WriteStep(Together(finned.Bodies), path);
    const ReadResult read = ReadFile(path);
    CHECK(read.Warnings.empty(), finned.Name << ": " << read.Warnings[0]);
    CHECK(read.Surfaces.size() == finned.Faces, finned.Name << ": " << read.Surfaces.size());
    CHECK(IsBoundary(finned.Name, path, Together(finned.Without)),
      finned.Name << ": a face is no boundary");
  }
}

/// IGES leaves the faces of bodies loose. What lies in another body is a void there.
void TestLooseFaces()
{
  const std::string path = OutputPath("bodies.igs");
  for (const Assembly& assembly : MakeAssemblies())
  {
    const TopoDS_Shape shape = Together(assembly.Bodies);
    WriteIges(shape, path, false);
    const bool isVoid = assembly.Name == "a ball within a block";
    const size_t joined = ReadFile(path).Surfaces.size();
    const std::string name = assembly.Name + ", of loose faces";
    CHECK(joined == (isVoid ? assembly.Apart : assembly.Joined), name << ": " << joined);
    CHECK(isVoid || IsBoundary(name, path, shape), name << ": a face is within the bodies");
  }
}

/// Each face twice, one after the other, as of a model with its construction: two that close are no
/// body.
void TestFacesTwice()
{
  const std::string path = OutputPath("twice.igs");
  std::vector<TopoDS_Shape> faces;
  const TopoDS_Shape bored = BRepAlgoAPI_Cut(Box(0, 0, 0, 10, 7, 4), Cylinder(5, 4, -1, 2, 7));
  for (TopExp_Explorer it(bored, TopAbs_FACE); it.More(); it.Next())
  {
    faces.push_back(it.Current());
    faces.push_back(BRepBuilderAPI_Copy(it.Current()).Shape());
  }
  WriteIges(Together(faces), path, false);
  const ReadResult read = ReadFile(path);
  CHECK(read.Warnings.empty(), "faces twice: " << read.Warnings[0]);
  CHECK(read.Surfaces.size() == 14, "faces twice: " << read.Surfaces.size());
}

/// A body that cannot be joined stays apart alone; one that is joined by way of another is not.
void TestSpoiler()
{
  const std::string path = OutputPath("spoiled.step");
  const TopoDS_Shape block = Box(0, 0, 0, 10, 10, 4);
  WriteStep(Together({ block, Box(10, 2, 0, 5, 6, 4), Box(10, 2, 4, 6, 6, 4), Box(0, 0, 4, 3, 3, 3),
              Star(6, 6, 3, 2, 9) }),
    path);
  const ReadResult read = ReadFile(path);
  CHECK(TellsOfUnjoined(read) && read.Warnings[0].find(": 1 body ") != std::string::npos,
    "a body that spoils others: no warning of it alone");
  CHECK(CountUnjoined(path) == 39, "a body that spoils others: as they are, there are other faces");
  CHECK(read.Surfaces.size() == 37, "a body that spoils others: " << read.Surfaces.size());
}

/// Joining that takes too long is given up, and the bodies are read as they are.
void TestTimeLimit()
{
  const int rings = 40;
  std::vector<TopoDS_Shape> bodies;
  for (int i = 0; i < rings; ++i)
  {
    const double angle = 0.7 * i;
    const gp_Ax2 axis(gp_Pnt(std::cos(angle), std::sin(angle), 0.1 * i),
      gp_Dir(std::sin(angle), 0.3 * std::cos(1.3 * angle), std::cos(angle)));
    bodies.push_back(BRepPrimAPI_MakeTorus(axis, 5.0 + 0.01 * i, 1.0).Shape());
  }
  const std::string path = OutputPath("rings.step");
  WriteStep(Together(bodies), path);
  const ReadResult read = ReadFile(path, 0, 3.0);
  CHECK(read.Errors.empty(), "rings that take long to join: " << read.Errors[0]);
  CHECK(TellsOfUnjoined(read), "rings that take long to join: no warning tells");
  CHECK(read.Surfaces.size() == rings, "rings that take long to join: " << read.Surfaces.size());
}
}

int main()
{
  SilenceTranslators();
  TestAssemblies();
  TestFins();
  TestLooseFaces();
  TestFacesTwice();
  TestSpoiler();
  TestTimeLimit();
  return Failures;
}
