/**
 * @file FacePlaces.h
 * @brief Places on the faces of a model and on their borders, to ask what else is there.
 */
#ifndef FacePlaces_h
#define FacePlaces_h

#include "BezierEvaluation.h"
#include "Sectors.h"

#include <algorithm>
#include <vector>

namespace nurbs
{

/// Calls visit(patch) for the patches of a face, then for the curves of its loops, until it returns
/// false.
template <typename Visit>
void ForPatchesOf(const SurfaceModel& model, int face, const Visit& visit)
{
  const std::size_t count = model.Patches.size();
  for (std::size_t k = model.Data[face].FirstPatch; k < count && model.Patches[k].Face == face; ++k)
  {
    if (!visit(model.Patches[k]))
    {
      return;
    }
  }
}

/// Calls visit(patch, kind, place) for the borders of a face: by side, and 4 for a loop's curve.
template <typename Visit>
void ForBordersOf(const SurfaceModel& model, int face, const Visit& visit)
{
  const double s[5] = { 0, 1, 0.5, 0.5, 0.5 }, t[5] = { 0.5, 0.5, 0, 1, 0 };
  ForPatchesOf(model, face,
    [&](const BezierPatch& patch)
    {
      for (int kind = patch.Curve ? 4 : 0; kind < (patch.Curve ? 5 : 4); ++kind)
      {
        if (patch.Curve || (patch.Sides[kind] == SideKind::Border && !patch.Collapsed[kind]))
        {
          visit(patch, kind, Vec2(s[kind], t[kind]));
        }
      }
      return true;
    });
}

/// The same of all faces.
template <typename Visit>
void ForBorders(const SurfaceModel& model, const Visit& visit)
{
  for (int face = 0; face < static_cast<int>(model.Faces.size()); ++face)
  {
    ForBordersOf(model, face, visit);
  }
}

inline bool IsAmong(const std::vector<Sector>& sectors, int face)
{
  return std::any_of(
    sectors.begin(), sectors.end(), [face](const Sector& sector) { return sector.Face == face; });
}

/// Places of a patch to look at: a few, and the middles of leaves that lie within the loops.
inline std::vector<Vec2> PlacesOf(const SurfaceModel& model, const BezierPatch& patch)
{
  constexpr double places[] = { 0.2, 0.5, 0.8 };
  constexpr std::size_t most = 18;
  std::vector<Vec2> found;
  for (int k = 0; k < 9; ++k)
  {
    found.emplace_back(places[k / 3], places[k % 3]);
  }
  const bool trimmed = !model.Data[patch.Face].Loops.Empty();
  for (int k = 0; k < patch.GridU * patch.GridV && trimmed && found.size() < most; ++k)
  {
    if (model.TrimStates[patch.FirstLeaf + k] == TrimState::Inside)
    {
      found.emplace_back(
        (k % patch.GridU + 0.5) / patch.GridU, (k / patch.GridU + 0.5) / patch.GridV);
    }
  }
  return found;
}

/// Calls visit(sectors) for places within a face, with what is there up to a distance, until it
/// returns false.
template <typename Visit>
void ForPlacesWithin(const SurfaceModel& model, int face, double distance, const Visit& visit)
{
  constexpr int most = 16; // patches to look at
  int seen = 0;
  ForPatchesOf(model, face,
    [&](const BezierPatch& patch)
    {
      bool goesOn = !patch.Curve && seen++ < most;
      for (const Vec2& place : goesOn ? PlacesOf(model, patch) : std::vector<Vec2>())
      {
        const std::vector<Sector> sectors =
          FindSectors(model, BezierPoint(patch, model.Net(patch), place.x(), place.y()), distance);
        if (IsAmong(sectors, face) && !visit(sectors)) // else trimmed off
        {
          return false;
        }
      }
      return goesOn;
    });
}

/// Whether a face lies on another one all over, up to a distance.
inline bool LiesOn(const SurfaceModel& model, int face, int other, double distance)
{
  bool any = false, all = true;
  ForPlacesWithin(model, face, distance,
    [&](const std::vector<Sector>& sectors)
    {
      any = true;
      all = IsAmong(sectors, other);
      return all;
    });
  return any && all;
}

}

#endif
