/**
 * @file TrimLineSweep.h
 * @brief Trim lines swept along a direction into NURBS surfaces, and what can be wrong with that.
 */
#ifndef TrimLineSweep_h
#define TrimLineSweep_h

#include "SheetSkin.h"
#include "TrimLineCurve.h"

#include <string>
#include <vector>

namespace nurbs
{
struct Sweep
{
  Vec3 Direction = Vec3::Zero(); ///< of any length; zero: to be found
  double Length = 0.0;           ///< how far to either side of the line; zero: to be found
};

/**
 * A unit direction and a length in place of those that are zero.
 *
 * With a skin: the normal that the skin has near the lines on the whole (SheetSkin::MeanNormal),
 * and a length that reaches from all of the lines through the part's bounding box along the
 * direction, and a tenth beyond. Without (null, or without nodes): the normal of what the closed
 * lines enclose, 0 0 1 for open ones, and the diagonal of the lines' bounding box.
 *
 * @param lines at least one.
 */
Sweep CompleteSweep(const Sweep& wanted, const std::vector<TrimLine>& lines, const SheetSkin* skin);

/**
 * Says what is wrong with lines and their sweep: a direction or length that is not finite or
 * positive, a direction along a line, a closed line that encloses no area seen along the
 * direction, lines that cross or turn back on themselves or cross one another. The text names the
 * thing, its place and what to do; empty: nothing is wrong.
 *
 * @param sweep complete.
 */
std::string FindDefect(const std::vector<TrimLine>& lines, const Sweep& sweep);

/**
 * S(u, v) = C(u) + v Direction for each line, v from -Length to Length: of the line's degree x 1.
 *
 * The normal S_u x S_v of a closed line points to what it encloses, whatever its sense; that of a
 * closed line within another away from it, and so on in turn (even-odd rule). That of an open
 * line points to its right for somebody who walks along it, head to `Direction`. Among several
 * lines an open one may be turned round, so that all agree on what goes: the first closed line, or
 * what lies between the open ones, is on the same side of all.
 *
 * @param lines without defects.
 */
std::vector<NurbsSurface> SweepLines(const std::vector<TrimLine>& lines, const Sweep& sweep);
}

#endif
