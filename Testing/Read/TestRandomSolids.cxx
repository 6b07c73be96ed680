/**
 * @file TestRandomSolids.cxx
 * @brief Solids that OpenCASCADE puts together at random, written as STEP and IGES and read back:
 * each point is on the side of the surface on which the solid has it.
 *
 * Boxes, cylinders, spheres, cones and tori at places and with sizes that are multiples of a half,
 * so that they often touch each other: cusps, cracks, and bodies with an edge in common.
 *
 * TestRandomSolids [number [first seed]]
 */
#include "ReadTesting.h"
#include "SurfaceGaps.h"
#include "TrimmingSurface.h"

#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBndLib.hxx>
#include <BRepCheck_Analyzer.hxx>
#include <BRepClass3d_SolidClassifier.hxx>
#include <BRepGProp.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <Bnd_Box.hxx>
#include <GProp_GProps.hxx>
#include <IGESControl_Controller.hxx>
#include <IGESControl_Writer.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <STEPControl_Controller.hxx>
#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Shape.hxx>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <list>
#include <random>

using nurbs::Vec3;

namespace
{

class RandomSolid
{
public:
  explicit RandomSolid(unsigned seed)
    : Generator(seed)
  {
  }

  /// Of up to four bodies; null, or not valid, now and then.
  TopoDS_Shape Make()
  {
    TopoDS_Shape solid = this->Body();
    const int others = this->Whole(0, 3);
    for (int i = 0; i < others && !solid.IsNull(); ++i)
    {
      const TopoDS_Shape body = this->Body();
      const int way = this->Whole(0, 3);
      solid = way == 0 ? BRepAlgoAPI_Common(solid, body).Shape()
        : way == 1     ? BRepAlgoAPI_Cut(solid, body).Shape()
                       : BRepAlgoAPI_Fuse(solid, body).Shape();
    }
    return solid;
  }
  double Between(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(this->Generator);
  }

private:
  int Whole(int low, int high)
  {
    return std::uniform_int_distribution<int>(low, high)(this->Generator);
  }
  double Half(int low, int high) { return 0.5 * this->Whole(low, high); }

  gp_Ax2 Axis()
  {
    const gp_Pnt place(this->Half(0, 6), this->Half(0, 6), this->Half(0, 6));
    const gp_Dir axes[3] = { gp_Dir(1, 0, 0), gp_Dir(0, 1, 0), gp_Dir(0, 0, 1) };
    if (this->Whole(0, 5) == 0)
    {
      return { place, gp_Dir(this->Between(-1, 1), this->Between(-1, 1), this->Between(0.1, 1)) };
    }
    return { place, axes[this->Whole(0, 2)] };
  }

  TopoDS_Shape Body()
  {
    const gp_Ax2 axis = this->Axis();
    const double size = this->Half(1, 4), length = this->Half(2, 8), other = this->Half(0, 4);
    switch (this->Whole(0, 6))
    {
      case 0:
      case 1:
        return BRepPrimAPI_MakeBox(axis, size, length, other + 0.5).Shape();
      case 2:
      case 3:
        return BRepPrimAPI_MakeCylinder(axis, size, length).Shape();
      case 4:
        return BRepPrimAPI_MakeSphere(axis, size).Shape();
      case 5:
        return BRepPrimAPI_MakeCone(axis, size, other == size ? 0.0 : other, length).Shape();
      default:
        return BRepPrimAPI_MakeTorus(axis, size + 1.0, std::min(size, 1.0)).Shape();
    }
  }

  std::mt19937 Generator;
};

double VolumeOf(const TopoDS_Shape& shape)
{
  GProp_GProps properties;
  BRepGProp::VolumeProperties(shape, properties);
  return properties.Mass();
}

/// Whether it is one that OpenCASCADE itself reads as it wrote it.
bool IsSound(const TopoDS_Shape& shape, const std::string& path, TopoDS_Shape& read)
{
  if (shape.IsNull() || !BRepCheck_Analyzer(shape).IsValid() || VolumeOf(shape) < 0.3)
  {
    return false;
  }
  STEPControl_Writer writer;
  writer.Transfer(shape, STEPControl_AsIs);
  writer.Write(path.c_str());
  STEPControl_Reader reader;
  reader.ReadFile(path.c_str());
  reader.TransferRoots();
  read = reader.OneShape();
  return !read.IsNull() && BRepCheck_Analyzer(read).IsValid() &&
    std::abs(VolumeOf(read) - VolumeOf(shape)) < 1e-3 * VolumeOf(shape);
}

/// Whether points are in a shape; 2: it is not certain.
class Judge
{
public:
  explicit Judge(const TopoDS_Shape& shape)
  {
    for (TopExp_Explorer solid(shape, TopAbs_SOLID); solid.More(); solid.Next())
    {
      this->Solids.emplace_back(solid.Current());
    }
  }
  int Has(const Vec3& p)
  {
    int state = 0;
    for (BRepClass3d_SolidClassifier& solid : this->Solids)
    {
      solid.Perform(gp_Pnt(p[0], p[1], p[2]), 1e-6);
      state = solid.State() == TopAbs_ON ? 2 : solid.State() == TopAbs_IN ? 1 : state;
    }
    return state;
  }

private:
  std::list<BRepClass3d_SolidClassifier> Solids;
};

/// Asked again beside the point: on axes of cones and circles the classifier errs. And not where
/// bodies cross each other, which OpenCASCADE failed to unite.
bool IsWrong(const TopoDS_Shape& shape, const Vec3& p, const nurbs::Foot& foot)
{
  const auto isInside = [&shape](const Vec3& place) { return Judge(shape).Has(place) == 1; };
  const bool asInside = foot.SignedDistance < 0.0;
  const Vec3 step = 1e-3 * foot.Normal;
  return isInside(p + 1e-5 * Vec3(0.3, 0.7, 0.5)) != asInside &&
    isInside(p + 1e-5 * Vec3(-0.6, 0.2, -0.4)) != asInside &&
    !(isInside(foot.Point + step) && isInside(foot.Point - step));
}

void Compare(
  const std::string& name, const std::string& path, const TopoDS_Shape& shape, RandomSolid& random)
{
  const ReadResult result = ReadFile(path);
  CHECK(result.Errors.empty() && !result.Surfaces.empty(), name << ": it is not read");
  Bnd_Box box;
  BRepBndLib::Add(shape, box);
  const double size = std::sqrt(box.SquareExtent());
  const nurbs::TrimmingSurface surface(
    result.Surfaces, nurbs::GapShare * size, nurbs::WidestGapShare * size);
  double low[3], high[3];
  box.Get(low[0], low[1], low[2], high[0], high[1], high[2]);
  Judge judge(shape);
  int wrong = 0;
  Vec3 at = Vec3::Zero();
  for (int k = 0; k < 150; ++k)
  {
    Vec3 p;
    for (int i = 0; i < 3; ++i)
    {
      p[i] = random.Between(low[i] - 0.7, high[i] + 0.7);
      p[i] = k % 3 == 0 ? 0.5 * std::round(2.0 * p[i]) : p[i]; // over edges and lines of contact
    }
    const nurbs::Foot foot = surface.AmongTouching(p, surface.ClosestPoint(p));
    const int asInside = foot.SignedDistance < 0.0 ? 1 : 0;
    if (foot.Distance > 1e-4 && judge.Has(p) == 1 - asInside && IsWrong(shape, p, foot))
    {
      at = p;
      ++wrong;
    }
  }
  CHECK(
    wrong == 0, name << ": " << wrong << " points on the wrong side, one at " << at.transpose());
}

}

int main(int argc, char* argv[])
{
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_PrinterOStream));
  STEPControl_Controller::Init();
  IGESControl_Controller::Init();
  const int number = argc > 1 ? std::atoi(argv[1]) : 60;
  const unsigned first = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 1;
  int compared = 0;
  for (unsigned seed = first; compared < number; ++seed)
  {
    const std::string name = "solid " + std::to_string(seed);
    try
    {
      RandomSolid random(seed);
      const TopoDS_Shape made = random.Make();
      const std::string step = OutputPath(name + ".step"), iges = OutputPath(name + ".igs");
      TopoDS_Shape shape;
      if (!IsSound(made, step, shape))
      {
        continue;
      }
      ++compared;
      Compare(name + " by STEP", step, shape, random);
      IGESControl_Writer writer("MM", 1); // with bodies
      writer.AddShape(made);
      writer.Write(iges.c_str());
      Compare(name + " by IGES", iges, shape, random);
      std::remove(step.c_str());
      std::remove(iges.c_str());
    }
    catch (const Standard_Failure&)
    {
      // OpenCASCADE cannot make it.
    }
  }
  std::printf("%d solids compared\n", compared);
  return Failures;
}
