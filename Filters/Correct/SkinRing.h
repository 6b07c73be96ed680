/**
 * @file SkinRing.h
 * @brief The faces round a node that it may come to lie on, ring by ring.
 */
#ifndef SkinRing_h
#define SkinRing_h

#include "Columns.h"
#include "Facet.h"
#include "Remembered.h"

#include <vector>

namespace trim
{

/// How far beyond a facet's edges, in its parameters, still counts as inside.
constexpr double InsideSlack = 1e-9;

/// Faces on the side of the model that a node lies on.
struct SkinRing
{
  /// @param faces those that the node is on, or those of the ring before.
  SkinRing(const Band& band, const Columns& columns, const std::vector<int>& faces);

  /// The face with the nearest place to x inside it, but for some; -1: none.
  int NearestFace(const Vec3& x, const std::vector<int>& without, Vec3& place) const;

  std::vector<int> Faces; ///< those of the ring before among them
  std::vector<FacetSearch> Facets;
};

/// Rings of faces in which a node looks for the facet that it comes to lie on.
constexpr std::size_t SkinRange = 3;

/// The rings round a node, once they are asked for. What they are given must outlive them.
class SkinRings
{
public:
  /// @param faces those that the node is on.
  SkinRings(const Band& band, const Columns& columns, std::vector<int> faces);

  /// @param ring less than SkinRange.
  const SkinRing& At(std::size_t ring) const;

private:
  const Band& TheBand;
  const Columns& TheColumns;
  std::vector<int> Faces;
  Remembered<SkinRing> Rings{ SkinRange };
};

}

#endif
