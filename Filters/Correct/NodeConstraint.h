/**
 * @file NodeConstraint.h
 * @brief Where a node may move: on its skin, along its ridge, or nowhere (paper, Fig. 6 and the
 * end of section 2.3).
 *
 * A node on an exterior face stays on that face, a node on a ridge on that ridge, a corner
 * where it is. In a sheet the faces between layers guide the inner nodes as the skin guides
 * its own, and the ridges are the lateral border of the sheet, layer by layer.
 */
#ifndef NodeConstraint_h
#define NodeConstraint_h

#include "Band.h"
#include "Columns.h"
#include "Facet.h"
#include "UniqueList.h"

#include <algorithm>
#include <vector>

namespace trim
{

enum class ConstraintKind : unsigned char
{
  Free,  ///< inside a solid block
  Faces, ///< on the faces
  Ridge, ///< along the ridge edges
  Fixed  ///< more than two ridges meet: a corner of the model
};

struct NodeConstraint
{
  ConstraintKind Kind = ConstraintKind::Free;
  std::vector<int> Faces;      ///< band faces that the node may slide on
  std::vector<int> RidgeEdges; ///< band edges that the node may slide along
  bool SharpCorner = false; ///< its ridge turns more than at a vertex of a smooth border, or ends

  bool operator==(const NodeConstraint& other) const
  {
    return this->Kind == other.Kind && this->Faces == other.Faces &&
      this->RidgeEdges == other.RidgeEdges && this->SharpCorner == other.SharpCorner;
  }
};

/// True for a face of nodes beyond the surface, or of such and others on it: it goes with what is
/// cut off.
bool GoesWhole(const BandFace& face, const std::vector<unsigned char>& nodeStatus);

/// Cosine of the turn from one face to another by their normals. Those of the exterior point
/// outwards, so that a thin edge turns by nearly 180 degrees; those between elements either way.
double TurnCosine(
  const BandFace& a, const Vec3& normalOfA, const BandFace& b, const Vec3& normalOfB);

/// Faces that meet under less than 45 degrees belong to one side of the model, others at a ridge:
/// bends with radii of two elements turn by about 30 degrees from face to face. Half a degree less,
/// as chamfers have just 45.
constexpr double SameSideCosine = 0.7133;

/// Some faces and, behind them, those next to each on the same side of the model.
/// @param mayFollow mayFollow(face, other): whether that may be one of them, as far as sides go.
template <typename Test>
std::vector<int> SideAround(const Band& band, const std::vector<int>& faces, const Test& mayFollow)
{
  UniqueList around(faces);
  for (const int f : faces)
  {
    const auto& face = band.Faces[f];
    const Vec3 normal = Facet(band, face).NormalAt(0);
    for (const int n : face)
    {
      for (const int other : band.FacesOfNode(n))
      {
        // Not round a ridge: that would be another side of the model.
        const auto& next = band.Faces[other];
        if (mayFollow(f, other) && !around.Has(other) &&
          TurnCosine(face, normal, next, Facet(band, next).NormalAt(0)) > SameSideCosine)
        {
          around.Add(other);
        }
      }
    }
  }
  return around.Take();
}

/**
 * The constraint of one node. Exterior faces that lie wholly beyond the surface do not hold a
 * node: they go with what is cut off.
 */
NodeConstraint ConstrainNode(
  const Band& band, const Columns& columns, const std::vector<unsigned char>& nodeStatus, int node);

/// The same by the faces of the kept elements alone, but for those that they share with others.
NodeConstraint ConstrainNode(const Band& band, const Columns& columns,
  const std::vector<unsigned char>& nodeStatus, const std::vector<char>& kept, int node);

}

#endif
