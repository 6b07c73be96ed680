/**
 * @file SurfaceEnds.h
 * @brief What is wrong with a surface that does not part the mesh, and what to do.
 */
#ifndef SurfaceEnds_h
#define SurfaceEnds_h

#include "PlaceText.h"

#include <string>

namespace trim
{

/// It has a border within the grid.
inline std::string EndsInsideText(const nurbs::Vec3& place)
{
  return "The trimming surface ends inside the grid, at " + nurbs::PlaceText(place) +
    ", and so does not part it: extend the surface beyond the grid or close it.";
}

/// It has none, but contradicts itself.
inline std::string SidesMixedUpText(const nurbs::Vec3& place)
{
  return "The trimming surface has its two sides mixed up near " + nurbs::PlaceText(place) +
    ": where several bodies touch or cross each other, or a face is there twice, join them in the "
    "CAD program or leave one of them; where open patches beside each other, or closed lines "
    "within each other, face the same "
    "way, turn one round; where a body is turned inside out, repair it in the CAD program.";
}

}

#endif
