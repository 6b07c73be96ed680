#include "CADFins.h"

#include "CADSides.h"
#include "CADSolids.h"

#include <BOPAlgo_MakerVolume.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepBndLib.hxx>
#include <Bnd_Box.hxx>
#include <Message_ProgressScope.hxx>
#include <Precision.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_DataMapOfShapeInteger.hxx>
#include <TopoDS.hxx>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace nurbs
{
namespace
{
struct PlaneFace
{
  gp_Pln Plane;
  gp_Dir Outward;
  Bnd_Box Box;
};

std::vector<PlaneFace> FindPlaneFaces(const TopoDS_Shape& body)
{
  std::vector<PlaneFace> found;
  for (TopExp_Explorer it(body, TopAbs_FACE); it.More(); it.Next())
  {
    const TopoDS_Face& face = TopoDS::Face(it.Current());
    const BRepAdaptor_Surface surface(face, false);
    if (surface.GetType() != GeomAbs_Plane)
    {
      continue;
    }
    PlaneFace plane{ surface.Plane(), surface.Plane().Axis().Direction(), Bnd_Box() };
    if ((face.Orientation() == TopAbs_REVERSED) == surface.Plane().Direct())
    {
      plane.Outward.Reverse();
    }
    BRepBndLib::Add(face, plane.Box, false);
    found.push_back(plane);
  }
  return found;
}

/// Do the boxes share more than a line? Their edges' tolerances make them a little larger.
bool ShareArea(const Bnd_Box& one, const Bnd_Box& other)
{
  const gp_Pnt least[] = { one.CornerMin(), other.CornerMin() };
  const gp_Pnt largest[] = { one.CornerMax(), other.CornerMax() };
  int wide = 0;
  for (int axis = 1; axis <= 3; ++axis)
  {
    const double shared = std::min(largest[0].Coord(axis), largest[1].Coord(axis)) -
      std::max(least[0].Coord(axis), least[1].Coord(axis));
    if (shared < 0.0)
    {
      return false;
    }
    wide += shared > 10.0 * Precision::Confusion();
  }
  return wide >= 2;
}

bool AreBackToBack(const PlaneFace& one, const PlaneFace& other)
{
  return one.Outward.IsOpposite(other.Outward, Precision::Angular()) &&
    one.Plane.Distance(other.Plane.Location()) < Precision::Confusion() &&
    ShareArea(one.Box, other.Box);
}

bool MayHaveFin(const TopoDS_Shape& body)
{
  const std::vector<PlaneFace> faces = FindPlaneFaces(body);
  for (size_t i = 0; i < faces.size(); ++i)
  {
    for (size_t k = 0; k < i; ++k)
    {
      if (AreBackToBack(faces[i], faces[k]))
      {
        return true;
      }
    }
  }
  return false;
}

/// The number of a solid in a list, or of none the first one.
class BodyOfFace
{
public:
  /// @param numbers of the solids of the shape, in their order.
  BodyOfFace(const TopoDS_Shape& solids, const std::vector<int>& numbers)
  {
    size_t next = 0;
    for (TopExp_Explorer solid(solids, TopAbs_SOLID); solid.More(); solid.Next(), ++next)
    {
      for (TopExp_Explorer face(solid.Current(), TopAbs_FACE); face.More(); face.Next())
      {
        this->Numbers.Bind(face.Current(), numbers[next]);
      }
    }
  }

  int operator()(const CADFace& face) const { return this->Numbers.Find(face.Shape); }

private:
  TopTools_DataMapOfShapeInteger Numbers;
};

/// What the faces of a body bound of space, if that is the body without its fins; null else.
TopoDS_Shape MakeVolumes(
  BOPAlgo_MakerVolume& maker, const TopoDS_Shape& body, const Message_ProgressRange& progress)
{
  for (TopExp_Explorer it(body, TopAbs_FACE); it.More(); it.Next())
  {
    maker.AddArgument(it.Current());
  }
  maker.SetIntersect(true);
  maker.SetNonDestructive(true);
  maker.SetAvoidInternalShapes(true);
  maker.Perform(progress);
  if (maker.HasErrors() || maker.Shape().IsNull())
  {
    return TopoDS_Shape();
  }
  const TopoDS_Shape& result = maker.Shape();
  const double before = VolumeOf(body);
  const bool sound = CountShapes(TopAbs_SOLID, result) > 0 && AreSoundSolids(result) &&
    std::abs(VolumeOf(result) - before) <= VolumeTolerance * before;
  return sound && FillTheSame({ body }, result) ? result : TopoDS_Shape();
}

void RemoveFinsOf(CADModel& model, int body, const Message_ProgressRange& progress)
{
  BOPAlgo_MakerVolume maker;
  const TopoDS_Shape solids = MakeVolumes(maker, model.Bodies[body], progress);
  if (solids.IsNull())
  {
    return;
  }
  const std::vector<bool> isOfBody = FacesOf(model, [body](int other) { return other == body; });
  std::vector<std::vector<CADFace>> parts =
    PartsOf(TakeMarked(model, isOfBody), *maker.History(), solids);
  if (parts.empty())
  {
    return;
  }
  std::vector<int> numbers;
  for (TopExp_Explorer it(solids, TopAbs_SOLID); it.More(); it.Next())
  {
    if (numbers.empty())
    {
      numbers.push_back(body);
      model.Bodies[body] = it.Current();
    }
    else
    {
      numbers.push_back(static_cast<int>(model.Bodies.size()));
      model.Bodies.push_back(it.Current());
    }
  }
  ReplaceFaces(model, isOfBody, std::move(parts), BodyOfFace(solids, numbers));
}
}

//------------------------------------------------------------------------------
void RemoveFins(CADModel& model, const Message_ProgressRange& progress)
{
  const std::set<int> isWrong = BodiesOfOtherParts(model);
  const int count = static_cast<int>(model.Bodies.size());
  Message_ProgressScope scope(progress, "Removing fins", count);
  for (int body = 0; body < count && scope.More(); ++body)
  {
    const Message_ProgressRange range = scope.Next();
    CatchReason(
      [&]
      {
        if (isWrong.count(body) == 0 && MayHaveFin(model.Bodies[body]))
        {
          RemoveFinsOf(model, body, range);
        }
        return std::string();
      });
  }
}
}
