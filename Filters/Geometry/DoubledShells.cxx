#include "DoubledShells.h"

#include "DisjointSets.h"
#include "FacePlaces.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nurbs
{
namespace
{

/// Of the model's size: how far apart the same face may be written. No sheet is as thin.
constexpr double Rounding = 1e-5;

/// Relative difference of the areas of the same face, whose leaves may part it otherwise.
constexpr double AreaDifference = 1e-2;

/// Faces in sets of those that are at one place.
class FacesAtOnePlace
{
public:
  explicit FacesAtOnePlace(const SurfaceModel& model)
    : Model(model)
    , Distance(std::min(model.Gap, Rounding * model.Scale))
    , First(model.Faces.size())
  {
    std::iota(this->First.begin(), this->First.end(), 0);
    for (int face = 0; face < static_cast<int>(this->First.size()); ++face)
    {
      for (const int other : this->FindCandidates(face))
      {
        this->Compare(other, face);
      }
    }
  }

  bool IsFirst(int face) const { return this->First[face] == face; }
  int FirstOf(int face) const { return this->First[face]; }

private:
  /// Faces before this one that are at a place of it and as large.
  std::vector<int> FindCandidates(int face) const
  {
    std::vector<int> found;
    ForPlacesWithin(this->Model, face, this->Distance,
      [&](const std::vector<Sector>& sectors)
      {
        for (const Sector& sector : sectors)
        {
          const double area = this->Model.Data[face].Area;
          const bool alike =
            std::abs(this->Model.Data[sector.Face].Area - area) <= AreaDifference * area;
          if (sector.Face < face && alike)
          {
            found.push_back(sector.Face);
          }
        }
        return false; // one place tells
      });
    return found;
  }

  void Compare(int a, int b)
  {
    if (this->First[b] == b && LiesOn(this->Model, a, b, this->Distance) &&
      LiesOn(this->Model, b, a, this->Distance) && this->HasBordersOf(a, b) &&
      this->HasBordersOf(b, a))
    {
      this->First[b] = this->First[a];
    }
  }

  /// Whether the borders of a face are such of another one.
  bool HasBordersOf(int face, int other) const
  {
    bool all = true;
    ForBordersOf(this->Model, face,
      [&](const BezierPatch& patch, int, const Vec2& place)
      {
        if (all)
        {
          const std::vector<Sector> sectors = FindSectors(this->Model,
            BezierPoint(patch, this->Model.Net(patch), place.x(), place.y()), this->Distance);
          const auto isBorderOf = [&](int index)
          {
            return std::any_of(sectors.begin(), sectors.end(),
              [&](const Sector& sector) { return sector.Face == index && sector.RayCount > 0; });
          };
          all = !isBorderOf(face) || isBorderOf(other); // the first may be trimmed off
        }
      });
    return all;
  }

  const SurfaceModel& Model;
  double Distance;
  std::vector<int> First; ///< by face, the first of those at its place
};

}

std::vector<int> FindDoubledFaces(const SurfaceModel& model)
{
  const int count = static_cast<int>(model.Faces.size());
  const FacesAtOnePlace places(model);
  std::vector<int> doubled;
  std::vector<char> isTwice(count, 0); // by face: another one is at its place
  for (int face = 0; face < count; ++face)
  {
    if (!places.IsFirst(face))
    {
      doubled.push_back(face);
      isTwice[face] = isTwice[places.FirstOf(face)] = 1;
    }
  }
  if (doubled.empty())
  {
    return doubled;
  }
  DisjointSets<int> shells(count);
  std::vector<char> once(count, 0); // by face, then by shell: it has a face that is there once
  ForBorders(model,
    [&](const BezierPatch& patch, int, const Vec2& place)
    {
      if (!isTwice[patch.Face])
      {
        return;
      }
      const Vec3 x = BezierPoint(patch, model.Net(patch), place.x(), place.y());
      for (const Sector& sector : FindSectors(model, x, model.WidestGap))
      {
        shells.Unite(patch.Face, sector.Face);
        once[sector.Face] = once[sector.Face] || !isTwice[sector.Face];
      }
    });
  for (int face = 0; face < count; ++face)
  {
    once[shells.Find(face)] |= once[face];
  }
  doubled.erase(
    std::remove_if(doubled.begin(), doubled.end(),
      [&](int face) { return once[shells.Find(face)] || once[shells.Find(places.FirstOf(face))]; }),
    doubled.end());
  return doubled;
}

}
