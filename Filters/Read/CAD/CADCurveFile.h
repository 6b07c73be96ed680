/**
 * @file CADCurveFile.h
 * @brief Reads the curves of an IGES or STEP file that belong to no face.
 */
#ifndef CADCurveFile_h
#define CADCurveFile_h

#include "CADFile.h"
#include "SurfaceConstruction.h"

namespace nurbs
{
struct FileCurve
{
  std::string Name; ///< the file's name for it or for its nearest named owner, or empty
  ConvertedCurve Curve;
  double Tolerance = 0.0; ///< by the file, its ends may lie this far from where they should
};

/**
 * Reads every edge of the file that no face has: IGES curves alone or in composite curves, STEP
 * curves, wireframes and geometric sets. Lines, conics and splines are converted exactly, each to
 * one curve, as it comes in the file: nothing is joined or turned round.
 *
 * @param path              the file.
 * @param unitInMillimetres length of the output's unit: 25.4 for inches. The file's own unit is
 *                          honoured.
 * @param curves            at least one valid curve if true is returned, else empty.
 * @param error             one line that names the file, what is wrong and what to do; with
 *                          true, empty, or one line on curves that had to be left out.
 * @return false on any error; also when stopped by `progress`, then with an empty `error`.
 */
bool ReadCADCurves(const std::string& path, double unitInMillimetres,
  std::vector<FileCurve>& curves, std::string& error,
  const ReadProgress& progress = ReadProgress());
}

#endif
