/**
 * @file PatchTree.h
 * @brief Leaves: nearly flat parts of Bezier patches in oriented boxes, which hang in a box tree.
 */
#ifndef PatchTree_h
#define PatchTree_h

#include "BezierPatch.h"
#include "BoxTree.h"
#include "PageVector.h"
#include "PatchShape.h"

#include <atomic>

namespace nurbs
{
/// A rectangle in the parameters of a patch: that of a part of it.
struct PartDomain
{
  double S0, S1, T0, T1;
};

/**
 * One cell of the uniform grid laid over a patch. The costs and Deviation are certificates
 * drawn from the control net; they make one Newton run per leaf sufficient.
 */
struct Leaf
{
  Vec3 Center;             ///< a point of the surface inside the leaf
  Eigen::Vector3f X, Y, Z; ///< axes of its oriented box; Z is the mean normal
  float Inverse[4];        ///< (s, t) = middle + Inverse (x, y) in the plane of the box
  float SideCost;   ///< a point at (side, height) above Center has one closest point in the leaf
  float HeightCost; ///< if SideCost side + HeightCost height < 1
  float Deviation;  ///< bound on |J0^-1 (J - J0)| over the leaf; 2 if there is none
  int Patch;        ///< that it is a part of

  /// Where a place in the plane of the box is in the parameters of the patch, about.
  Vec2 ParametersAt(double x, double y, const PartDomain& domain) const
  {
    const float* m = this->Inverse;
    return Vec2(0.5 * (domain.S0 + domain.S1) + m[0] * x + m[1] * y,
      0.5 * (domain.T0 + domain.T1) + m[2] * x + m[3] * y);
  }
};

/**
 * The oriented box of a leaf. One cache line, and stored in the order of the tree: large surfaces
 * are searched at the speed of memory.
 */
struct alignas(CacheLine) LeafBox
{
  Eigen::Vector3f Center, X, Y; ///< the third axis is X x Y
  Eigen::Vector3f Low, High;
  std::atomic<int> Number; ///< of the leaf, from 1 on; 0 in new memory: nothing is known yet

  int Leaf() const { return this->Number.load(std::memory_order_relaxed) - 1; }
};
static_assert(sizeof(LeafBox) == CacheLine, "one line");

/// That of a leaf.
PartDomain DomainOf(const BezierPatch& patch, int leaf);

/// The net of a part of a patch: in `part`, or as it is where the part is the whole.
const Vec4* NetOfPart(
  const BezierPatch& patch, const Vec4* net, const PartDomain& domain, Vec4* part);

/// How long a leaf or block may be against its width: where it is askew little is certain of one
/// that is more slender, and the boxes of such leaves are full of each other.
constexpr double MostSlender = 8.0;

/// What leaves may be: how far one may bend (about radians), and how long it may be against its
/// width.
struct LeafLimits
{
  double Flatness, Slenderness;
};

/// Divides a patch so that its leaves are within the limits, as far as a few divisions do.
void ChooseGrid(const PatchShape& shape, const LeafLimits& limits, BezierPatch& patch);

/**
 * Oriented box, inverse map and certificates of one leaf.
 *
 * @param part the net restricted to it.
 */
void MeasureLeaf(const BezierPatch& patch, const PartDomain& domain, const Vec4* part, Leaf& leaf,
  LeafBox& oriented);

}

#endif
