#include "SurfaceBlocks.h"

#include "ClosestPoint.h"
#include "SurfaceModel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace nurbs
{
namespace
{

constexpr float Infinity = std::numeric_limits<float>::infinity();

/// Blocks of one direction of a face: how many a span has, or which spans share one.
void DivideDirection(const KnotSpans& spans, const std::vector<double>& bend, double flatness,
  int least, std::vector<int>& first, std::vector<int>& divisions, std::vector<double>& breaks)
{
  const int count = static_cast<int>(spans.Breaks.size()) - 1;
  const double length = spans.Breaks.back() - spans.Breaks.front();
  int blocks = 0;
  double open = 0; // bend of the block that the last span has left open
  double start = spans.Breaks.front();
  bool isOpen = false;
  breaks.assign(1, start);
  for (int k = 0; k < count; ++k)
  {
    const double low = spans.Breaks[k], high = spans.Breaks[k + 1];
    const double parts =
      std::max(std::ceil(bend[k] / flatness), std::floor(least * (high - low) / length + 1e-9));
    const int n = static_cast<int>(std::clamp(parts, 1.0, 64.0));
    const bool joins = isOpen && n == 1 && open + bend[k] <= flatness &&
      (high - start) * least <= length * (1 + 1e-9) && spans.Kinds[k] == SideKind::Smooth;
    if (joins)
    {
      open += bend[k];
      breaks.back() = high;
    }
    else
    {
      start = low;
      open = bend[k];
      blocks += n;
      for (int i = 1; i <= n; ++i)
      {
        breaks.push_back(i == n ? high : low + (high - low) * i / n);
      }
    }
    isOpen = n == 1;
    first.push_back(blocks - n);
    divisions.push_back(n);
  }
}

/// Edges of the skew box, so that a point with bounds b is Center + edges b.
Eigen::Matrix3f EdgesOf(const SurfaceBlock& block)
{
  Eigen::Matrix3f edges;
  edges.col(0) = block.X * (std::hypot(block.Xv, block.Yv) / block.Yv);
  edges.col(1) = block.Y + block.X * (block.Xv / block.Yv);
  edges.col(2) = block.Z;
  return edges;
}

}

//------------------------------------------------------------------------------
// Construction
//------------------------------------------------------------------------------

void SurfaceBlocks::AddGrid(const SurfaceModel& model, int face, const std::vector<Vec2>& bends,
  double flatness, int least, Grid& grid) const
{
  const FaceData& data = model.Data[face];
  const int countU = static_cast<int>(data.SpansU.Breaks.size()) - 1;
  const int countV = static_cast<int>(data.SpansV.Breaks.size()) - 1;
  std::vector<double> bendU(countU, 0.0), bendV(countV, 0.0);
  for (int j = 0; j < countV; ++j)
  {
    for (int i = 0; i < countU; ++i)
    {
      const Vec2& bend = bends[data.FirstPatch + j * countU + i];
      bendU[i] = std::max(bendU[i], bend.x());
      bendV[j] = std::max(bendV[j], bend.y());
    }
  }
  grid = Grid();
  DivideDirection(data.SpansU, bendU, flatness, least, grid.BlockU, grid.DivisionsU, grid.BreaksU);
  DivideDirection(data.SpansV, bendV, flatness, least, grid.BlockV, grid.DivisionsV, grid.BreaksV);
  grid.CountU = static_cast<int>(grid.BreaksU.size()) - 1;
  grid.CountV = static_cast<int>(grid.BreaksV.size()) - 1;
}

void SurfaceBlocks::Build(const SurfaceModel& model, const std::vector<Vec2>& bends)
{
  constexpr double Flat = 0.15;
  constexpr std::size_t Affordable = 20000;
  const int faces = static_cast<int>(model.Faces.size());
  // Small faces among many are not worth more than one block: their edges are never far.
  const int least = std::clamp(static_cast<int>(std::sqrt(4096.0 / faces)), 1, 8);
  double flatness = Flat;
  std::size_t count = 0;
  for (int attempt = 0; attempt < 4; ++attempt, flatness *= 1.5)
  {
    this->Grids.assign(faces, Grid());
    count = 0;
    for (int face = 0; face < faces; ++face)
    {
      Grid& grid = this->Grids[face];
      this->AddGrid(model, face, bends, flatness, least, grid);
      grid.First = static_cast<int>(count);
      count += static_cast<std::size_t>(grid.CountU) * grid.CountV;
    }
    if (count <= Affordable)
    {
      break;
    }
  }
  if (count > 4 * Affordable)
  {
    this->Grids.clear(); // too rough: the search has to do
    return;
  }
  this->Blocks.reserve(count);
  std::vector<Eigen::AlignedBox3f> boxes;
  for (int face = 0; face < faces; ++face)
  {
    const Grid& grid = this->Grids[face];
    for (int j = 0; j < grid.CountV; ++j)
    {
      for (int i = 0; i < grid.CountU; ++i)
      {
        this->Blocks.push_back(this->MeasureBlock(model, face, i, j));
        const SurfaceBlock& block = this->Blocks.back();
        const Eigen::Matrix3f edges = EdgesOf(block);
        const Eigen::Vector3f middle =
          block.Center.cast<float>() + edges * (0.5f * (block.Low + block.High));
        const Eigen::Vector3f half = edges.cwiseAbs() * (0.5f * (block.High - block.Low));
        boxes.emplace_back(middle - half, middle + half);
      }
    }
  }
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  this->Nodes = BuildTree(order, boxes);
  for (TreeNode& node : this->Nodes)
  {
    for (int& child : node.Child)
    {
      child = child < 0 ? ~order[~child] : child;
    }
  }
  this->Certificates = std::make_unique<Certificate[]>(count);
}

/// Visits the nets of all patches, or parts of them, that make up a block: (patch, net, domain).
template <typename Visitor>
void SurfaceBlocks::ForPieces(
  const SurfaceModel& model, int face, int i, int j, Visitor&& visit) const
{
  const FaceData& data = model.Data[face];
  const Grid& grid = this->Grids[face];
  const int countU = static_cast<int>(data.SpansU.Breaks.size()) - 1;
  const auto spans = [](const std::vector<int>& first, int block)
  {
    int low = static_cast<int>(std::upper_bound(first.begin(), first.end(), block) - first.begin());
    const int high = low;
    for (--low; low > 0 && first[low - 1] == first[low]; --low)
    {
    }
    return std::make_pair(low, high);
  };
  const auto rangeU = spans(grid.BlockU, i);
  const auto rangeV = spans(grid.BlockV, j);
  Vec4 part[(MaximumDegree + 1) * (MaximumDegree + 1)];
  for (int spanV = rangeV.first; spanV < rangeV.second; ++spanV)
  {
    for (int spanU = rangeU.first; spanU < rangeU.second; ++spanU)
    {
      const BezierPatch& patch = model.Patches[data.FirstPatch + spanV * countU + spanU];
      const int nu = grid.DivisionsU[spanU], nv = grid.DivisionsV[spanV];
      const int cellU = nu == 1 ? 0 : i - grid.BlockU[spanU];
      const int cellV = nv == 1 ? 0 : j - grid.BlockV[spanV];
      const LeafDomain domain{ double(cellU) / nu, double(cellU + 1) / nu, double(cellV) / nv,
        double(cellV + 1) / nv };
      RestrictNet(patch, model.Net(patch), domain.S0, domain.S1, domain.T0, domain.T1, part);
      visit(patch, part, domain);
    }
  }
}

SurfaceBlock SurfaceBlocks::MeasureBlock(const SurfaceModel& model, int face, int i, int j) const
{
  const Grid& grid = this->Grids[face];
  SurfaceBlock block;
  block.Face = face;
  block.Width = Vec2(grid.BreaksU[i + 1] - grid.BreaksU[i], grid.BreaksV[j + 1] - grid.BreaksV[j]);
  block.Middle = Vec2(grid.BreaksU[i], grid.BreaksV[j]) + 0.5 * block.Width;
  const BezierPatch& patch = model.Patches[model.PatchAt(face, block.Middle.x(), block.Middle.y())];
  const double lengthU = patch.U1 - patch.U0, lengthV = patch.V1 - patch.V0;
  SurfaceJet jet;
  EvaluateBezier(patch, model.Net(patch), (block.Middle.x() - patch.U0) / lengthU,
    (block.Middle.y() - patch.V0) / lengthV, jet);
  const double a = block.Width.x() / lengthU, b = block.Width.y() / lengthV;
  block.Center = jet.S;
  Vec3 x = a * jet.Su, z = x.cross(b * jet.Sv);
  x = x.norm() > 0 ? x.normalized() : Vec3::UnitX();
  z -= z.dot(x) * x;
  z = z.norm() > 0 ? z.normalized() : x.unitOrthogonal();
  const Vec3 y = z.cross(x);
  block.X = x.cast<float>();
  block.Y = y.cast<float>();
  block.Z = z.cast<float>();
  block.Xu = static_cast<float>(a * jet.Su.dot(x));
  block.Xv = static_cast<float>(b * jet.Sv.dot(x));
  block.Yv = static_cast<float>(b * jet.Sv.dot(y));
  const auto local = [&](const Vec3& d) -> Vec3 { return Vec3(x.dot(d), y.dot(d), z.dot(d)); };
  block.UU = local(a * a * jet.Suu).cast<float>();
  block.UV = local(a * b * jet.Suv).cast<float>();
  block.VV = local(b * b * jet.Svv).cast<float>();
  // A collapsed block needs some shape.
  block.Xu = std::max(block.Xu, 1e-30f);
  block.Yv = std::max(block.Yv, 1e-6f * std::abs(block.Xv) + 1e-30f);
  const Vec3 acrossV = block.AcrossV().cast<double>();
  Vec3 low = Vec3::Constant(HUGE_VAL), high = -low;
  this->ForPieces(model, face, i, j,
    [&](const BezierPatch& piece, const Vec4* net, const LeafDomain&)
    {
      const int size = (piece.DegreeU + 1) * (piece.DegreeV + 1);
      for (int k = 0; k < size; ++k)
      {
        const Vec3 offset = net[k].head<3>() / net[k].w() - jet.S;
        const Vec3 d(acrossV.dot(offset), y.dot(offset), z.dot(offset));
        low = low.cwiseMin(d);
        high = high.cwiseMax(d);
      }
    });
  // Rounding of the axes and of what is computed from them.
  const double margin = 1e-6 * (high - low).norm() + 1e-15 * block.Center.cwiseAbs().maxCoeff();
  block.Low = (low - Vec3::Constant(margin)).cast<float>();
  block.High = (high + Vec3::Constant(margin)).cast<float>();
  return block;
}

//------------------------------------------------------------------------------
// Certificates
//------------------------------------------------------------------------------

BlockReach SurfaceBlocks::MeasureReach(const SurfaceModel& model, int index) const
{
  const SurfaceBlock& block = this->Blocks[index];
  const Grid& grid = this->Grids[block.Face];
  const int i = (index - grid.First) % grid.CountU, j = (index - grid.First) / grid.CountU;
  const BezierPatch& middle =
    model.Patches[model.PatchAt(block.Face, block.Middle.x(), block.Middle.y())];
  const double weight = middle.Rational
    ? BezierWeight(middle, model.Net(middle),
        (block.Middle.x() - middle.U0) / (middle.U1 - middle.U0),
        (block.Middle.y() - middle.V0) / (middle.V1 - middle.V0))
    : 1.0;
  Eigen::Matrix3d axes;
  axes << block.X.transpose().cast<double>(), block.Y.transpose().cast<double>(),
    block.Z.transpose().cast<double>();
  BlockBounds bounds(
    block.Center, axes, weight * Vec3(block.Xu, 0, 0), weight * Vec3(block.Xv, block.Yv, 0));
  bool mixed = false;
  this->ForPieces(model, block.Face, i, j,
    [&](const BezierPatch& patch, const Vec4* net, const LeafDomain& domain)
    {
      mixed = mixed || patch.Rational != middle.Rational;
      bounds.Add(patch.DegreeU, patch.DegreeV, net,
        block.Width.x() / ((patch.U1 - patch.U0) * (domain.S1 - domain.S0)),
        block.Width.y() / ((patch.V1 - patch.V0) * (domain.T1 - domain.T0)));
    });
  // Patches of constant weight are divided by it: beside others the net is not smooth.
  return mixed ? BlockReach() : BlockReach(bounds);
}

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

double SurfaceBlocks::ClearanceOf(const SurfaceModel& model, int index) const
{
  std::atomic<float>& known = this->Certificates[index].Clearance;
  float clearance = known.load(std::memory_order_relaxed);
  if (clearance < 0)
  {
    // Each ring proves its own distance: a wide one keeps others off, a narrow one is more convex.
    double best = 0;
    for (double ring : { 0.0, 0.5, 1.0 })
    {
      best = std::max(best, this->MeasureClearance(model, index, ring));
    }
    clearance = static_cast<float>(0.999 * best);
    known.store(clearance, std::memory_order_relaxed);
  }
  return clearance;
}

namespace
{

/// Extents of a block along unit vectors from the centre of another.
struct Extents
{
  Eigen::Vector3f Middle, Half;
  Extents(const SurfaceBlock& frame, const Eigen::Vector3f& firstAxis, const SurfaceBlock& other)
  {
    const Eigen::Vector3f d = (other.Center - frame.Center).cast<float>();
    const Eigen::Matrix3f edges = EdgesOf(other);
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
 * How far from the surface a point with its foot in the block may be and still be nearer to the
 * foot than to all of the other block. With v = Q - F and the normal n at F the sphere through Q
 * that touches at F has the radius |v|^2 / (2 n.v).
 */
double FreeOf(const SurfaceBlock& block, const SurfaceBlock& other, double tilt)
{
  const Eigen::Vector3f first = block.AcrossV();
  const Extents own(block, first, block), extents(block, first, other);
  const Eigen::Vector3f offset = (extents.Middle - own.Middle).cwiseAbs();
  const Eigen::Vector3f gap = (offset - own.Half - extents.Half).cwiseMax(0.0f);
  const Eigen::Vector3f most = offset + own.Half + extents.Half;
  const double across = std::max(gap.x(), gap.y());
  const double squared = across * across + gap.z() * gap.z();
  const Eigen::Matrix3f edges = EdgesOf(block);
  const double rise =
    most.z() + tilt * (most.x() * edges.col(0).norm() + most.y() * edges.col(1).norm());
  return std::max({ 0.5 * std::sqrt(squared), across / (1 + tilt), 0.5 * squared / rise });
}

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

/**
 * The distance within which a foot in the block is the closest point. On the rectangle of the block
 * and its neighbours the distance is convex as long as the point stays within the reach of each
 * of them; all other blocks are kept off by FreeOf.
 */
double SurfaceBlocks::MeasureClearance(const SurfaceModel& model, int index, double ring) const
{
  const SurfaceBlock& block = this->Blocks[index];
  const Grid& grid = this->Grids[block.Face];
  const int i = (index - grid.First) % grid.CountU, j = (index - grid.First) / grid.CountU;
  const double sizeU = block.Xu, sizeV = std::hypot(block.Xv, block.Yv);
  const double wide = ring * std::max(sizeU, sizeV);
  int i0, i1, j0, j1;
  FindRing(grid.BreaksU, i, wide * block.Width.x() / sizeU, i0, i1);
  FindRing(grid.BreaksV, j, wide * block.Width.y() / sizeV, j0, j1);
  if (!this->IsSmooth(model, block.Face, { i0, i1, j0, j1 }))
  {
    return 0;
  }
  const BlockReach own = this->ReachOf(model, index);
  double clearance = HUGE_VAL;
  for (int n = j0; n < j1; ++n)
  {
    for (int m = i0; m < i1; ++m)
    {
      const int other = grid.First + m + n * grid.CountU;
      const SurfaceBlock& around = this->Blocks[other];
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
  const TreePoint center(block.Center);
  const Extents extents(block, block.X, block);
  const double radius = (extents.Middle.cwiseAbs() + extents.Half).norm();
  std::vector<int> stack{ 0 };
  while (!stack.empty() && clearance > 0)
  {
    const TreeNode& node = this->Nodes[stack.back()];
    stack.pop_back();
    const Eigen::Array4f distances = center.SquaredDistances(node);
    for (int c = 0; c < 4; ++c)
    {
      const int child = node.Child[c];
      if (child == TreeNode::Empty || std::sqrt(distances[c]) - radius >= 2 * clearance)
      {
        continue;
      }
      if (child >= 0)
      {
        stack.push_back(child);
        continue;
      }
      const int other = ~child, m = (other - grid.First) % grid.CountU,
                n = (other - grid.First) / grid.CountU;
      const bool around =
        this->Blocks[other].Face == block.Face && m >= i0 && m < i1 && n >= j0 && n < j1;
      if (!around)
      {
        clearance = std::min(clearance, FreeOf(block, this->Blocks[other], own.Tilt));
      }
    }
  }
  return std::max(0.0, std::min(clearance, 1e30));
}

//------------------------------------------------------------------------------
// Queries
//------------------------------------------------------------------------------

int SurfaceBlocks::BlockAt(int face, int spanU, int spanV, double s, double t) const
{
  const Grid& grid = this->Grids[face];
  const int nu = grid.DivisionsU[spanU], nv = grid.DivisionsV[spanV];
  const int i = grid.BlockU[spanU] + std::clamp(static_cast<int>(s * nu), 0, nu - 1);
  const int j = grid.BlockV[spanV] + std::clamp(static_cast<int>(t * nv), 0, nv - 1);
  return grid.First + i + j * grid.CountU;
}

/// Down the tree to the nearest child each time: mostly the right block or one beside it.
int SurfaceBlocks::NearBlock(const Vec3& p) const
{
  const Eigen::Vector3f q = p.cast<float>();
  int index = 0;
  for (;;)
  {
    const TreeNode& node = this->Nodes[index];
    Eigen::Array4f distance = Eigen::Array4f::Zero(), toMiddle = Eigen::Array4f::Zero();
    for (int axis = 0; axis < 3; ++axis)
    {
      const Eigen::Array4f below = node.Low[axis] - q[axis], above = q[axis] - node.High[axis];
      const Eigen::Array4f e = below.max(above).max(0.0f);
      distance += e * e;
      toMiddle += (below - above) * (below - above);
    }
    distance += 0.05f * toMiddle;
    int best;
    distance.minCoeff(&best);
    const int child = node.Child[best];
    if (child < 0)
    {
      return ~child;
    }
    index = child;
  }
}

namespace
{

/// Two Newton steps on the quadratic model of a block; its parameters.
Eigen::Vector2f ModelFoot(const SurfaceBlock& b, const Vec3& p)
{
  const Eigen::Vector3f d = (p - b.Center).cast<float>();
  const Eigen::Vector3f x(b.X.dot(d), b.Y.dot(d), b.Z.dot(d));
  float t = x.y() / b.Yv, s = (x.x() - b.Xv * t) / b.Xu;
  constexpr float Far = 2;
  for (int k = 0; k < 2; ++k)
  {
    s = std::clamp(s, -Far, Far);
    t = std::clamp(t, -Far, Far);
    const Eigen::Vector3f su = s * b.UU + t * b.UV, sv = s * b.UV + t * b.VV;
    const Eigen::Vector3f u(b.Xu + su.x(), su.y(), su.z()), v(b.Xv + sv.x(), b.Yv + sv.y(), sv.z());
    Eigen::Vector3f r = 0.5f * (s * su + t * sv) - x;
    r.x() += b.Xu * s + b.Xv * t;
    r.y() += b.Yv * t;
    const float f = u.dot(r), g = v.dot(r);
    const float a = u.dot(u) + r.dot(b.UU), c = v.dot(v) + r.dot(b.VV);
    const float m = u.dot(v) + r.dot(b.UV), det = a * c - m * m;
    if (!(a > 0) || !(det > 0.01f * a * c))
    {
      break;
    }
    s += (m * g - c * f) / det;
    t += (m * f - a * g) / det;
  }
  return Eigen::Vector2f(std::clamp(s, -Far, Far), std::clamp(t, -Far, Far));
}

/// A place on a face: knot spans and the parameters of the patch there.
struct FacePlace
{
  int SpanU, SpanV;
  double S, T;
};

/// Moves a parameter that has left its span into the right one; false beyond the last.
bool EnterSpan(const KnotSpans& spans, int& span, double& x)
{
  const int last = static_cast<int>(spans.Breaks.size()) - 2;
  if (!(std::abs(x) < 8))
  {
    return false;
  }
  while (x < 0 || x > 1)
  {
    const int next = span + (x < 0 ? -1 : 1);
    if (next < 0 || next > last)
    {
      return false;
    }
    const double* breaks = spans.Breaks.data();
    const double ratio = (breaks[span + 1] - breaks[span]) / (breaks[next + 1] - breaks[next]);
    x = x < 0 ? 1 + x * ratio : (x - 1) * ratio;
    span = next;
  }
  return true;
}

/// The span and the parameter in it of u, held to the face; the search starts from a guess.
void LocateSpan(const KnotSpans& spans, double u, int& span, double& x)
{
  const int last = static_cast<int>(spans.Breaks.size()) - 2;
  const double* breaks = spans.Breaks.data();
  const double length = breaks[last + 1] - breaks[0];
  span = std::clamp(static_cast<int>((last + 1) * ((u - breaks[0]) / length)), 0, last);
  if (u < breaks[span] || u > breaks[span + 1])
  {
    span = spans.Find(u);
  }
  x = std::clamp((u - breaks[span]) / (breaks[span + 1] - breaks[span]), 0.0, 1.0);
}

/// Newton over the patches of a face; false if it leaves the face or does not converge.
bool FollowFace(
  const SurfaceModel& model, int face, const Vec3& p, FacePlace& x, SurfacePoint& foot)
{
  constexpr int MaximumSteps = 10;
  constexpr double Small = 2e-8; // the step after one this small is below rounding
  const FaceData& data = model.Data[face];
  const int countU = static_cast<int>(data.SpansU.Breaks.size()) - 1;
  double before = 0; // the last step, 0 where it tells nothing
  for (int step = 0; step < MaximumSteps; ++step)
  {
    const int index = data.FirstPatch + x.SpanV * countU + x.SpanU;
    const BezierPatch& patch = model.Patches[index];
    SurfaceJet jet;
    EvaluateBezier(patch, model.Net(patch), x.S, x.T, jet);
    const Vec3 r = jet.S - p;
    const double f = jet.Su.dot(r), g = jet.Sv.dot(r);
    const double e = jet.Su.squaredNorm(), h = jet.Sv.squaredNorm();
    const double a = e + r.dot(jet.Suu), c = h + r.dot(jet.Svv);
    const double b = jet.Su.dot(jet.Sv) + r.dot(jet.Suv), det = a * c - b * b;
    if (!(a > 0 && c > 0 && det > 1e-4 * a * c))
    {
      return false;
    }
    const double ds = (b * g - c * f) / det, dt = (b * f - a * g) / det;
    const double length = std::max(std::abs(ds), std::abs(dt));
    const double s = x.S + ds, t = x.T + dt;
    // Newton's error goes like the square, with a factor that the last two steps show.
    const bool last =
      length < Small || (length < 1e-6 && length * length * length < 1e-17 * before * before);
    const bool stays = s >= 0 && s <= 1 && t >= 0 && t <= 1;
    if (last && stays)
    {
      x.S = s;
      x.T = t;
      foot.Patch = index;
      foot.S = s;
      foot.T = t;
      foot.Point = jet.S + ds * jet.Su + dt * jet.Sv + (0.5 * ds * ds) * jet.Suu +
        (ds * dt) * jet.Suv + (0.5 * dt * dt) * jet.Svv;
      foot.Squared = (foot.Point - p).squaredNorm();
      foot.Normal =
        (jet.Su + ds * jet.Suu + dt * jet.Suv).cross(jet.Sv + ds * jet.Suv + dt * jet.Svv);
      return true;
    }
    x.S = s;
    x.T = t;
    before = stays ? length : 0;
    if (!EnterSpan(data.SpansU, x.SpanU, x.S) || !EnterSpan(data.SpansV, x.SpanV, x.T))
    {
      return false;
    }
  }
  return false;
}

/// Squared distance from p to the skew box of a block, never too large.
float SquaredDistanceToBlock(const SurfaceBlock& block, const Vec3& p)
{
  const Eigen::Vector3f d = (p - block.Center).cast<float>();
  const float slack = 4e-7f * d.cwiseAbs().sum();
  const Eigen::Vector3f x(block.AcrossV().dot(d), block.Y.dot(d), block.Z.dot(d));
  const Eigen::Array3f gap =
    ((block.Low - x).cwiseMax(x - block.High).array() - slack).cwiseMax(0.0f);
  // The first two axes are askew: only the longer of their gaps counts.
  const float across = std::max(gap[0], gap[1]);
  return (across * across + gap[2] * gap[2]) * (1 - 1e-6f);
}

}

/**
 * True if no other point of the surface is certainly nearer to p than a foot in a block: the blocks
 * that reach into the ball about p up to the foot lie in a rectangle over which the distance to p
 * is convex.
 */
bool SurfaceBlocks::IsClosest(
  const SurfaceModel& model, const Vec3& p, const SurfacePoint& foot, int index) const
{
  const int face = this->Blocks[index].Face;
  const Grid& grid = this->Grids[face];
  const auto columnOf = [&grid](int block) { return (block - grid.First) % grid.CountU; };
  const auto rowOf = [&grid](int block) { return (block - grid.First) / grid.CountU; };
  const int column = columnOf(index), row = rowOf(index);
  BlockRange range{ column, column + 1, row, row + 1 };
  const TreePoint point(p);
  int stack[TreeStackSize];
  int size = 0;
  stack[size++] = 0;
  while (size > 0)
  {
    const TreeNode& node = this->Nodes[stack[--size]];
    const Eigen::Array4f distances = point.SquaredDistances(node);
    for (int c = 0; c < 4; ++c)
    {
      const int child = node.Child[c];
      if (child == TreeNode::Empty || distances[c] > foot.Squared)
      {
        continue;
      }
      if (child >= 0)
      {
        stack[size++] = child;
      }
      else if (SquaredDistanceToBlock(this->Blocks[~child], p) <= foot.Squared)
      {
        if (this->Blocks[~child].Face != face)
        {
          return false;
        }
        range.Add(columnOf(~child), rowOf(~child));
      }
    }
  }
  return this->IsSmooth(model, face, range) && this->IsConvex(model, p, foot.Point, face, range);
}

/// Whether the distance to p is convex over the blocks, as BlockReach tells.
bool SurfaceBlocks::IsConvex(const SurfaceModel& model, const Vec3& p, const Vec3& foot, int face,
  const BlockRange& range) const
{
  constexpr float Most = 0.9999f; // the rest is for rounding
  const Grid& grid = this->Grids[face];
  for (int j = range.FirstV; j < range.EndV; ++j)
  {
    for (int i = range.FirstU; i < range.EndU; ++i)
    {
      const int index = grid.First + i + j * grid.CountU;
      const SurfaceBlock& block = this->Blocks[index];
      const BlockReach reach = this->ReachOf(model, index);
      const Eigen::Vector3f d = (p - block.Center).cast<float>();
      const Eigen::Vector3f x(block.X.dot(d), block.Y.dot(d), block.Z.dot(d));
      if (!(reach.Cost.dot(x.cwiseAbs()) < Most) ||
        !((foot - block.Center).norm() < Most * reach.Radius))
      {
        return false;
      }
    }
  }
  return true;
}

bool SurfaceBlocks::FindFoot(const SurfaceModel& model, const Vec3& p, SurfacePoint& start) const
{
  if (this->Grids.empty())
  {
    return false;
  }
  FacePlace place;
  int face;
  if (start.Patch >= 0)
  {
    const BezierPatch& patch = model.Patches[start.Patch];
    face = patch.Face;
    LocateSpan(model.Data[face].SpansU, patch.U(start.S, start.T), place.SpanU, place.S);
    LocateSpan(model.Data[face].SpansV, patch.V(start.S, start.T), place.SpanV, place.T);
  }
  else
  {
    const SurfaceBlock& block = this->Blocks[this->NearBlock(p)];
    face = block.Face;
    const Vec2 uv = block.Middle + block.Width.cwiseProduct(ModelFoot(block, p).cast<double>());
    LocateSpan(model.Data[face].SpansU, uv.x(), place.SpanU, place.S);
    LocateSpan(model.Data[face].SpansV, uv.y(), place.SpanV, place.T);
  }
  SurfacePoint foot;
  if (!FollowFace(model, face, p, place, foot))
  {
    return false;
  }
  start = foot;
  const int block = this->BlockAt(face, place.SpanU, place.SpanV, place.S, place.T);
  const double clearance = this->ClearanceOf(model, block);
  return foot.Squared < clearance * clearance || this->IsClosest(model, p, foot, block);
}

}
