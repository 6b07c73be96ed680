/**
 * @file PatchShape.h
 * @brief How a Bezier patch bends and extends: what is to be known of each of a surface's.
 */
#ifndef PatchShape_h
#define PatchShape_h

#include "BezierPatch.h"

#include <Eigen/Geometry>

namespace nurbs
{

struct PatchShape
{
  /// How far the tangents turn along s and t, relative to the patch's size (about radians).
  Vec2 Bend = Vec2::Zero();
  Vec2 Size = Vec2::Zero(); ///< distances between the ends of the middle lines along s and t
  Eigen::AlignedBox3f Box;  ///< as BoxOfNet gives
};

PatchShape MeasurePatch(const BezierPatch& patch, const Vec4* net);

/// The box along the axes that a net lies in, rounded outwards.
Eigen::AlignedBox3f BoxOfNet(const Vec4* net, int size);

}

#endif
