/**
 * @file CADChildProcess.h
 * @brief Reads a CAD file in a process of its own, which may crash without harm.
 *
 * OpenCASCADE 7.6 follows null references on many damaged files. Catching the signal in ParaView
 * would leave its memory in an unknown state, so the reading is done by a forked child that
 * sends the surfaces or curves back through a pipe.
 */
#ifndef CADChildProcess_h
#define CADChildProcess_h

#include "CADCurveFile.h"
#include "CADFile.h"

namespace nurbs
{
/**
 * The same as ReadCADFile, with the same parameters and results; a crash of the child, more
 * processor time than `seconds` (0: 10, and 100 more for each megabyte of the file), or more
 * memory than two gigabytes and 200 times the file, is an error that names the file. Stopping by
 * `progress` ends the child at once. One that ends while it joins bodies is followed by one that
 * leaves them as they are, and `error` tells.
 */
bool ReadCADFileInChild(const std::string& path, double unitInMillimetres, bool joinBodies,
  std::vector<NamedSurface>& surfaces, std::string& error, double seconds = 0.0,
  const ReadProgress& progress = ReadProgress());

/// ReadCADCurves in the same way.
bool ReadCADCurvesInChild(const std::string& path, double unitInMillimetres,
  std::vector<FileCurve>& curves, std::string& error,
  const ReadProgress& progress = ReadProgress());
}

#endif
