/// @file BlockClearance.cxx
/// @brief How near a point has to be so that a foot in a block is the closest point.
#include "SurfaceBlocks.h"

#include "SurfaceModel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace nurbs
{

BlockReach SurfaceBlocks::ReachOf(const SurfaceModel& model, int index) const
{
  Certificate& known = this->Certificates[index];
  if (known.Tilt.load(std::memory_order_acquire) < 0)
  {
    // Two threads may do the same work, but they find the same.
    const BlockReach reach = this->MeasureReach(model, index);
    for (int axis = 0; axis < 3; ++axis)
    {
      known.Cost[axis].store(reach.Cost[axis], std::memory_order_relaxed);
    }
    known.Radius.store(reach.Radius, std::memory_order_relaxed);
    known.Tilt.store(reach.Tilt, std::memory_order_release);
    return reach;
  }
  BlockReach reach;
  for (int axis = 0; axis < 3; ++axis)
  {
    reach.Cost[axis] = known.Cost[axis].load(std::memory_order_relaxed);
  }
  reach.Radius = known.Radius.load(std::memory_order_relaxed);
  reach.Tilt = known.Tilt.load(std::memory_order_relaxed);
  return reach;
}

/// Whether a foot in the block, so far from the point (squared), is certainly the closest point.
bool SurfaceBlocks::IsClear(const SurfaceModel& model, int index, double squared, Rings rings) const
{
  // Each ring proves its own distance: a wide one keeps others off, a narrow one is more convex
  // and asks for less of the surface.
  constexpr double Widths[] = { 0.0, 0.5, 1.0 };
  const int first = rings == Rings::Narrow ? 0 : 1, end = rings == Rings::Narrow ? 1 : 3;
  for (int ring = first; ring < end; ++ring)
  {
    std::atomic<float>& known = this->Certificates[index].Clearance[ring];
    float clearance = known.load(std::memory_order_relaxed);
    if (clearance < 0)
    {
      clearance = static_cast<float>(0.999 * this->MeasureClearance(model, index, Widths[ring]));
      known.store(clearance, std::memory_order_relaxed);
    }
    if (squared < static_cast<double>(clearance) * clearance)
    {
      return true;
    }
  }
  return false;
}

namespace
{

constexpr float Infinity = std::numeric_limits<float>::infinity();

/// Extents of a block, or of a box along the axes, along unit vectors from the centre of a block.
struct Extents
{
  Eigen::Vector3f Middle, Half;
  Extents(const SurfaceBlock& frame, const Eigen::Vector3f& firstAxis, const SurfaceBlock& other)
  {
    const Eigen::Vector3f d = (other.Center - frame.Center).cast<float>();
    const Eigen::Matrix3f edges = other.Edges();
    const Eigen::Vector3f center = d + edges * (0.5f * (other.Low + other.High));
    const Eigen::Vector3f half = 0.5f * (other.High - other.Low);
    const Eigen::Vector3f* axes[3] = { &firstAxis, &frame.Y, &frame.Z };
    const float rounding = 1e-6f * (d.norm() + (edges * half.asDiagonal()).cwiseAbs().sum());
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Middle[axis] = axes[axis]->dot(center);
      this->Half[axis] =
        (axes[axis]->transpose() * edges).cwiseAbs().dot(half.transpose()) + rounding;
    }
  }
  Extents(const SurfaceBlock& frame, const Eigen::Vector3f& firstAxis, const TreeNode& node, int c)
  {
    Eigen::Vector3f center, half;
    for (int axis = 0; axis < 3; ++axis)
    {
      const float low = node.Low[axis][c], high = node.High[axis][c];
      center[axis] = static_cast<float>(0.5 * (double(low) + double(high)) - frame.Center[axis]);
      half[axis] = 0.5f * (high - low) + 1e-6f * (std::abs(low) + std::abs(high));
    }
    const Eigen::Vector3f* axes[3] = { &firstAxis, &frame.Y, &frame.Z };
    const float rounding = 1e-6f * (center.norm() + half.sum());
    for (int axis = 0; axis < 3; ++axis)
    {
      this->Middle[axis] = axes[axis]->dot(center);
      this->Half[axis] = axes[axis]->cwiseAbs().dot(half) + rounding;
    }
  }
};

/// The blocks [first, last) about a block, one on either side and on as far as width.
void FindRing(const std::vector<double>& breaks, int block, double width, int& first, int& last)
{
  constexpr int Most = 8;
  const int count = static_cast<int>(breaks.size()) - 1;
  first = std::max(0, block - 1);
  last = std::min(count, block + 2);
  while (first > 0 && block - first < Most && breaks[block] - breaks[first] < width)
  {
    --first;
  }
  while (last < count && last - block < Most && breaks[last] - breaks[block + 1] < width)
  {
    ++last;
  }
}

/**
 * How far from the surface a point with its foot in a block may be and still be nearer to the
 * foot than to all of another part. With v = Q - F and the normal n at F the sphere through Q
 * that touches at F has the radius |v|^2 / (2 n.v).
 */
class FreeDistance
{
public:
  /// @param tilt of the normals in the block against that at its middle.
  FreeDistance(const SurfaceBlock& block, double tilt)
    : Block(block)
    , First(block.AcrossV())
    , Own(block, this->First, block)
    , Tilt(tilt)
  {
    const Eigen::Matrix3f edges = block.Edges();
    this->LengthU = edges.col(0).norm();
    this->LengthV = edges.col(1).norm();
  }

  double To(const SurfaceBlock& other) const
  {
    return this->To(Extents(this->Block, this->First, other));
  }
  /// To all that hangs in the child of a node: never more than to one of it.
  double To(const TreeNode& node, int child) const
  {
    return 0.999 * this->To(Extents(this->Block, this->First, node, child));
  }

private:
  double To(const Extents& extents) const
  {
    const Eigen::Vector3f offset = (extents.Middle - this->Own.Middle).cwiseAbs();
    const Eigen::Vector3f gap = (offset - this->Own.Half - extents.Half).cwiseMax(0.0f);
    const Eigen::Vector3f most = offset + this->Own.Half + extents.Half;
    const double across = std::max(gap.x(), gap.y());
    const double squared = across * across + gap.z() * gap.z();
    const double rise =
      most.z() + this->Tilt * (most.x() * this->LengthU + most.y() * this->LengthV);
    return std::max({ 0.5 * std::sqrt(squared), across / (1 + this->Tilt), 0.5 * squared / rise });
  }

  const SurfaceBlock& Block;
  Eigen::Vector3f First;
  Extents Own;
  double Tilt;
  float LengthU, LengthV;
};

}

/// No edge, crease or trim loop runs through the blocks.
bool SurfaceBlocks::IsSmooth(const SurfaceModel& model, int face, const BlockRange& range) const
{
  const Grid& grid = this->Grids[face];
  const FaceData& data = model.Data[face];
  const Vec2 low(grid.BreaksU[range.FirstU], grid.BreaksV[range.FirstV]);
  const Vec2 high(grid.BreaksU[range.EndU], grid.BreaksV[range.EndV]);
  const auto isSmooth = [](const KnotSpans& spans, double from, double to)
  {
    for (std::size_t k = 0; k < spans.Breaks.size(); ++k)
    {
      if (spans.Breaks[k] > from && spans.Breaks[k] < to && spans.Kinds[k] != SideKind::Smooth)
      {
        return false;
      }
    }
    return true;
  };
  return isSmooth(data.SpansU, low.x(), high.x()) && isSmooth(data.SpansV, low.y(), high.y()) &&
    (data.Loops.Empty() || data.Loops.Classify(low, high) == TrimState::Inside);
}

/// The blocks about a block, as far as a ring of the width asked for, in sizes of the block.
BlockRange SurfaceBlocks::RingAbout(const SurfaceModel& model, int index, double width) const
{
  const SurfaceBlock& block = this->BlockOf(model, index);
  const Grid& grid = this->Grids[block.Face];
  const int i = grid.ColumnOf(index), j = grid.RowOf(index);
  const double sizeU = block.Xu, sizeV = std::hypot(block.Xv, block.Yv);
  const double wide = width * std::max(sizeU, sizeV);
  BlockRange ring;
  FindRing(grid.BreaksU, i, wide * block.Width.x() / sizeU, ring.FirstU, ring.EndU);
  FindRing(grid.BreaksV, j, wide * block.Width.y() / sizeV, ring.FirstV, ring.EndV);
  return ring;
}

/// How far from a foot in the block the distance is convex over all blocks of the ring.
double SurfaceBlocks::ConvexClearance(
  const SurfaceModel& model, int index, const BlockRange& ring) const
{
  const SurfaceBlock& block = this->BlockOf(model, index);
  const Grid& grid = this->Grids[block.Face];
  const BlockReach own = this->ReachOf(model, index);
  double clearance = HUGE_VAL;
  for (int j = ring.FirstV; j < ring.EndV; ++j)
  {
    for (int i = ring.FirstU; i < ring.EndU; ++i)
    {
      const int other = grid.ItemAt(i, j);
      const SurfaceBlock& around = this->BlockOf(model, other);
      const BlockReach reach = this->ReachOf(model, other);
      const Extents extents(around, around.X, block);
      const Eigen::Vector3f most = extents.Middle.cwiseAbs() + extents.Half;
      if (!(reach.Cost.maxCoeff() < Infinity) || most.norm() > reach.Radius)
      {
        return 0;
      }
      // The normal at the foot in the frame of the other block.
      const Eigen::Vector3f normal =
        Eigen::Vector3f(std::abs(block.Z.dot(around.X)), std::abs(block.Z.dot(around.Y)), 1.0f);
      const double rate = reach.Cost.dot(normal) + own.Tilt * reach.Cost.norm();
      clearance = std::min(clearance, (1 - reach.Cost.dot(most)) / (rate + 1e-30));
    }
  }
  return clearance;
}

/// As much of a clearance as the blocks outside the ring leave.
double SurfaceBlocks::ClearanceOfOthers(
  const SurfaceModel& model, int index, const BlockRange& ring, double clearance) const
{
  const SurfaceBlock& block = this->BlockOf(model, index);
  const Grid& grid = this->Grids[block.Face];
  const FreeDistance distance(block, this->ReachOf(model, index).Tilt);
  const TreePoint center(block.Center);
  const Extents extents(block, block.X, block);
  const double radius = (extents.Middle.cwiseAbs() + extents.Half).norm();
  // Those right behind the ring leave the least, mostly; then most nodes need not be opened.
  const int own[2] = { grid.ColumnOf(index), grid.RowOf(index) };
  for (const auto& [i, j] : { std::pair(ring.FirstU - 1, own[1]), std::pair(ring.EndU, own[1]),
         std::pair(own[0], ring.FirstV - 1), std::pair(own[0], ring.EndV) })
  {
    if (i >= 0 && i < grid.CountU && j >= 0 && j < grid.CountV)
    {
      const SurfaceBlock& other = this->BlockOf(model, grid.ItemAt(i, j));
      clearance = std::min(clearance, distance.To(other));
    }
  }
  std::vector<int> stack{ 0 };
  while (!stack.empty() && clearance > 0)
  {
    const TreeNode& node = this->Nodes[stack.back()];
    stack.pop_back();
    const Eigen::Array4f distances = center.SquaredDistances(node);
    for (int c = 0; c < 4; ++c)
    {
      const int child = node.Child[c];
      if (child == TreeNode::Empty || std::sqrt(distances[c]) - radius >= 2 * clearance ||
        distance.To(node, c) >= clearance)
      {
        continue;
      }
      if (child >= 0)
      {
        stack.push_back(child);
        continue;
      }
      const SurfaceBlock& other = this->BlockOf(model, ~child);
      if (other.Face != block.Face || !ring.Holds(grid.ColumnOf(~child), grid.RowOf(~child)))
      {
        clearance = std::min(clearance, distance.To(other));
      }
    }
  }
  return clearance;
}

/**
 * The distance within which a foot in the block is the closest point. On the rectangle of the block
 * and its neighbours the distance is convex as long as the point stays within the reach of each
 * of them; all other blocks are kept off by FreeDistance.
 */
double SurfaceBlocks::MeasureClearance(const SurfaceModel& model, int index, double width) const
{
  const BlockRange ring = this->RingAbout(model, index, width);
  if (!this->IsSmooth(model, this->BlockOf(model, index).Face, ring))
  {
    return 0;
  }
  const double convex = this->ConvexClearance(model, index, ring);
  const double clearance = this->ClearanceOfOthers(model, index, ring, convex);
  return std::max(0.0, std::min(clearance, 1e30));
}

}
