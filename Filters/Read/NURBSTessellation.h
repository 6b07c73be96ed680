/**
 * @file NURBSTessellation.h
 * @brief A tessellation of a NURBS surface, for the eye; the exact surface is in its field data.
 */
#ifndef NURBSTessellation_h
#define NURBSTessellation_h

#include "NURBSTrimReadModule.h" // For export macro
#include "NurbsSurface.h"        // For nurbs::NurbsSurface

class vtkPolyData;

namespace nurbs
{
/**
 * Fills `output` with polygons whose points lie on the surface.
 *
 * The parameter rectangle is divided at the knots, and between them evenly, into at least
 * `resolution` strips along u and along v, more where the surface bends strongly. Where the surface
 * has trim loops only what lies inside them (even-odd rule) is drawn: cells that a loop crosses are
 * cut along it, so that the border is the loop itself, and neighbouring polygons share their
 * points.
 *
 * Point data: `Normals` (unit, along S_u x S_v), `TCoords` (u, v, each scaled to 0..1 over the
 * domain). Polygons are oriented alike. Field data: the definition (WriteNURBSFieldData).
 *
 * @param surface    a valid surface (FindDefect is empty).
 * @param resolution least number of strips along either direction; below 1 counts as 1.
 */
NURBSTRIMREAD_EXPORT void TessellateNURBS(
  const NurbsSurface& surface, int resolution, vtkPolyData* output);
}

#endif
