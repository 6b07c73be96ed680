/**
 * @file TrimLineFile.h
 * @brief Points of a trim line from a text file.
 */
#ifndef TrimLineFile_h
#define TrimLineFile_h

#include "NurbsSurface.h"

#include <string>
#include <vector>

namespace nurbs
{
/**
 * Reads points from a CSV file: x, y, z in each line, separated by commas, semicolons, blanks or
 * tabs, quoted or not; with decimal commas where no comma separates. All lines are read in the same
 * way. Empty lines and lines that begin with # are passed over, and so is a header, the first other
 * line if none of its values is a number; where it names columns x, y, z, or Points:0 to 2 as
 * ParaView does, or three that differ in these letters only, as X_coord does, there may be others.
 * Units in brackets are passed over.
 *
 * @return false with one line in `error` that names the file, the line and what is expected, if
 * the file cannot be read, is in UTF-16, or has a line that is not three numbers.
 */
bool ReadTrimLineFile(const std::string& path, std::vector<Vec3>& points, std::string& error);
}

#endif
