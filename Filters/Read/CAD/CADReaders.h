/**
 * @file CADReaders.h
 * @brief What the library of the CAD readers offers to the program that loads it.
 *
 * This directory is a library of its own, because the forty libraries of OpenCASCADE that it needs
 * take several times longer to load than the rest of the plugin.
 */
#ifndef CADReaders_h
#define CADReaders_h

#include "CADCurveFile.h"
#include "CADFile.h"

namespace nurbs
{
struct CADReaders
{
  decltype(&ReadCADFile) ReadFile;
  decltype(&ReadCADCurves) ReadCurves;
};

extern "C"
{
  /// The one function that is looked up by its name.
  const CADReaders* NURBSTrimGetCADReaders();
}
}

#endif
