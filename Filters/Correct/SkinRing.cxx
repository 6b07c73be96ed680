#include "SkinRing.h"

#include "NodeConstraint.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace trim
{
namespace
{

/// Some faces and those next to them on the same side of the model.
std::vector<int> FacesAround(
  const Band& band, const Columns& columns, const std::vector<int>& faces)
{
  return SideAround(band, faces,
    [&](int f, int other)
    {
      const auto &face = band.Faces[f], &next = band.Faces[other];
      // Nor from the skin between the layers, where a part of the model begins on it.
      const bool sameKind = columns.HasThickness(face.Element[0])
        ? columns.IsLayerFace(band, other) && next.Exterior == face.Exterior
        : next.Exterior;
      return sameKind && columns.InSamePart(face.Element[0], next.Element[0]);
    });
}

}

SkinRing::SkinRing(const Band& band, const Columns& columns, const std::vector<int>& faces)
  : Faces(FacesAround(band, columns, faces))
{
  for (const int f : this->Faces)
  {
    this->Facets.emplace_back(Facet(band, band.Faces[f]));
  }
}

int SkinRing::NearestFace(const Vec3& x, const std::vector<int>& without, Vec3& place) const
{
  const auto isLeftOut = [&without](int f)
  { return std::find(without.begin(), without.end(), f) != without.end(); };
  // As a rule the facet with the nearest middle holds the place, and others are too far away to be
  // searched.
  std::size_t likely = this->Faces.size();
  double toMiddle = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < this->Faces.size(); ++i)
  {
    const double squared = this->Facets[i].SquaredToMiddle(x);
    if (squared < toMiddle && !isLeftOut(this->Faces[i]))
    {
      toMiddle = squared;
      likely = i;
    }
  }
  Vec3 onLikely = x;
  const bool holds =
    likely < this->Faces.size() && this->Facets[likely].FindInside(x, InsideSlack, onLikely);
  const double atMost = holds ? (onLikely - x).norm() : std::numeric_limits<double>::infinity();

  int face = -1;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < this->Faces.size(); ++i)
  {
    const int f = this->Faces[i];
    Vec3 on = onLikely;
    const bool inside = i == likely ? holds
                                    : !this->Facets[i].IsFarther(x, std::min(nearest, atMost)) &&
        !isLeftOut(f) && this->Facets[i].FindInside(x, InsideSlack, on);
    if (!inside)
    {
      continue;
    }
    const double distance = (on - x).norm();
    if (distance < nearest)
    {
      nearest = distance;
      place = on;
      face = f;
    }
  }
  return face;
}

SkinRings::SkinRings(const Band& band, const Columns& columns, std::vector<int> faces)
  : TheBand(band)
  , TheColumns(columns)
  , Faces(std::move(faces))
{
}

const SkinRing& SkinRings::At(std::size_t ring) const
{
  return this->Rings.At(ring,
    [&]
    {
      return SkinRing(
        this->TheBand, this->TheColumns, ring > 0 ? this->At(ring - 1).Faces : this->Faces);
    });
}

}
