/**
 * @file CADWires.h
 * @brief The wires of a CAD face, in the parameters of its surface.
 */
#ifndef CADWires_h
#define CADWires_h

#include "CADSurfaceConversion.h"

#include <Geom2d_Curve.hxx>
#include <Geom_Surface.hxx>
#include <gp_Pnt2d.hxx>

#include <vector>

class TopoDS_Face;

namespace nurbs
{
/// A stretch of a wire in the parameters of the face's surface, run in the wire's direction.
struct BoundaryCurve
{
  Handle(Geom2d_Curve) Curve;
  double First, Last;        ///< First > Last where the wire runs against the curve
  Vec2 Shift = Vec2::Zero(); ///< whole periods that join it to the stretch before

  Vec2 operator()(double t) const
  {
    const gp_Pnt2d p = this->Curve->Value(t);
    return Vec2(p.X(), p.Y()) + this->Shift;
  }
};
using BoundaryWire = std::vector<BoundaryCurve>;

/// The straight stretch between two places, which are not the same.
BoundaryCurve StraightBetween(const Vec2& first, const Vec2& last);

/// How far a wire reaches.
ParameterRange RangeOf(const BoundaryWire& wire);

/// The whole range of a surface; infinite where it does not end.
ParameterRange BoundsOf(const Handle(Geom_Surface) & surface);

bool IsFinite(const ParameterRange& range);

/// Parameters between which the curve is smooth, in the direction of the wire.
std::vector<double> SmoothPieces(const BoundaryCurve& boundary);

/// The wires of a face, which has to be oriented forward.
std::vector<BoundaryWire> CollectWires(
  const TopoDS_Face& face, const Handle(Geom_Surface) & surface);

/**
 * The range of parameters that the wires enclose. Exact where its ends are corners of the
 * wires or straight stretches; where a curved stretch bounds it a little is added, which the
 * trim loops take away again. More than a period only where a wire winds on, as a thread's does.
 */
ParameterRange EnclosedRange(
  const std::vector<BoundaryWire>& wires, const Handle(Geom_Surface) & surface);

/// A range of more than a period as one range for each turn; none if there are absurdly many.
std::vector<ParameterRange> Turns(
  const ParameterRange& whole, const Handle(Geom_Surface) & surface);
}

#endif
