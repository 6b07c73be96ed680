#include "NarrowCuts.h"

#include <vtkMultiBlockDataSet.h>
#include <vtkPolyData.h>

#include <Eigen/Geometry>

#include <cmath>

namespace judge
{
namespace
{
using Line = std::vector<Vec2>;

/// In elements, about the origin; what is closed ends where it begins.
struct Contour
{
  std::string Name;
  Line Corners;
};

double Between(Dice& dice, double low, double high)
{
  return low + (high - low) * dice.Any();
}

/// A rectangle with a tongue, narrower than it, from its upper side inwards, or with a tab
/// outwards.
Contour Tongue(Dice& dice)
{
  const double w = Between(dice, 0.1, 1.2), a = Between(dice, 2, 4), end = a - Between(dice, -3, 5);
  return { "tongue",
    { { -a, -a }, { a, -a }, { a, a }, { w, a }, { w, end }, { -w, end }, { -w, a }, { -a, a },
      { -a, -a } } };
}

/// From border to border with notches or tabs.
Contour Comb(Dice& dice)
{
  Contour comb{ "comb", { { -60, 0 } } };
  double x = -5;
  for (int i = dice.Below(4); i >= 0; --i)
  {
    const double width = Between(dice, 0.2, 2.5), depth = Between(dice, -3, 3);
    comb.Corners.insert(
      comb.Corners.end(), { { x, 0 }, { x, depth }, { x + width, depth }, { x + width, 0 } });
    x += width + Between(dice, 0.2, 2.5);
  }
  comb.Corners.emplace_back(60, 0);
  return comb;
}

Contour Chevron(Dice& dice)
{
  const double half = Between(dice, 0.15, 1.4);
  const Vec2 arm = 60 * Vec2(std::cos(half), std::sin(half));
  return { "chevron", { { arm.x(), -arm.y() }, { 0, 0 }, arm } };
}

Contour Zigzag(Dice& dice)
{
  Contour zigzag{ "zigzag", { { -60, 0 } } };
  const double step = Between(dice, 0.6, 3), height = Between(dice, 0.3, 3);
  for (int i = -6; i <= 6; ++i)
  {
    zigzag.Corners.emplace_back(i * step, i % 2 == 0 ? 0 : height);
  }
  zigzag.Corners.emplace_back(60, 0);
  return zigzag;
}

Contour Slot(Dice& dice)
{
  const double length = Between(dice, 1, 8), width = Between(dice, 0.1, 2);
  return { "slot",
    { { -length, -width }, { length, -width }, { length, width }, { -length, width },
      { -length, -width } } };
}

Contour Star(Dice& dice)
{
  Contour star{ "star", {} };
  const int tips = 3 + dice.Below(4);
  const double out = Between(dice, 2, 6), in = Between(dice, 0.3, 0.9) * out;
  for (int i = 0; i <= 2 * tips; ++i)
  {
    const double angle = M_PI * (i % (2 * tips)) / tips, radius = i % 2 == 0 ? out : in;
    star.Corners.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return star;
}

/// A wall on the contour. In a groove it runs along the skin, which its edges lie along.
SplineSurface WallOn(const Contour& contour, const Frame& box, bool isGroove, Dice& dice)
{
  const double turn = 2 * M_PI * dice.Any(), size = box.ElementSize;
  const Vec3 at(Between(dice, -0.7, 0.7) * box.HalfX, Between(dice, -0.7, 0.7) * box.HalfY,
    isGroove ? Between(dice, -0.9, 0.9) * box.HalfZ : 0.0);
  const double lean = dice.Chance(0.3) ? Between(dice, -0.5, 0.5) : 0.0;
  const double height = 3 * std::max({ box.HalfX, box.HalfY, box.HalfZ });
  SplineSurface wall = Wall(contour.Corners);
  for (Eigen::Vector4d& corner : wall.Control)
  {
    const double z = corner[2] / 9 * height;
    const Vec3 upright(size * corner[0] + lean * z, size * corner[1], z);
    const Vec3 own = isGroove ? Vec3(upright[0], upright[2], upright[1]) : upright;
    const Eigen::AngleAxisd turned(isGroove ? 0.2 * turn : turn, Vec3::UnitZ());
    corner.head<3>() = box.Centre + box.Axes * (at + turned * own);
  }
  return wall;
}

/// The same face once more, or one that differs by rounding.
vtkSmartPointer<vtkDataObject> Again(const SplineSurface& wall, const Frame& box, Dice& dice)
{
  SplineSurface other = dice.Chance(0.5) ? ReversedU(wall) : wall;
  const double by = dice.Chance(0.5) ? 0.0 : std::pow(10.0, Between(dice, -13, -8));
  for (Eigen::Vector4d& corner : other.Control)
  {
    corner.head<3>() += by * box.HalfX * Vec3(0.3, 0.2, 1);
  }
  return ToPolyData(other);
}

/// A face for each stretch of the wall, in any direction.
Surface InFaces(const SplineSurface& wall, Dice& dice)
{
  auto faces = vtkSmartPointer<vtkMultiBlockDataSet>::New();
  for (int i = 0; i + 1 < wall.CountU; ++i)
  {
    SplineSurface face = wall;
    face.CountU = 2;
    face.KnotsU = UniformKnots(2, 1);
    face.Control.clear();
    for (int v = 0; v < wall.CountV; ++v)
    {
      const auto row = wall.Control.begin() + v * wall.CountU + i;
      face.Control.insert(face.Control.end(), row, row + 2);
    }
    faces->SetBlock(
      static_cast<unsigned>(i), ToPolyData(dice.Chance(0.3) ? ReversedU(face) : face));
  }
  Surface surface;
  surface.Data = faces;
  return surface;
}

Cut DrawOne(Dice& dice, const Frame& box)
{
  using Maker = Contour (*)(Dice&);
  const auto make = dice.Pick(std::vector<Maker>{ Tongue, Comb, Chevron, Zigzag, Slot, Star });
  const Contour contour = make(dice);
  const bool isGroove = contour.Name != "tongue" && dice.Chance(0.25);
  const SplineSurface wall = WallOn(contour, box, isGroove, dice);
  Cut cut{ contour.Name + (isGroove ? " along the skin" : ""), {} };
  cut.What.Data = ToPolyData(wall);
  if (dice.Chance(0.3))
  {
    cut.Words += " in faces";
    cut.What = InFaces(wall, dice);
  }
  if (dice.Chance(0.2))
  {
    cut.Words += " twice";
    cut.What = Together(cut.What.Data, Again(wall, box, dice));
  }
  return cut;
}
}

//------------------------------------------------------------------------------
Cut DrawNarrow(Dice& dice, const Frame& box)
{
  Cut cut = DrawOne(dice, box);
  if (dice.Chance(0.2))
  {
    const Cut other = DrawOne(dice, box);
    cut.Words += " + " + other.Words;
    cut.What = Together(cut.What.Data, other.What.Data);
  }
  return cut;
}
}
