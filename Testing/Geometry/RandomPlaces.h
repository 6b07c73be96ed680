/**
 * @file RandomPlaces.h
 * @brief Random numbers and places for the tests of the kernel, the same in every run.
 */
#ifndef RandomPlaces_h
#define RandomPlaces_h

#include "NurbsSurface.h"

#include <random>

namespace samples
{

/// Seeded by each test with a number of its own.
inline std::mt19937 Random;

inline double Uniform(double low, double high)
{
  return std::uniform_real_distribution<double>(low, high)(Random);
}

inline nurbs::Vec3 RandomVector()
{
  return nurbs::Vec3(Uniform(-1, 1), Uniform(-1, 1), Uniform(-1, 1));
}

}

#endif
