/**
 * @file PlacesAstray.h
 * @brief Whether the trimmed mesh holds a place that it should, or should not: what lies between
 * two walls of the surface is lost, or stays, or has a border that goes into its tip.
 */
#ifndef PlacesAstray_h
#define PlacesAstray_h

#include "TrimBand.h"
#include "TrimmingSurface.h"

namespace trim
{

/// Whether a place near an element is lost though it lies on the kept side, or held beyond it.
bool IsAstray(
  const TrimBand& near, const nurbs::TrimmingSurface& surface, int element, const Vec3& place);

/// Whether an element went with all others round nodes of it that are to be kept, and the mesh does
/// not hold their place: no border comes there, whatever the width of what is lost. Off the border
/// of the model, whose corners may go where they are smaller than an element; not by type I, whose
/// border is no surface.
bool IsLostTip(const TrimBand& near, int element);

}

#endif
