/**
 * @file SurfaceBlocks.h
 * @brief The short way to the closest point: from near the surface, without a search.
 *
 * Each face is divided into blocks of about the same bend, whether a block is a part of one Bezier
 * patch or holds many of them. A block gives Newton its start, by a quadratic model. If the foot
 * lies in a block and the point is within the block's clearance, it is the closest point of the
 * whole surface: over the block and those around it the squared distance is convex, and all else is
 * farther away. Blocks and clearances are found when first asked for; they depend on the surface
 * alone.
 * From beyond it the same is tried for the one point: with the blocks that it can reach.
 */
#ifndef SurfaceBlocks_h
#define SurfaceBlocks_h

#include "BlockReach.h"
#include "MeasuringTurns.h"
#include "PatchTree.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <vector>

namespace nurbs
{
struct BlockLimits;
struct SurfaceModel;
struct SurfacePoint;

/// A rectangle in (u, v) of one face. Its own parameters run from -1/2 to 1/2.
struct alignas(CacheLine) SurfaceBlock
{
  Vec3 Center;                ///< S at the middle
  Eigen::Vector3f X, Y, Z;    ///< axes: X along S_u, Z the normal at the middle
  float Xu, Xv, Yv;           ///< first derivatives at the middle along the axes; the others are 0
  Eigen::Vector3f UU, UV, VV; ///< second derivatives along the axes
  /// Bounds about Center along the normal of S_v in the tangent plane, Y, and Z: a skew box.
  Eigen::Vector3f Low, High;
  Vec2 Middle, Width; ///< in (u, v)
  int Face;

  /// Edges of the skew box, so that a point with bounds b is Center + edges b.
  Eigen::Matrix3f Edges() const
  {
    Eigen::Matrix3f edges;
    edges.col(0) = this->X * (std::hypot(this->Xv, this->Yv) / this->Yv);
    edges.col(1) = this->Y + this->X * (this->Xv / this->Yv);
    edges.col(2) = this->Z;
    return edges;
  }
  Eigen::Vector3f AcrossV() const { return (this->Yv * this->X - this->Xv * this->Y).normalized(); }
};

/// A rectangle of blocks of one face; the ends are not in it.
struct BlockRange
{
  int FirstU, EndU, FirstV, EndV;

  bool Holds(int i, int j) const
  {
    return i >= this->FirstU && i < this->EndU && j >= this->FirstV && j < this->EndV;
  }
  void Add(int i, int j)
  {
    this->FirstU = std::min(this->FirstU, i);
    this->EndU = std::max(this->EndU, i + 1);
    this->FirstV = std::min(this->FirstV, j);
    this->EndV = std::max(this->EndV, j + 1);
  }
};

class SurfaceBlocks
{
public:
  /// @param shapes of all patches.
  void Build(const SurfaceModel& model, const std::vector<PatchShape>& shapes);

  /**
   * Newton for the closest point from a good guess: that of a block near p, or the start if it has
   * a patch. True if the foot is certainly the closest point of the surface. Else it is just a
   * point of the surface, or none (no patch).
   */
  bool FindFoot(const SurfaceModel& model, const Vec3& p, SurfacePoint& start) const;

  /// Newton from a start that has a patch; false if it leaves the face or does not converge. The
  /// foot need not be the closest point.
  static bool FollowFoot(const SurfaceModel& model, const Vec3& p, SurfacePoint& start);

private:
  /// The blocks of a face.
  struct Grid : ItemGrid
  {
    std::vector<int> BlockU, BlockV;         ///< of each knot span, the first of them
    std::vector<int> DivisionsU, DivisionsV; ///< blocks in the span; 1 where one holds many spans
    std::vector<double> BreaksU, BreaksV;
  };
  /// What is known of a block; found when first asked for, negative before.
  struct Certificate
  {
    std::atomic<float> Cost[3], Radius, Tilt{ -1 };
    std::atomic<float> Clearance[3] = { { -1 }, { -1 }, { -1 } }; ///< by width of the ring
    /// The block itself. Not in it: its memory would be read before it is written to, and then the
    /// kernel gives it twice, the second time in the way of all threads.
    std::atomic<bool> Measured{ false };
  };

  std::size_t Divide(
    const SurfaceModel& model, const std::vector<PatchShape>& shapes, const BlockLimits& limits);
  std::size_t ChooseGrids(const SurfaceModel& model, const std::vector<PatchShape>& shapes);
  void AddGrid(const SurfaceModel& model, int face, const std::vector<PatchShape>& shapes,
    const BlockLimits& limits, Grid& grid) const;
  Eigen::AlignedBox3f BoxOfBlock(
    const SurfaceModel& model, const std::vector<PatchShape>& shapes, int face, int i, int j) const;
  /// A block, measured when first asked for: much of a large surface never is.
  const SurfaceBlock& BlockOf(const SurfaceModel& model, int index) const;
  void MeasureBlock(const SurfaceModel& model, int index, SurfaceBlock& block) const;
  template <typename Visitor>
  void ForPieces(const SurfaceModel& model, int face, int i, int j, Visitor&& visit) const;
  BlockReach MeasureReach(const SurfaceModel& model, int block) const;
  BlockReach ReachOf(const SurfaceModel& model, int block) const;
  /// By which blocks round a block a clearance is proved.
  enum class Rings
  {
    Narrow,
    Wide
  };
  bool IsClear(const SurfaceModel& model, int block, double squared, Rings rings) const;
  double MeasureClearance(const SurfaceModel& model, int block, double width) const;
  BlockRange RingAbout(const SurfaceModel& model, int block, double width) const;
  double ConvexClearance(const SurfaceModel& model, int block, const BlockRange& ring) const;
  double ClearanceOfOthers(
    const SurfaceModel& model, int block, const BlockRange& ring, double clearance) const;
  bool IsSmooth(const SurfaceModel& model, int face, const BlockRange& range) const;
  bool IsConvex(const SurfaceModel& model, const Vec3& p, const Vec3& foot, int face,
    const BlockRange& range) const;
  bool IsClosest(
    const SurfaceModel& model, const Vec3& p, const SurfacePoint& foot, int index) const;
  int NearBlock(const Vec3& p) const;
  int BlockAt(int face, int spanU, int spanV, double s, double t) const;

  std::vector<Grid> Grids;
  mutable SparseVector<SurfaceBlock> Blocks;
  std::vector<TreeNode> Nodes; ///< over the blocks
  std::unique_ptr<Certificate[]> Certificates;
  MeasuringTurns Turns; ///< of the blocks
};

}

#endif
