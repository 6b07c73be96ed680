/**
 * @file SurfacePrint.h
 * @brief A number that tells whether ranks have the same surface.
 */
#ifndef SurfacePrint_h
#define SurfacePrint_h

#include "NurbsSurface.h"

#include <cstdint>
#include <vector>

namespace trim
{

/// Equal for equal faces in the same order, and hardly for others.
std::uint64_t PrintOf(const std::vector<nurbs::NurbsSurface>& faces);

}

#endif
