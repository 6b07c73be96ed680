/**
 * @file EarClipping.h
 * @brief Triangles of a simple polygon.
 */
#ifndef EarClipping_h
#define EarClipping_h

#include "NurbsSurface.h"

#include <vector>

namespace nurbs
{

/// Ear clipping of one simple polygon, counter-clockwise; n-2 triangles are appended.
void TriangulatePolygon(const std::vector<Vec2>& points, const std::vector<int>& polygon,
  std::vector<std::vector<int>>& triangles);

}

#endif
