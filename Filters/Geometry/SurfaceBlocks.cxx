#include "SurfaceBlocks.h"

#include "BezierEvaluation.h"
#include "BlockDirection.h"
#include "SurfaceModel.h"

#include <algorithm>
#include <cmath>

namespace nurbs
{
//------------------------------------------------------------------------------
// Construction
//------------------------------------------------------------------------------

void SurfaceBlocks::AddGrid(const SurfaceModel& model, int face,
  const std::vector<PatchShape>& shapes, const BlockLimits& limits, Grid& grid) const
{
  const FaceData& data = model.Data[face];
  BlockDirection u(data.SpansU), v(data.SpansV);
  for (int j = 0; j < v.NumberOfSpans(); ++j)
  {
    for (int i = 0; i < u.NumberOfSpans(); ++i)
    {
      const int patch = data.PatchOf(i, j);
      u.Bend[i] = std::max(u.Bend[i], shapes[patch].Bend.x());
      v.Bend[j] = std::max(v.Bend[j], shapes[patch].Bend.y());
      u.Length[i] += shapes[patch].Size.x() / v.NumberOfSpans();
      v.Length[j] += shapes[patch].Size.y() / u.NumberOfSpans();
    }
  }
  u.Divide(limits);
  v.Divide(limits);
  const double blockU = u.LengthOfBlocks(), blockV = v.LengthOfBlocks();
  u.BendSlender(limits, blockV);
  v.BendSlender(limits, blockU);
  u.Divide(limits);
  v.Divide(limits);
  grid.CountU = u.NumberOfBlocks();
  grid.CountV = v.NumberOfBlocks();
  grid.LengthU = u.LengthOfBlocks();
  grid.LengthV = v.LengthOfBlocks();
  grid.BlockU = std::move(u.First);
  grid.BlockV = std::move(v.First);
  grid.DivisionsU = std::move(u.Divisions);
  grid.DivisionsV = std::move(v.Divisions);
  grid.BreaksU = std::move(u.Breaks);
  grid.BreaksV = std::move(v.Breaks);
}

/// @return how many blocks there are.
std::size_t SurfaceBlocks::Divide(
  const SurfaceModel& model, const std::vector<PatchShape>& shapes, const BlockLimits& limits)
{
  const int faces = static_cast<int>(model.Faces.size());
  this->Grids.assign(faces, Grid());
  std::size_t count = 0;
  for (int face = 0; face < faces; ++face)
  {
    Grid& grid = this->Grids[face];
    this->AddGrid(model, face, shapes, limits, grid);
    grid.First = static_cast<int>(count);
    count += static_cast<std::size_t>(grid.CountU) * grid.CountV;
  }
  return count;
}

/// As few blocks as it takes to know enough of each.
std::size_t SurfaceBlocks::ChooseGrids(
  const SurfaceModel& model, const std::vector<PatchShape>& shapes)
{
  constexpr double Flat = 0.15;
  // A block is measured as a whole, and those about it with it, though few points may be near it.
  constexpr int FewSpans = 8;
  constexpr std::size_t Affordable = 20000;
  // Small faces among many are not worth more than one block: their edges are never far.
  const int least = std::clamp(static_cast<int>(std::sqrt(4096.0 / model.Faces.size())), 1, 8);
  const std::size_t few = std::max<std::size_t>(1024, 16 * model.Faces.size());
  BlockLimits limits{ Flat, MostSlender, least, FewSpans };
  std::size_t count = this->Divide(model, shapes, limits);
  // A long strip has few blocks across it, or very many.
  for (bool fewer = true; fewer && count > few;)
  {
    const BlockLimits wider{ limits.Flatness, 2 * limits.Slender, limits.Least, limits.MostSpans };
    std::vector<Grid> before = std::move(this->Grids);
    const std::size_t next = this->Divide(model, shapes, wider);
    fewer = next < count - count / 8;
    if (fewer)
    {
      limits = wider;
      count = next;
    }
    else
    {
      this->Grids = std::move(before);
    }
  }
  for (int attempt = 0; attempt < 3 && count > Affordable; ++attempt)
  {
    limits.Flatness *= 1.5;
    limits.MostSpans *= 2;
    count = this->Divide(model, shapes, limits);
  }
  if (count > 4 * Affordable)
  {
    this->Grids.clear(); // too rough: the search has to do
    return 0;
  }
  return count;
}

void SurfaceBlocks::Build(const SurfaceModel& model, const std::vector<PatchShape>& shapes)
{
  const std::size_t count = this->ChooseGrids(model, shapes);
  if (count == 0)
  {
    return;
  }
  std::vector<Eigen::AlignedBox3f> boxes;
  boxes.reserve(count);
  for (int face = 0; face < static_cast<int>(this->Grids.size()); ++face)
  {
    const Grid& grid = this->Grids[face];
    for (int j = 0; j < grid.CountV; ++j)
    {
      for (int i = 0; i < grid.CountU; ++i)
      {
        boxes.push_back(this->BoxOfBlock(model, shapes, face, i, j));
      }
    }
  }
  this->Nodes = BuildTreeOfGrids({ this->Grids.begin(), this->Grids.end() }, boxes);
  this->Blocks = SparseVector<SurfaceBlock>(count);
  this->Certificates = std::make_unique<Certificate[]>(count);
}

/// Visits the nets of all patches, or parts of them, that make up a block: (patch, net, domain).
template <typename Visitor>
void SurfaceBlocks::ForPieces(
  const SurfaceModel& model, int face, int i, int j, Visitor&& visit) const
{
  const FaceData& data = model.Data[face];
  const Grid& grid = this->Grids[face];
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
      const BezierPatch& patch = model.Patches[data.PatchOf(spanU, spanV)];
      const int nu = grid.DivisionsU[spanU], nv = grid.DivisionsV[spanV];
      const int cellU = nu == 1 ? 0 : i - grid.BlockU[spanU];
      const int cellV = nv == 1 ? 0 : j - grid.BlockV[spanV];
      const PartDomain domain{ double(cellU) / nu, double(cellU + 1) / nu, double(cellV) / nv,
        double(cellV + 1) / nv };
      visit(patch, NetOfPart(patch, model.Net(patch), domain, part), domain);
    }
  }
}

Eigen::AlignedBox3f SurfaceBlocks::BoxOfBlock(
  const SurfaceModel& model, const std::vector<PatchShape>& shapes, int face, int i, int j) const
{
  Eigen::AlignedBox3f box;
  this->ForPieces(model, face, i, j,
    [&](const BezierPatch& patch, const Vec4* net, const PartDomain&)
    {
      box.extend(net == model.Net(patch)
          ? shapes[&patch - model.Patches.data()].Box
          : BoxOfNet(net, (patch.DegreeU + 1) * (patch.DegreeV + 1)));
    });
  return box;
}

const SurfaceBlock& SurfaceBlocks::BlockOf(const SurfaceModel& model, int index) const
{
  SurfaceBlock& block = this->Blocks[index];
  this->Turns.Measure(this->Certificates[index].Measured, index,
    [&]
    {
      this->MeasureBlock(model, index, block);
      return true;
    });
  return block;
}

namespace
{

/// The axes and the quadratic model of a block.
/// @param jet of the surface at the middle, by parameters of width 1 over the block.
void SetModel(const SurfaceJet& jet, SurfaceBlock& block)
{
  block.Center = jet.S;
  const Vec3 x = jet.Su.norm() > 0 ? jet.Su.normalized() : Vec3::UnitX();
  Vec3 z = jet.Su.cross(jet.Sv);
  z -= z.dot(x) * x;
  z = z.norm() > 0 ? z.normalized() : x.unitOrthogonal();
  const Vec3 y = z.cross(x);
  block.X = x.cast<float>();
  block.Y = y.cast<float>();
  block.Z = z.cast<float>();
  block.Xu = static_cast<float>(jet.Su.dot(x));
  block.Xv = static_cast<float>(jet.Sv.dot(x));
  block.Yv = static_cast<float>(jet.Sv.dot(y));
  const auto local = [&](const Vec3& d) -> Vec3 { return Vec3(x.dot(d), y.dot(d), z.dot(d)); };
  block.UU = local(jet.Suu).cast<float>();
  block.UV = local(jet.Suv).cast<float>();
  block.VV = local(jet.Svv).cast<float>();
  // A collapsed block needs some shape.
  block.Xu = std::max(block.Xu, 1e-30f);
  block.Yv = std::max(block.Yv, 1e-6f * std::abs(block.Xv) + 1e-30f);
}

/// Bounds of points along three directions.
class SkewBounds
{
public:
  SkewBounds(const Vec3& center, const SurfaceBlock& block)
    : Center(center)
  {
    this->Axes << block.AcrossV().cast<double>().transpose(), block.Y.cast<double>().transpose(),
      block.Z.cast<double>().transpose(), Vec3::Zero().transpose();
  }
  void Add(const Vec3& point)
  {
    const Vec3 offset = point - this->Center;
    const Vec4 d = this->Axes.col(0) * offset.x() + this->Axes.col(1) * offset.y() +
      this->Axes.col(2) * offset.z();
    this->Lowest = this->Lowest.cwiseMin(d);
    this->Highest = this->Highest.cwiseMax(d);
  }
  /// With a margin for the rounding of the axes and of what is computed from them.
  void Store(SurfaceBlock& block) const
  {
    const Vec3 low = this->Lowest.head<3>(), high = this->Highest.head<3>();
    const double margin = 1e-6 * (high - low).norm() + 1e-15 * this->Center.cwiseAbs().maxCoeff();
    block.Low = (low - Vec3::Constant(margin)).cast<float>();
    block.High = (high + Vec3::Constant(margin)).cast<float>();
  }

private:
  const Vec3 Center;
  Eigen::Matrix<double, 4, 3> Axes; ///< columns of four: Eigen takes two registers for each
  Vec4 Lowest = Vec4::Constant(HUGE_VAL), Highest = Vec4::Constant(-HUGE_VAL);
};

}

void SurfaceBlocks::MeasureBlock(const SurfaceModel& model, int index, SurfaceBlock& block) const
{
  const auto next = std::upper_bound(this->Grids.begin(), this->Grids.end(), index,
    [](int number, const Grid& grid) { return number < grid.First; });
  const Grid& grid = *(next - 1);
  const int face = static_cast<int>(&grid - this->Grids.data());
  const int i = grid.ColumnOf(index), j = grid.RowOf(index);
  block.Face = face;
  block.Width = Vec2(grid.BreaksU[i + 1] - grid.BreaksU[i], grid.BreaksV[j + 1] - grid.BreaksV[j]);
  block.Middle = Vec2(grid.BreaksU[i], grid.BreaksV[j]) + 0.5 * block.Width;
  const BezierPatch& patch = model.Patches[model.PatchAt(face, block.Middle.x(), block.Middle.y())];
  const Vec2 middle = patch.Local(block.Middle);
  SurfaceJet jet;
  EvaluateBezier(patch, model.Net(patch), middle.x(), middle.y(), jet);
  const double a = block.Width.x() / (patch.U1 - patch.U0);
  const double b = block.Width.y() / (patch.V1 - patch.V0);
  SetModel(
    { jet.S, a * jet.Su, b * jet.Sv, a * a * jet.Suu, a * b * jet.Suv, b * b * jet.Svv }, block);
  SkewBounds bounds(jet.S, block);
  this->ForPieces(model, face, i, j,
    [&](const BezierPatch& piece, const Vec4* net, const PartDomain&)
    {
      const int size = (piece.DegreeU + 1) * (piece.DegreeV + 1);
      std::for_each(net, net + size, [&](const Vec4& c) { bounds.Add(CartesianPoint(c)); });
    });
  bounds.Store(block);
}

BlockReach SurfaceBlocks::MeasureReach(const SurfaceModel& model, int index) const
{
  const SurfaceBlock& block = this->BlockOf(model, index);
  const Grid& grid = this->Grids[block.Face];
  const int i = grid.ColumnOf(index), j = grid.RowOf(index);
  const BezierPatch& middle =
    model.Patches[model.PatchAt(block.Face, block.Middle.x(), block.Middle.y())];
  const Vec2 local = middle.Local(block.Middle);
  const double weight =
    middle.Rational ? BezierWeight(middle, model.Net(middle), local.x(), local.y()) : 1.0;
  Eigen::Matrix3d axes;
  axes << block.X.transpose().cast<double>(), block.Y.transpose().cast<double>(),
    block.Z.transpose().cast<double>();
  BlockBounds bounds(
    block.Center, axes, weight * Vec3(block.Xu, 0, 0), weight * Vec3(block.Xv, block.Yv, 0));
  bool mixed = false;
  this->ForPieces(model, block.Face, i, j,
    [&](const BezierPatch& patch, const Vec4* net, const PartDomain& domain)
    {
      mixed = mixed || patch.Rational != middle.Rational;
      bounds.Add(patch.DegreeU, patch.DegreeV, net,
        block.Width.x() / ((patch.U1 - patch.U0) * (domain.S1 - domain.S0)),
        block.Width.y() / ((patch.V1 - patch.V0) * (domain.T1 - domain.T0)));
    });
  // Patches of constant weight are divided by it: beside others the net is not smooth.
  return mixed ? BlockReach() : BlockReach(bounds);
}

}
