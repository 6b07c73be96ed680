#include "Samples.h"

#include "IgesText.h"
#include "ReadTesting.h"

#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRep_Builder.hxx>
#include <GeomAPI_PointsToBSplineSurface.hxx>
#include <Geom_BSplineSurface.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Writer.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Shape.hxx>

#include <cmath>
#include <cstdio>
#include <map>
#include <regex>

#include <unistd.h>

namespace fuzz
{
namespace
{
void AddFile(std::vector<Sample>& samples, const std::string& directory, const std::string& name)
{
  const bool iges = name.find(".igs") != std::string::npos;
  samples.push_back({ name, iges, ReadText(directory + "/" + name) });
}

/// One that touches another by a face, and one that crosses both.
TopoDS_Shape BodiesToJoin(const gp_Ax2& axes)
{
  const auto boxFrom = [&axes](double x)
  {
    const gp_Vec step = x * gp_Vec(axes.XDirection());
    return BRepPrimAPI_MakeBox(axes.Translated(step), 10, 10, 10).Shape();
  };
  gp_Ax2 bar = axes.Translated(
    gp_Vec(axes.XDirection()) * -5 + gp_Vec(axes.YDirection()) * 5 + gp_Vec(axes.Direction()) * 5);
  bar.SetDirection(axes.XDirection());
  TopoDS_Compound bodies;
  BRep_Builder build;
  build.MakeCompound(bodies);
  build.Add(bodies, boxFrom(0));
  build.Add(bodies, boxFrom(10));
  build.Add(bodies, BRepPrimAPI_MakeCylinder(bar, 3, 30).Shape());
  return bodies;
}

std::map<std::string, TopoDS_Shape> Shapes()
{
  std::map<std::string, TopoDS_Shape> shapes;
  const gp_Ax2 axes(gp_Pnt(3, -2, 5), gp_Dir(1, 2, 4));
  shapes["box"] = BRepPrimAPI_MakeBox(axes, 40, 30, 20).Shape();
  shapes["cone"] = BRepPrimAPI_MakeCone(axes, 10, 4, 15).Shape();
  shapes["cylinder"] = BRepPrimAPI_MakeCylinder(axes, 10, 35, 2.0).Shape();
  shapes["sphere"] = BRepPrimAPI_MakeSphere(axes, 15).Shape();
  shapes["torus"] = BRepPrimAPI_MakeTorus(axes, 30, 8).Shape();
  shapes["bodies"] = BodiesToJoin(axes);
  TColgp_Array2OfPnt points(1, 5, 1, 4);
  for (int i = 1; i <= 5; ++i)
  {
    for (int j = 1; j <= 4; ++j)
    {
      points(i, j) = gp_Pnt(10 * i, 8 * j, 3 * std::sin(1.1 * i) + std::cos(0.7 * j));
    }
  }
  shapes["spline"] =
    BRepBuilderAPI_MakeFace(GeomAPI_PointsToBSplineSurface(points).Surface(), 1e-6).Shape();
  return shapes;
}

/// The time of writing becomes a constant, so that the same seed makes the same files.
std::string WithoutTime(const std::string& text)
{
  static const std::regex iges("[0-9]{8}\\.[0-9]{6}");
  static const std::regex step("[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9:]{8}");
  return std::regex_replace(
    std::regex_replace(text, iges, "20260101.000000"), step, "2026-01-01T00:00:00");
}

/// Solids and faces by OpenCASCADE's writers: IGES as trimmed surfaces and as solids, and STEP.
void AddWritten(std::vector<Sample>& samples, const std::string& directory)
{
  // Several processes may do so at a time.
  const std::string stem = directory + "/sample-" + std::to_string(getpid());
  Message::DefaultMessenger()->ChangePrinters().Clear();
  IGESControl_Controller::Init();
  STEPControl_Controller::Init();
  for (const auto& [name, shape] : Shapes())
  {
    for (const int solid : { 0, 1 })
    {
      const std::string path = stem + ".igs";
      IGESControl_Writer iges("MM", solid);
      iges.AddShape(shape);
      iges.ComputeModel();
      iges.Write(path.c_str());
      samples.push_back(
        { name + (solid ? "-solid.igs" : "-faces.igs"), true, WithoutTime(ReadText(path)) });
      std::remove(path.c_str());
    }
    const std::string path = stem + ".step";
    STEPControl_Writer step;
    step.Transfer(shape, STEPControl_AsIs);
    step.Write(path.c_str());
    samples.push_back({ name + ".step", false, WithoutTime(ReadText(path)) });
    std::remove(path.c_str());
  }
}

std::string Ref(int entity)
{
  return "," + std::to_string(entity);
}

/// One file for each kind of surface entity that the writers above do not make.
void AddEntities(std::vector<Sample>& samples)
{
  const auto add = [&samples](const std::string& name, const IgesText& text) {
    samples.push_back({ "entity-" + name + ".igs", true, text.Text() });
  };

  IgesText parametric;
  parametric.Add(114,
    "3,3,1,1,0.,1.,0.,2.,0.,1.,0.5,0.1,0.2,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,"
    "0.,0.,2.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,0.,1.,0.3,0.,0.,0.,0.,0.,"
    "0.,0.,0.,0.,0.,0.,0.,0.");
  add("114", parametric);

  IgesText ruled;
  const int low = ruled.AddOwned(110, "0.,0.,0.,10.,0.,0.");
  const int high = ruled.AddOwned(110, "0.,5.,0.,10.,7.,3.");
  ruled.Add(118, std::to_string(low) + Ref(high) + ",0,0");
  add("118", ruled);

  IgesText revolved;
  const int axis = revolved.AddOwned(110, "0.,0.,0.,0.,0.,1.");
  const int line = revolved.AddOwned(110, "5.,0.,0.,7.,0.,9.");
  const int cone = revolved.Add(120, std::to_string(axis) + Ref(line) + ",0.,3.");
  revolved.Add(140, "1.,0.,0.,2.5" + Ref(cone));
  add("120-140", revolved);

  IgesText swept;
  const int arc = swept.AddOwned(100, "0.,0.,0.,5.,0.,0.,5.");
  swept.Add(122, std::to_string(arc) + ",14.,5.,22.");
  add("122", swept);

  IgesText plane;
  const int circle = plane.AddOwned(100, "0.,0.,0.,5.,0.,5.,0.");
  plane.Add(108, "0.,0.,1.,0." + Ref(circle) + ",0.,0.,0.,0.");
  add("108", plane);

  const std::string bilinear = "1,1,1,1,0,0,1,0,0,0.,0.,1.,1.,0.,0.,1.,1.,1.,1.,1.,1.,0.,0.,0.,"
                               "10.,0.,0.,0.,10.,0.,10.,10.,1.,0.,1.,0.,1.";
  const std::string square = "1,0.2,0.2,0.,0.8,0.2,0.,0.8,0.8,0.,0.2,0.8,0.,0.2,0.2,0.";
  IgesText trimmed;
  const int base = trimmed.AddOwned(128, bilinear);
  const int loop = trimmed.AddOwned(106, "2,5" + square.substr(1), 12);
  const int onSurface = trimmed.AddOwned(142, "0" + Ref(base) + Ref(loop) + ",0,1");
  trimmed.Add(144, std::to_string(base) + ",1,0" + Ref(onSurface));
  add("144", trimmed);

  IgesText bounded;
  const int spline = bounded.AddOwned(128, bilinear);
  const int edge =
    bounded.AddOwned(106, "2,5,2.,2.,0.04,8.,2.,0.16,8.,8.,0.64,2.,8.,0.16,2.,2.,0.04", 12);
  const int boundary = bounded.AddOwned(141, "0,0" + Ref(spline) + ",1" + Ref(edge) + ",1,0");
  bounded.Add(143, "0" + Ref(spline) + ",1" + Ref(boundary));
  add("143", bounded);
}
}

std::vector<Sample> CadSamples(const std::string& directory)
{
  std::vector<Sample> samples;
  for (const char* name :
    { "FrontDoor.igs", "RearDoor.igs", "SidePanelOuter.igs", "WheelArch.igs" })
  {
    AddFile(samples, EXAMPLE_DATA, name);
  }
  for (const char* name : { "gotools-cylinder-sphere.igs", "gotools-torus.igs",
         "gotools-trimmed.igs", "solvespace-plate.step" })
  {
    AddFile(samples, READ_TEST_FILES, name);
  }
  // The small ones twice: they are read sooner, and damage to them is felt more often.
  for (int times = 0; times < 2; ++times)
  {
    AddEntities(samples);
    AddWritten(samples, directory);
  }
  return samples;
}
}
