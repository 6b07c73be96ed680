/**
 * @file Profile.h
 * @brief Plane curves with closest points in closed form or by exhaustive search; extruded they
 * are most of the trimming surfaces of the tests. Positive is the right-hand side.
 */
#ifndef Profile_h
#define Profile_h

#include "Model.h"

#include <algorithm>
#include <vector>

namespace judge
{
class Profile
{
public:
  virtual ~Profile() = default;
  /// Signed distance of the closest point.
  virtual double Signed(const Vec2& p) const = 0;
  /// Cheaper, good to 1e-5 of the curve's size: for sampling volumes.
  virtual double Roughly(const Vec2& p) const { return this->Signed(p); }
};

/// The line x = 0, run upwards: positive where x > 0.
class LineProfile : public Profile
{
public:
  double Signed(const Vec2& p) const override { return p[0]; }
};

/// Counter-clockwise: positive outside.
class CircleProfile : public Profile
{
public:
  CircleProfile(const Vec2& centre, double radius)
    : Centre(centre)
    , Radius(radius)
  {
  }
  double Signed(const Vec2& p) const override { return (p - this->Centre).norm() - this->Radius; }

private:
  Vec2 Centre;
  double Radius;
};

/// Counter-clockwise rectangle with rounded corners round the origin: positive outside.
class RoundedRectangleProfile : public Profile
{
public:
  RoundedRectangleProfile(double halfX, double halfY, double radius)
    : Inner(halfX - radius, halfY - radius)
    , Radius(radius)
  {
  }
  double Signed(const Vec2& p) const override
  {
    const Vec2 q = p.cwiseAbs() - this->Inner;
    return q.cwiseMax(Vec2::Zero()).norm() + std::min(q.maxCoeff(), 0.0) - this->Radius;
  }

private:
  Vec2 Inner;
  double Radius;
};

/// A B-spline curve; the closest of many samples is refined by Newton's method.
class SplineProfile : public Profile
{
public:
  SplineProfile(std::vector<double> knots, int degree, std::vector<Vec2> control);
  double Signed(const Vec2& p) const override;
  double Roughly(const Vec2& p) const override;
  double MinimumRadius() const;

private:
  struct Jet
  {
    Vec2 C, D1, D2;
  };
  Jet At(double t) const;
  /// The closest point by Newton's method between the neighbours of a sample.
  double Refined(const Vec2& p, int where) const;
  void Nearest(const Vec2& p, int first, int last, int node, double& best, int& where) const;
  void BuildBoxes(int first, int last, int node);

  struct Spline
  {
    std::vector<double> Knots;
    int Degree;
    std::vector<Vec2> Control;
    Vec2 At(double t) const;
    Spline Derivative() const;
  };
  std::vector<Spline> Splines; ///< the curve and as many derivatives as At tells, or as there are
  std::vector<Vec2> Samples;
  struct Box
  {
    Vec2 Low, High;
    double SquaredDistance(const Vec2& p) const;
  };
  std::vector<Box> Boxes; ///< of halves of halves of the samples
  double First, Last;
};

}

#endif
