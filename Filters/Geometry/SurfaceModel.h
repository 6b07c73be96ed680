/**
 * @file SurfaceModel.h
 * @brief The data that all queries share: faces, patches, leaves and their tree.
 *
 * Everything here is about a local origin, so that models far from zero keep their digits.
 */
#ifndef SurfaceModel_h
#define SurfaceModel_h

#include "KnotSpans.h"
#include "MeasuringTurns.h"
#include "PatchTree.h"
#include "SurfaceBlocks.h"
#include "TrimLoops.h"
#include "TrimmingSurface.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace nurbs
{
struct FaceData
{
  KnotSpans SpansU, SpansV;
  int FirstPatch = 0; ///< of those of the spans, row by row; pieces of its loops follow
  TrimLoops Loops;
  double Sign = 1.0; ///< of S_u x S_v, so that the shell is oriented alike
  double Area = 0.0; ///< of one of several faces

  /// The patch of two spans.
  int PatchOf(int spanU, int spanV) const
  {
    return this->FirstPatch + spanV * this->SpansU.Count() + spanU;
  }
  /// The corners of its domain in (u, v).
  Vec2 Low() const { return Vec2(this->SpansU.Breaks.front(), this->SpansV.Breaks.front()); }
  Vec2 High() const { return Vec2(this->SpansU.Breaks.back(), this->SpansV.Breaks.back()); }
};

struct SurfaceModel
{
  SurfaceModel(std::vector<NurbsSurface> faces, double gapTolerance, double widestGap);

  std::vector<NurbsSurface> Faces;
  std::vector<FaceData> Data;
  UnsetVector<BezierPatch> Patches;
  UnsetVector<Vec4> Nets;
  std::vector<TrimState> TrimStates; ///< of the leaves
  mutable SparseVector<Leaf> Leaves; ///< each is known once its box was asked for
  std::vector<TreeNode> Nodes;
  SurfaceBlocks Blocks;
  Vec3 Origin = Vec3::Zero();
  double Scale = 1.0;      ///< diagonal of the bounding box
  double Gap = 0.0;        ///< distance up to which borders count as one, rounding included
  double WidestGap = 0.0;  ///< the same where a border would be free otherwise
  double Resolution = 0.0; ///< distance below which points are the same (1e-12 Scale)
  Box3 Bounds;

  const Vec4* Net(const BezierPatch& patch) const { return this->Nets.data() + patch.Net; }

  /// What to try where a gap leaves a border free: a few times as much, at last the widest; 0
  /// after that.
  double NextGap(double gap) const
  {
    return gap < this->WidestGap ? std::min(4.5 * gap, this->WidestGap) : 0.0;
  }

  int PatchAt(int face, double u, double v) const;
  int LeafAt(const BezierPatch& patch, double s, double t) const;

  /// What hangs in the tree, measured when first asked for: much of a large surface never is.
  const LeafBox& BoxAt(int index) const
  {
    LeafBox& box = this->LeafBoxes[index];
    this->Turns.Measure(box.Number, index, [&] { return this->MeasureBox(index, box); });
    return box;
  }

  /// Asks for a child of a node before it is needed: large trees wait for memory only.
  void Prefetch(int child) const
  {
    const char* data = child < 0 ? reinterpret_cast<const char*>(&this->LeafBoxes[~child])
                                 : reinterpret_cast<const char*>(&this->Nodes[child]);
    __builtin_prefetch(data);
    __builtin_prefetch(data + 64);
  }

  /**
   * Visits all leaves whose boxes come within radius of p (local coordinates). The visitor is
   * given the leaf's index.
   */
  template <typename Visitor>
  void ForLeavesNear(const Vec3& p, double radius, Visitor&& visit) const;

private:
  /// The shapes of all patches are known while the model is made.
  using Shapes = std::vector<PatchShape>;

  void AddFace(int face, Shapes& shapes);
  void AddTrimCurves(int face, Shapes& shapes);
  void AddTrimCurve(
    int face, const TrimLoops::Edge& edge, const Vec2& from, const Vec2& to, Shapes& shapes);
  void ChooseGrids(const Shapes& shapes);
  void RefineTrimmedGrids();
  void AddLeaves(const Shapes& shapes);
  void HangLeaves(const Shapes& shapes);
  std::vector<Eigen::AlignedBox3f> BoxLeaves(const Shapes& shapes) const;
  void FindTrimStates();
  void FindTrimState(const BezierPatch& patch, int leaf);
  /// Returns what its Number becomes.
  int MeasureBox(int index, LeafBox& box) const;

  mutable SparseVector<LeafBox> LeafBoxes; ///< in the order of the tree, not those outside loops
  std::vector<int> LeafOrder;              ///< the leaves of the boxes
  MeasuringTurns Turns;                    ///< of the boxes and leaves
};

/// Squared distance from p to the oriented box of a leaf, never too large.
inline float SquaredDistanceToLeaf(const LeafBox& box, const Vec3& p)
{
  const Eigen::Vector3f d = (p - box.Center.cast<double>()).cast<float>();
  const float slack = 4e-7f * d.cwiseAbs().sum();
  const Eigen::Vector3f local(box.X.dot(d), box.Y.dot(d), box.X.cross(box.Y).dot(d));
  float sum = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const float e =
      std::max(std::max(box.Low[axis] - local[axis], local[axis] - box.High[axis]) - slack, 0.0f);
    sum += e * e;
  }
  return sum * (1 - 1e-6f);
}

/// A point prepared for distances to the float boxes of the tree.
struct TreePoint
{
  explicit TreePoint(const Vec3& p)
  {
    const double slack = 2e-7 * p.cwiseAbs().maxCoeff();
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Low[axis] = static_cast<float>(p[axis] + slack);
      this->High[axis] = static_cast<float>(p[axis] - slack);
    }
  }
  /// Squared distances to the four boxes of a node, never too large.
  Eigen::Array4f SquaredDistances(const TreeNode& node) const
  {
    Eigen::Array4f sum = Eigen::Array4f::Zero();
    for (int axis = 0; axis < 3; ++axis)
    {
      const Eigen::Array4f e =
        (node.Low[axis] - this->Low[axis]).max(this->High[axis] - node.High[axis]).max(0.0f);
      sum += e * e;
    }
    return sum * (1 - 1e-6f);
  }
  float Low[3], High[3];
};

/**
 * Visits what hangs in the tree in boxes within a squared distance of p, until it is told to stop.
 *
 * @param visit takes the index of an item and returns false to stop.
 * @return false if it was stopped.
 */
template <typename Visitor>
bool ForItemsNear(
  const std::vector<TreeNode>& nodes, const Vec3& p, double squaredDistance, Visitor&& visit)
{
  const TreePoint point(p);
  return ForItemsPassing(
    nodes,
    [&](const TreeNode& node) -> Eigen::Array<bool, 4, 1>
    { return point.SquaredDistances(node).cast<double>() <= squaredDistance; },
    std::forward<Visitor>(visit));
}

template <typename Visitor>
void SurfaceModel::ForLeavesNear(const Vec3& p, double radius, Visitor&& visit) const
{
  const float limit = static_cast<float>(radius * radius * (1 + 1e-6));
  ForItemsNear(this->Nodes, p, limit,
    [&](int box)
    {
      const LeafBox& near = this->BoxAt(box);
      if (SquaredDistanceToLeaf(near, p) <= limit)
      {
        visit(near.Leaf());
      }
      return true;
    });
}

}

#endif
