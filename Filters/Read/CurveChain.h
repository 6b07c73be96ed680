/**
 * @file CurveChain.h
 * @brief Joins the curves of a file end to end to lines, whatever their order and direction.
 */
#ifndef CurveChain_h
#define CurveChain_h

#include "CADCurveFile.h"
#include "TrimLineCurve.h"

namespace nurbs
{
/**
 * Joins curves whose ends lie within the tolerance of either, or within a millionth of the size
 * of them all, to open and closed lines, each one curve of the highest degree among its pieces.
 * The pieces stay what they are: degrees are elevated exactly, and where ends do not quite meet
 * only the last control points move, those of polynomial pieces rather than those of rational
 * ones, so that arcs stay arcs. Lines come in the order of their first pieces, and run in the
 * direction that those have. Curves shorter than their tolerance are dropped, and so are spans in
 * which a curve stands still, as at a point that the file has twice.
 *
 * @param curves  valid curves.
 * @param lines   at least one if true is returned.
 * @param message with false: that more than two ends meet, and where; with true: empty, or a
 *                remark on ends that lie near each other, but not within the tolerance.
 */
bool JoinCurves(
  const std::vector<FileCurve>& curves, std::vector<TrimLine>& lines, std::string& message);
}

#endif
