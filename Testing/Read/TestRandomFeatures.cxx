/**
 * @file TestRandomFeatures.cxx
 * @brief Solids with the features of parts (rounded edges, sweeps, lofts, shells, voids), mirrored,
 * stretched or made splines at random, written as STEP and IGES and read back: each point is on the
 * side of the surface on which the solid has it, and as far from it by all files.
 *
 * TestRandomFeatures [number [first seed]]
 */
#include "ReadTesting.h"
#include "SolidTesting.h"

#include <BRepAlgoAPI_Check.hxx>
#include <BRepAlgoAPI_Cut.hxx>
#include <BRepAlgoAPI_Fuse.hxx>
#include <BRepBuilderAPI_GTransform.hxx>
#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakePolygon.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepBuilderAPI_NurbsConvert.hxx>
#include <BRepBuilderAPI_Transform.hxx>
#include <BRepFilletAPI_MakeChamfer.hxx>
#include <BRepFilletAPI_MakeFillet.hxx>
#include <BRepOffsetAPI_MakePipe.hxx>
#include <BRepOffsetAPI_MakeThickSolid.hxx>
#include <BRepOffsetAPI_ThruSections.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeCone.hxx>
#include <BRepPrimAPI_MakeCylinder.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeRevol.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BRepPrimAPI_MakeWedge.hxx>
#include <BRep_Tool.hxx>
#include <GC_MakeArcOfCircle.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_Curve.hxx>
#include <IGESControl_Reader.hxx>
#include <Standard_Failure.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopTools_ListOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>
#include <gp_Circ.hxx>
#include <gp_Elips.hxx>
#include <gp_GTrsf.hxx>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>

using nurbs::Vec3;

namespace
{
constexpr unsigned Kinds = 9; ///< of bodies
/// That of hollow ones: as trimmed surfaces OpenCASCADE writes offsets of extrusions wrong.
constexpr unsigned Hollow = 6;

TopTools_IndexedMapOfShape PartsOf(const TopoDS_Shape& shape, TopAbs_ShapeEnum type)
{
  TopTools_IndexedMapOfShape parts;
  TopExp::MapShapes(shape, type, parts);
  return parts;
}

TopoDS_Wire WireOf(const TopoDS_Edge& edge)
{
  return BRepBuilderAPI_MakeWire(edge).Wire();
}

/// A spline through points.
Handle(Geom_BSplineCurve) Through(const std::vector<gp_Pnt>& points, bool closed)
{
  Handle(TColgp_HArray1OfPnt) list = new TColgp_HArray1OfPnt(1, static_cast<int>(points.size()));
  for (size_t i = 0; i < points.size(); ++i)
  {
    list->SetValue(static_cast<int>(i) + 1, points[i]);
  }
  GeomAPI_Interpolate spline(list, closed, 1e-6);
  spline.Perform();
  return spline.Curve();
}

class RandomFeature
{
public:
  explicit RandomFeature(unsigned seed)
    : Generator(seed)
  {
  }

  /// Null, or not valid, now and then.
  TopoDS_Shape Make(unsigned kind)
  {
    const TopoDS_Shape body = this->Body(kind % Kinds);
    switch (this->Whole(0, 5))
    {
      case 0:
        return this->Mirrored(body);
      case 1:
        return this->Stretched(body);
      case 2:
        return BRepBuilderAPI_NurbsConvert(body, true).Shape();
      default:
        return body;
    }
  }

  /// In and round the box, and by ever less beside edges and vertices.
  std::vector<Vec3> DrawPoints(const TopoDS_Shape& shape)
  {
    Vec3 low, high;
    const double size = SizeOf(shape, low, high);
    const TopTools_IndexedMapOfShape edges = PartsOf(shape, TopAbs_EDGE);
    std::vector<Vec3> points;
    for (int k = 0; k < 120; ++k)
    {
      Vec3 p, way;
      for (int i = 0; i < 3; ++i)
      {
        p[i] = this->Between(low[i] - 0.1 * size, high[i] + 0.1 * size);
        way[i] = this->Between(-1, 1);
      }
      const TopoDS_Edge edge = TopoDS::Edge(edges(this->Whole(1, edges.Extent())));
      double first, last;
      const Handle(Geom_Curve) curve = BRep_Tool::Curve(edge, first, last);
      if (k % 2 == 0 && !curve.IsNull())
      {
        const double share = k % 4 == 0 ? 0.0 : this->Between(0, 1);
        const gp_Pnt at = curve->Value(first + share * (last - first));
        p = Vec3(at.X(), at.Y(), at.Z()) + size * std::pow(10.0, this->Between(-4, -1)) * way;
      }
      points.push_back(p);
    }
    return points;
  }

private:
  double Between(double low, double high)
  {
    return std::uniform_real_distribution<double>(low, high)(this->Generator);
  }
  int Whole(int low, int high)
  {
    return std::uniform_int_distribution<int>(low, high)(this->Generator);
  }

  /// A closed line in a plane: circle, ellipse, polygon, line and arcs, periodic spline.
  TopoDS_Wire Outline(const gp_Ax2& plane, int kind, double size)
  {
    const auto at = [&plane](double x, double y)
    {
      return plane.Location().Translated(
        gp_Vec(plane.XDirection()) * x + gp_Vec(plane.YDirection()) * y);
    };
    const double half = 0.5 * size;
    if (kind == 0)
    {
      return WireOf(BRepBuilderAPI_MakeEdge(gp_Circ(plane, size)));
    }
    if (kind == 1)
    {
      return WireOf(BRepBuilderAPI_MakeEdge(gp_Elips(plane, size, half)));
    }
    if (kind == 2)
    {
      return BRepBuilderAPI_MakePolygon(
        at(-size, -half), at(size, -half), at(size, half), at(-size, half), true)
        .Wire();
    }
    if (kind == 3)
    {
      std::vector<gp_Pnt> points;
      for (int i = 0; i < 6; ++i)
      {
        const double radius = size * this->Between(0.7, 1.1), angle = i * M_PI / 3;
        points.push_back(at(radius * std::cos(angle), radius * std::sin(angle)));
      }
      return WireOf(BRepBuilderAPI_MakeEdge(Through(points, true)));
    }
    BRepBuilderAPI_MakeWire slot;
    slot.Add(BRepBuilderAPI_MakeEdge(at(-size, -half), at(size, -half)));
    slot.Add(BRepBuilderAPI_MakeEdge(
      GC_MakeArcOfCircle(at(size, -half), at(size + half, 0), at(size, half)).Value()));
    slot.Add(BRepBuilderAPI_MakeEdge(at(size, half), at(-size, half)));
    slot.Add(BRepBuilderAPI_MakeEdge(
      GC_MakeArcOfCircle(at(-size, half), at(-size - half, 0), at(-size, -half)).Value()));
    return slot.Wire();
  }
  TopoDS_Face Profile(const gp_Ax2& plane, double size)
  {
    return BRepBuilderAPI_MakeFace(this->Outline(plane, this->Whole(0, 4), size));
  }

  TopoDS_Shape Prism()
  {
    return BRepPrimAPI_MakePrism(this->Profile(gp_Ax2(), this->Between(1.5, 2.5)),
      gp_Vec(this->Whole(0, 1) * this->Between(-1, 1), 0, this->Between(1, 4)))
      .Shape();
  }
  TopoDS_Shape Block()
  {
    const TopoDS_Shape plate = BRepPrimAPI_MakeBox(gp_Pnt(-3, -3, 0), 6, 6, 1.5).Shape();
    const TopoDS_Shape boss =
      BRepPrimAPI_MakeCylinder(gp_Ax2(gp_Pnt(0.3, 0.2, 0), gp_Dir(0, 0, 1)), 1.2, 3).Shape();
    const int way = this->Whole(0, 2);
    return way == 0 ? this->Prism()
      : way == 1    ? BRepAlgoAPI_Fuse(plate, boss).Shape()
                    : BRepAlgoAPI_Cut(plate, boss).Shape();
  }
  TopoDS_Shape Rounded()
  {
    const TopoDS_Shape block = this->Block();
    BRepFilletAPI_MakeFillet fillet(block);
    const bool changing = this->Whole(0, 2) == 0;
    const double radius = this->Between(0.05, 0.4);
    const TopTools_IndexedMapOfShape edges = PartsOf(block, TopAbs_EDGE);
    for (int i = 1; i <= edges.Extent(); ++i)
    {
      if (this->Whole(0, 2) > 0)
      {
        fillet.Add(radius, changing ? 0.3 : radius, TopoDS::Edge(edges(i)));
      }
    }
    return fillet.Shape();
  }
  TopoDS_Shape Chamfered()
  {
    const TopoDS_Shape block = this->Block();
    BRepFilletAPI_MakeChamfer chamfer(block);
    const TopTools_IndexedMapOfShape edges = PartsOf(block, TopAbs_EDGE);
    for (int i = 1; i <= edges.Extent(); ++i)
    {
      if (this->Whole(0, 2) > 0)
      {
        chamfer.Add(0.2, TopoDS::Edge(edges(i)));
      }
    }
    return chamfer.Shape();
  }
  TopoDS_Shape Pipe()
  {
    BRepBuilderAPI_MakeWire spine;
    spine.Add(BRepBuilderAPI_MakeEdge(gp_Pnt(0, 0, 0), gp_Pnt(0, 0, 3)));
    spine.Add(BRepBuilderAPI_MakeEdge(GC_MakeArcOfCircle(
      gp_Pnt(0, 0, 3), gp_Pnt(2 - std::sqrt(2.0), 0, 3 + std::sqrt(2.0)), gp_Pnt(2, 0, 5))
                                        .Value()));
    spine.Add(BRepBuilderAPI_MakeEdge(gp_Pnt(2, 0, 5), gp_Pnt(5, 0, 5)));
    const gp_Ax2 across(gp_Pnt(), gp_Dir(0, 0, 1), gp_Dir(1, this->Between(-1, 1), 0));
    return BRepOffsetAPI_MakePipe(spine.Wire(), this->Profile(across, this->Between(0.3, 0.8)))
      .Shape();
  }
  TopoDS_Shape Loft()
  {
    BRepOffsetAPI_ThruSections loft(true, this->Whole(0, 1) == 0);
    const int sections = this->Whole(2, 4), kind = this->Whole(0, 4);
    const double turn = this->Between(-0.3, 0.3);
    for (int i = 0; i < sections; ++i)
    {
      const gp_Dir along(std::cos(i * turn), std::sin(i * turn), 0);
      const gp_Ax2 plane(gp_Pnt(this->Between(-0.3, 0.3), 0, 2 * i), gp_Dir(0, 0, 1), along);
      loft.AddWire(this->Outline(plane, kind, this->Between(0.8, 1.4)));
    }
    return loft.Shape();
  }
  /// About an axis that the profile touches or not, by a full turn or less.
  TopoDS_Shape Revolved()
  {
    const double inner = this->Whole(0, 1) * this->Between(0.3, 1.5);
    const double angle = this->Whole(0, 1) == 0 ? 2 * M_PI : this->Between(0.4, 6);
    const gp_Ax1 axis(gp_Pnt(), gp_Dir(0, 0, 1));
    if (inner > 0 && this->Whole(0, 2) == 0)
    {
      const gp_Ax2 plane(gp_Pnt(inner + 2, 0, 0), gp_Dir(0, 1, 0));
      return BRepPrimAPI_MakeRevol(this->Profile(plane, 1.0), axis, angle).Shape();
    }
    const bool drop = inner == 0 && this->Whole(0, 1) == 0;
    std::vector<gp_Pnt> points;
    for (int i = 0; i < 5; ++i)
    {
      const bool end = drop && (i == 0 || i == 4);
      points.emplace_back(end ? 0.0 : inner + this->Between(1, 2), 0, i);
    }
    BRepBuilderAPI_MakeWire wire(BRepBuilderAPI_MakeEdge(Through(points, false)));
    const gp_Pnt high(inner, 0, 4), low(inner, 0, 0);
    if (!drop)
    {
      wire.Add(BRepBuilderAPI_MakeEdge(points[4], high));
      wire.Add(BRepBuilderAPI_MakeEdge(low, points[0]));
    }
    wire.Add(BRepBuilderAPI_MakeEdge(high, low));
    return BRepPrimAPI_MakeRevol(BRepBuilderAPI_MakeFace(wire.Wire()).Face(), axis, angle).Shape();
  }
  TopoDS_Shape Hollowed()
  {
    const TopoDS_Shape block = this->Block();
    const TopTools_IndexedMapOfShape faces = PartsOf(block, TopAbs_FACE);
    TopTools_ListOfShape open;
    open.Append(faces(this->Whole(1, faces.Extent())));
    BRepOffsetAPI_MakeThickSolid solid;
    solid.MakeThickSolidByJoin(block, open, -this->Between(0.1, 0.3), 1e-4);
    return solid.Shape();
  }
  /// A ball or a box with voids in it.
  TopoDS_Shape Pierced()
  {
    TopoDS_Shape solid = this->Whole(0, 1) == 0 ? BRepPrimAPI_MakeSphere(4.5).Shape()
                                                : BRepPrimAPI_MakeBox(gp_Pnt(-4, -4, -4), 8, 8, 8);
    for (int i = this->Whole(1, 2); i > 0; --i)
    {
      const gp_Ax2 axis(gp_Pnt(this->Between(-1, 1), this->Between(-1, 1), this->Between(-1, 1)),
        gp_Dir(this->Between(-1, 1), this->Between(-1, 1), 1));
      const int kind = this->Whole(0, 3);
      const TopoDS_Shape tool = kind == 0 ? BRepPrimAPI_MakeSphere(axis, 1.2).Shape()
        : kind == 1                       ? BRepPrimAPI_MakeTorus(axis, 1.2, 0.4).Shape()
        : kind == 2                       ? BRepPrimAPI_MakeCone(axis, 1.0, 0.0, 1.5).Shape()
                                          : BRepPrimAPI_MakeCylinder(axis, 0.6, 9.0).Shape();
      solid = BRepAlgoAPI_Cut(solid, tool).Shape();
    }
    return solid;
  }

  TopoDS_Shape Body(unsigned kind)
  {
    switch (kind)
    {
      case 0:
        return this->Prism();
      case 1:
        return this->Rounded();
      case 2:
        return this->Chamfered();
      case 3:
        return this->Pipe();
      case 4:
        return this->Loft();
      case 5:
        return this->Revolved();
      case Hollow:
        return this->Hollowed();
      case 7:
        return this->Pierced();
      default:
        return BRepPrimAPI_MakeWedge(
          this->Between(2, 4), this->Between(1, 4), 3, 1, 1, this->Between(1, 2), this->Whole(1, 2))
          .Shape();
    }
  }

  TopoDS_Shape Mirrored(const TopoDS_Shape& body)
  {
    gp_Trsf mirror;
    mirror.SetMirror(gp_Ax2(gp_Pnt(1, 2, 3), gp_Dir(this->Between(-1, 1), 0.3, 1)));
    return BRepBuilderAPI_Transform(body, mirror, true).Shape();
  }
  TopoDS_Shape Stretched(const TopoDS_Shape& body)
  {
    gp_GTrsf map;
    map.SetValue(1, 1, this->Between(0.5, 2));
    map.SetValue(1, 2, this->Between(-0.4, 0.4));
    map.SetValue(3, 3, this->Between(0.5, 2));
    return BRepBuilderAPI_GTransform(body, map, true).Shape();
  }

  std::mt19937 Generator;
};

/// OpenCASCADE sweeps and lofts some bodies through themselves.
bool CrossesItself(const TopoDS_Shape& shape)
{
  return !BRepAlgoAPI_Check(shape, false, true).IsValid();
}

/// @return false where OpenCASCADE does not write what it was given: it turns some ellipses about
/// their centres, and takes one side of a seam for the other.
bool WriteSoundIges(const TopoDS_Shape& shape, const std::string& path, bool withBodies)
{
  constexpr double widest = 1e-3; // more than any rounded edge leaves
  WriteIges(shape, path, withBodies);
  IGESControl_Reader reader;
  reader.ReadFile(path.c_str());
  reader.TransferRoots();
  const TopoDS_Shape read = reader.OneShape();
  const TopTools_IndexedMapOfShape edges = PartsOf(read, TopAbs_EDGE);
  bool exact = !read.IsNull() && std::abs(AreaOf(read) - AreaOf(shape)) < 1e-3 * AreaOf(shape);
  for (int i = 1; i <= edges.Extent(); ++i)
  {
    exact = exact && BRep_Tool::Tolerance(TopoDS::Edge(edges(i))) < widest;
  }
  return exact;
}
}

int main(int argc, char* argv[])
{
  SilenceTranslators();
  const int number = argc > 1 ? std::atoi(argv[1]) : 22;
  const unsigned first = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 1;
  int compared = 0;
  for (unsigned seed = first; seed < first + static_cast<unsigned>(number); ++seed)
  {
    const std::string name = "feature " + std::to_string(seed);
    try
    {
      RandomFeature random(seed);
      const TopoDS_Shape made = random.Make(seed);
      const std::string step = OutputPath(name + ".step"), solid = OutputPath(name + ".igs");
      TopoDS_Shape shape;
      if (!IsSound(made, step, shape) || CrossesItself(made) || CrossesItself(shape))
      {
        continue;
      }
      ++compared;
      const std::vector<Vec3> points = random.DrawPoints(shape);
      CheckSides(name + " by STEP", step, shape, points);
      if (WriteSoundIges(made, solid, true))
      {
        CheckSides(name + " by IGES", solid, shape, points);
      }
      const std::string trimmed = OutputPath(name + "-trimmed.igs");
      if (seed % Kinds != Hollow && WriteSoundIges(made, trimmed, false))
      {
        CheckSameDistances(name + " by trimmed surfaces of IGES", trimmed, step, points);
      }
      for (const std::string& file : { step, solid, trimmed })
      {
        std::remove(file.c_str());
      }
    }
    catch (const Standard_Failure&)
    {
      // OpenCASCADE cannot make it.
    }
  }
  CHECK(2 * compared > number, compared << " of " << number << " solids compared");
  std::printf("%d solids compared\n", compared);
  return Failures;
}
