/**
 * @file ElementProbe.h
 * @brief One element with what is measured in it to tell what the surface asks of it.
 */
#ifndef ElementProbe_h
#define ElementProbe_h

#include "TrimResult.h"
#include "TrimmingSurface.h"

#include <array>

namespace trim
{

/// A candidate cell. Lengths are in elements: by the inverse of its mean edges.
struct ElementProbe
{
  Id Cell = -1;
  int Element = -1; ///< of the band, or -1
  int Count = 0;    ///< of nodes
  std::array<Id, 8> Node;
  std::array<Vec3, 8> Point;
  std::array<const nurbs::Foot*, 8> Feet;
  Eigen::Matrix3d ToElements; ///< from a vector in space to one in elements
  Vec3 Skin = Vec3::Zero();   ///< unit normal of the skin, zero without thickness
  int Nearest = -1;           ///< node with the nearest foot that has a side

  bool HasSkin() const { return this->Skin.squaredNorm() > 0.0; }
  double InElements(const Vec3& v) const { return (this->ToElements * v).norm(); }
  /// The part of a direction within the skin, not normalised.
  Vec3 Within(const Vec3& v) const { return v - this->Skin * this->Skin.dot(v); }
  /// Whether what lies beyond the surface at the nearest foot is in the element, by the planes of
  /// its faces. A surface that touches it from outside is not.
  bool HoldsNearestFoot() const;
};

/// False for an element that has no volume to measure by, or no foot that has a side.
bool MakeProbe(const HexMesh& mesh, const TrimResult& result, Id cell, ElementProbe& probe);

}

#endif
