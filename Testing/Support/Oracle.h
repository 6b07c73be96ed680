/**
 * @file Oracle.h
 * @brief What the tests know about a trimming surface without asking the code under test:
 * on which side a point lies and how far away the surface is.
 */
#ifndef Oracle_h
#define Oracle_h

#include "Profile.h"
#include "SplineData.h"

#include <memory>

namespace judge
{
class Oracle
{
public:
  virtual ~Oracle() = default;
  /// Distance; positive on the side to which S_u x S_v points. Exact (about 1e-14 of the size)
  /// within half a grid of the surface; farther away only the sign is.
  virtual double Signed(const Vec3& p) const = 0;
  /// Its sign, cheaply.
  virtual double Roughly(const Vec3& p) const { return this->Signed(p); }
};

/// A profile in the plane of E1 and E2, swept along E1 x E2.
class SweptOracle : public Oracle
{
public:
  SweptOracle(const Vec3& origin, const Vec3& e1, const Vec3& e2, std::shared_ptr<Profile> profile);
  double Signed(const Vec3& p) const override { return this->Curve->Signed(this->Flat(p)); }
  double Roughly(const Vec3& p) const override { return this->Curve->Roughly(this->Flat(p)); }

private:
  Vec2 Flat(const Vec3& p) const;
  Vec3 Origin, E1, E2;
  std::shared_ptr<Profile> Curve;
};

/// Outside of a cone is positive.
class ConeOracle : public Oracle
{
public:
  ConeOracle(const Vec3& apex, const Vec3& axis, double halfAngle)
    : Apex(apex)
    , Axis(axis)
    , HalfAngle(halfAngle)
  {
  }
  double Signed(const Vec3& p) const override;

private:
  Vec3 Apex, Axis;
  double HalfAngle;
};

/// Outside of a torus is positive; with a ring of no radius it is a sphere.
class TorusOracle : public Oracle
{
public:
  TorusOracle(const Vec3& centre, const Vec3& axis, double ring, double tube)
    : Centre(centre)
    , Axis(axis)
    , Ring(ring)
    , Tube(tube)
  {
  }
  double Signed(const Vec3& p) const override;

private:
  Vec3 Centre, Axis;
  double Ring, Tube;
};

/**
 * The graph x = f(y, z) over a plane, f a B-spline on Greville abscissae, so that the surface's
 * parameters are y and z up to scale. Positive where x > f.
 */
class GraphOracle : public Oracle
{
public:
  GraphOracle(const Vec3& origin, const Eigen::Matrix3d& axes, const SplineSurface& heights,
    double halfY, double halfZ);
  double Signed(const Vec3& p) const override;
  double Roughly(const Vec3& p) const override;

private:
  struct Jet
  {
    double F, Fy, Fz;
  };
  Jet At(double y, double z) const;
  Vec3 Origin;
  Eigen::Matrix3d Axes;
  SplineSurface Heights; ///< x of the control points is f; parameters 0..1
  double HalfY, HalfZ;
};

}

#endif
