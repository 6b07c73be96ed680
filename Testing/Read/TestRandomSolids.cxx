/**
 * @file TestRandomSolids.cxx
 * @brief Solids that OpenCASCADE puts together at random, written as STEP and IGES and read back:
 * each point is on the side of the surface on which the solid has it. Files of several such bodies,
 * which are joined as they are read, too.
 *
 * Boxes, cylinders, spheres, cones and tori at places and with sizes that are multiples of a half,
 * so that they often touch each other: cusps, cracks, and bodies with an edge in common.
 *
 * TestRandomSolids [number [first seed]]
 */
#include "ReadTesting.h"
#include "SolidTesting.h"

#include <BRepAlgoAPI_Common.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <Standard_Failure.hxx>
#include <TopoDS_Shape.hxx>

#include <cmath>
#include <cstdio>
#include <cstdlib>
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

  /// Two to four bodies, not united.
  TopoDS_Shape MakeSeveral()
  {
    std::vector<TopoDS_Shape> bodies(static_cast<size_t>(this->Whole(2, 4)));
    for (TopoDS_Shape& body : bodies)
    {
      body = this->Body();
    }
    return Together(bodies);
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

/// In and round the box of a shape, a third of them at multiples of a half: over edges and lines of
/// contact.
std::vector<Vec3> DrawPoints(const TopoDS_Shape& shape, RandomSolid& random)
{
  Vec3 low, high;
  SizeOf(shape, low, high);
  std::vector<Vec3> points;
  for (int k = 0; k < 150; ++k)
  {
    Vec3 p;
    for (int i = 0; i < 3; ++i)
    {
      p[i] = random.Between(low[i] - 0.7, high[i] + 0.7);
      p[i] = k % 3 == 0 ? 0.5 * std::round(2.0 * p[i]) : p[i];
    }
    points.push_back(p);
  }
  return points;
}

/// Bodies of which OpenCASCADE's union of all at once is closed, valid and wrong.
void TestWrongUnions()
{
  const std::string path = OutputPath("wrong union.step");
  for (unsigned seed : { 117, 146, 293 })
  {
    TopoDS_Shape shape;
    CHECK(IsSound(RandomSolid(seed).MakeSeveral(), path, shape), seed);
    const std::string name = "bodies " + std::to_string(seed);
    CHECK(TellsOfUnjoined(ReadFile(path)) || IsBoundary(name, path, shape),
      name << ": joined wrong, or left apart without a word");
  }
}

struct Count
{
  int Compared = 0;
  int Joined = 0;
};

/// @param several bodies in the file that are not united, instead of one solid.
void Compare(unsigned seed, bool several, Count& count)
{
  const std::string name = (several ? "bodies " : "solid ") + std::to_string(seed);
  const std::string step = OutputPath(name + ".step"), iges = OutputPath(name + ".igs");
  try
  {
    RandomSolid random(seed);
    const TopoDS_Shape made = several ? random.MakeSeveral() : random.Make();
    TopoDS_Shape shape;
    if (!IsSound(made, step, shape))
    {
      return;
    }
    ++count.Compared;
    CheckSides(name + " by STEP", step, shape, DrawPoints(shape, random));
    if (several)
    {
      // Surfaces that touch almost may be cut a little beside.
      count.Joined += IsBoundary(name, step, shape, 0.05);
    }
    else
    {
      WriteIges(made, iges, true);
      CheckSides(name + " by IGES", iges, shape, DrawPoints(shape, random));
      std::remove(iges.c_str());
    }
    std::remove(step.c_str());
  }
  catch (const Standard_Failure&)
  {
    // OpenCASCADE cannot make it.
  }
}
}

int main(int argc, char* argv[])
{
  SilenceTranslators();
  const int number = argc > 1 ? std::atoi(argv[1]) : 24;
  const unsigned first = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 1;
  TestWrongUnions();
  Count solids, bodies;
  for (unsigned seed = first; solids.Compared < number; ++seed)
  {
    Compare(seed, false, solids);
  }
  for (unsigned seed = first; 2 * bodies.Compared < number; ++seed)
  {
    Compare(seed, true, bodies);
  }
  std::printf("%d solids compared, %d files of several bodies, %d of them joined\n",
    solids.Compared, bodies.Compared, bodies.Joined);
  CHECK(10 * bodies.Joined >= 9 * bodies.Compared, "too few bodies are joined");
  return Failures;
}
