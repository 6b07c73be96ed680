/**
 * @file BlockReach.h
 * @brief From where the distance to a block of the surface is convex over the block.
 */
#ifndef BlockReach_h
#define BlockReach_h

#include "NurbsSurface.h"

#include <cmath>

namespace nurbs
{
/**
 * Greatest derivatives of the nets of a block, about its centre and along the axes of a frame X, Y,
 * Z with X along S_u and Z the normal there; with respect to parameters of width 1 over the block.
 */
class BlockBounds
{
public:
  /**
   * @param axes rows X, Y, Z.
   * @param u, v the derivatives at the centre along the axes, times the weight there.
   */
  BlockBounds(const Vec3& center, const Eigen::Matrix3d& axes, const Vec3& u, const Vec3& v)
    : Center(center)
    , Axes(axes)
    , U(u)
    , V(v)
  {
  }

  /// @param widthU, widthV how many times wider the block is than the part of this net.
  void Add(int p, int q, const Vec4* net, double widthU, double widthV);

private:
  friend struct BlockReach;
  /// Add for given degrees; P < 0: at run time.
  template <int P, int Q>
  void AddNet(int degreeU, int degreeV, const Vec4* net, double widthU, double widthV);
  /// Of AddNet: the derivatives along u, of points along the axes.
  template <int P, int Q>
  void AddAlongU(int degreeU, int degreeV, const Vec4* points, double widthU);
  /// Of AddNet: those along v, the mixed one among them.
  template <int P, int Q>
  void AddAlongV(int degreeU, int degreeV, const Vec4* points, double widthU, double widthV);

  /// Of one derivative: the greatest component along each axis, and of the weight.
  struct Bound
  {
    Vec4 Most = Vec4::Zero();
    void Add(const Vec4& d) { this->Most = this->Most.cwiseMax(d.cwiseAbs()); }
  };
  Vec3 Center;
  Eigen::Matrix3d Axes;
  Vec3 U, V;
  Bound Value, FirstU, FirstV, UU, UV, VV;
  double DeviationU = 0, DeviationV = 0; ///< of the first derivatives from U, V
  double Radius = 0;                     ///< of the Cartesian points
};

/**
 * The test of MeasureReach (NetBounds.h) with a cost for each axis, since long narrow blocks
 * accelerate along one axis and extend along another: F is convex over the block for all points P
 * with Cost . |P| < 1, P along the axes, and distances d to points within Radius of the centre.
 */
struct BlockReach
{
  explicit BlockReach(const BlockBounds& bounds);
  BlockReach() = default;

  Eigen::Vector3f Cost = Eigen::Vector3f::Constant(HUGE_VALF); ///< infinite: nothing is certain
  float Radius = 0;
  float Tilt = 1; ///< bound of the tangent of the angle between the normals and Z
};

}

#endif
