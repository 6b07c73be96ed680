/**
 * @file CADLibrary.h
 * @brief Loads the library of the CAD readers, and with it OpenCASCADE, when the first file is
 * read.
 */
#ifndef CADLibrary_h
#define CADLibrary_h

#include "CADReaders.h"

#include <string>

namespace nurbs
{
/// The readers, loaded by the first call; null with the reason in `error` if they cannot be.
/// Thread-safe.
const CADReaders* LoadCADReaders(std::string& error);
}

#endif
