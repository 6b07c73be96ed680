#include "SurfaceModel.h"

#include "BezierDecomposition.h"
#include "BezierEvaluation.h"
#include "CurveOnPatch.h"
#include "PatchTiles.h"
#include "ShellOrientation.h"

#include <algorithm>
#include <cmath>

namespace nurbs
{

SurfaceModel::SurfaceModel(std::vector<NurbsSurface> faces, double gapTolerance, double widestGap)
  : Faces(std::move(faces))
{
  Box3 hull;
  for (const NurbsSurface& face : this->Faces)
  {
    hull.extend(BoxOf(face));
  }
  this->Origin = hull.center();
  this->Scale = std::max(hull.diagonal().norm(), 1e-300);
  this->Resolution = 1e-12 * this->Scale +
    4e-16 * std::max(hull.min().cwiseAbs().maxCoeff(), hull.max().cwiseAbs().maxCoeff());
  this->Gap = std::max(gapTolerance, 0.0) * (1 + 1e-9) + this->Resolution;
  this->WidestGap = std::max(widestGap, this->Gap);
  this->Data.resize(this->Faces.size());
  Shapes shapes;
  for (std::size_t face = 0; face < this->Faces.size(); ++face)
  {
    this->AddFace(static_cast<int>(face), shapes);
  }
  this->AddLeaves(shapes);
  OrientShells(*this);
}

int SurfaceModel::PatchAt(int face, double u, double v) const
{
  const FaceData& data = this->Data[face];
  return data.PatchOf(data.SpansU.Find(u), data.SpansV.Find(v));
}

int SurfaceModel::LeafAt(const BezierPatch& patch, double s, double t) const
{
  const int i = std::clamp(static_cast<int>(s * patch.GridU), 0, patch.GridU - 1);
  const int j = std::clamp(static_cast<int>(t * patch.GridV), 0, patch.GridV - 1);
  return patch.FirstLeaf + j * patch.GridU + i;
}

void SurfaceModel::AddFace(int face, Shapes& shapes)
{
  FaceData& data = this->Data[face];
  const NurbsSurface& surface = this->Faces[face];
  data.FirstPatch = static_cast<int>(this->Patches.size());
  data.Loops = TrimLoops(surface);
  // Each patch is measured as it is made, while its net is in the cache.
  Decompose(surface, face, this->Origin, data.SpansU, data.SpansV, this->Patches, this->Nets,
    [&shapes](const BezierPatch& patch, const Vec4* net)
    { shapes.push_back(MeasurePatch(patch, net)); });
  this->AddTrimCurves(face, shapes);
}

namespace
{

/// Where an edge between t0 and t1 crosses knots, and these two, rising.
void CutAtKnots(const FaceData& data, const TrimLoops::Edge& edge, double t0, double t1,
  std::vector<double>& cuts)
{
  cuts.assign({ t0, t1 });
  for (int axis = 0; axis < 2; ++axis)
  {
    const double d = edge.To[axis] - edge.From[axis];
    for (double knot : axis == 0 ? data.SpansU.Breaks : data.SpansV.Breaks)
    {
      const double t = d != 0 ? (knot - edge.From[axis]) / d : -1;
      if (t > t0 + 1e-12 && t < t1 - 1e-12)
      {
        cuts.push_back(t);
      }
    }
  }
  std::sort(cuts.begin(), cuts.end());
}

}

/// Every loop edge, parted at the knots it crosses, becomes Bezier curves on the patches.
void SurfaceModel::AddTrimCurves(int face, Shapes& shapes)
{
  const FaceData& data = this->Data[face];
  const Vec2 low = data.Low(), high = data.High();
  // Points a rounding error outside the rectangle are meant to be on its border.
  const Vec2 slack = 1e-9 * (high - low);
  std::vector<double> cuts;
  for (const TrimLoops::Edge& edge : data.Loops.AllEdges())
  {
    double t0, t1;
    if (!ClipToRectangle(edge.From, edge.To, low - slack, high + slack, t0, t1))
    {
      continue;
    }
    CutAtKnots(data, edge, t0, t1, cuts);
    const auto at = [&](double t) -> Vec2
    { return (edge.From + t * (edge.To - edge.From)).cwiseMax(low).cwiseMin(high); };
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
    {
      this->AddTrimCurve(face, edge, at(cuts[k]), at(cuts[k + 1]), shapes);
    }
  }
}

/// A part of a loop edge within one patch; none where it is one point.
void SurfaceModel::AddTrimCurve(
  int face, const TrimLoops::Edge& edge, const Vec2& from, const Vec2& to, Shapes& shapes)
{
  if (from == to)
  {
    return;
  }
  const Vec2 middle = 0.5 * (from + to);
  const BezierPatch patch = this->Patches[this->PatchAt(face, middle.x(), middle.y())];
  const auto local = [&patch](const Vec2& x) -> Vec2
  { return patch.Local(x).cwiseMax(0.0).cwiseMin(1.0); };
  BezierPatch curve = CurveOnPatch(patch, local(from), local(to), this->Nets);
  const Vec4* net = this->Net(curve);
  double extent = 0;
  for (int i = 1; i <= curve.DegreeU; ++i)
  {
    extent = std::max(extent, (CartesianPoint(net[i]) - CartesianPoint(net[0])).norm());
  }
  if (extent <= this->Resolution) // along a pole
  {
    this->Nets.resize(curve.Net);
    return;
  }
  curve.Loop = edge.Loop;
  curve.LoopEdge = edge.Index;
  this->Patches.push_back(curve);
  shapes.push_back(MeasurePatch(curve, this->Net(curve)));
}

void SurfaceModel::AddLeaves(const Shapes& shapes)
{
  this->Blocks.Build(*this, shapes);
  this->ChooseGrids(shapes);
  this->RefineTrimmedGrids();
  std::size_t count = 0;
  for (BezierPatch& patch : this->Patches)
  {
    patch.FirstLeaf = static_cast<int>(count);
    count += static_cast<std::size_t>(patch.GridU) * patch.GridV;
  }
  this->TrimStates.assign(count, TrimState::Inside);
  this->FindTrimStates();
  this->HangLeaves(shapes);
  this->LeafBoxes = SparseVector<LeafBox>(this->LeafOrder.size());
  this->Leaves = SparseVector<Leaf>(count);
}

/// The tree of all leaves that are not outside the loops.
void SurfaceModel::HangLeaves(const Shapes& shapes)
{
  const std::vector<Eigen::AlignedBox3f> boxes = this->BoxLeaves(shapes);
  const auto addLeaves = [&](const BezierPatch& patch)
  {
    for (int k = patch.FirstLeaf; k < patch.FirstLeaf + patch.GridU * patch.GridV; ++k)
    {
      if (this->TrimStates[k] != TrimState::Outside)
      {
        this->LeafOrder.push_back(k);
        this->Bounds.extend(boxes[k].min().cast<double>());
        this->Bounds.extend(boxes[k].max().cast<double>());
      }
    }
  };
  constexpr std::size_t Many = 20000;
  if (boxes.size() < Many)
  {
    std::for_each(this->Patches.begin(), this->Patches.end(), addLeaves);
    this->Nodes = BuildTree(this->LeafOrder, boxes);
  }
  else
  {
    const PatchTiles tiles = TilePatches(*this, shapes);
    std::vector<int> ends;
    int next = 0;
    for (const int end : tiles.Ends)
    {
      const std::size_t before = this->LeafOrder.size();
      for (; next < end; ++next)
      {
        addLeaves(this->Patches[tiles.Patches[next]]);
      }
      if (this->LeafOrder.size() > before)
      {
        ends.push_back(static_cast<int>(this->LeafOrder.size()));
      }
    }
    this->Nodes = BuildTreeOfGroups(this->LeafOrder, ends, boxes);
  }
  this->Bounds.translate(this->Origin);
}

std::vector<Eigen::AlignedBox3f> SurfaceModel::BoxLeaves(const Shapes& shapes) const
{
  std::vector<Eigen::AlignedBox3f> boxes;
  boxes.reserve(this->TrimStates.size());
  Vec4 part[(MaximumDegree + 1) * (MaximumDegree + 1)];
  for (std::size_t index = 0; index < this->Patches.size(); ++index)
  {
    const BezierPatch& patch = this->Patches[index];
    if (patch.GridU * patch.GridV == 1)
    {
      boxes.push_back(shapes[index].Box);
      continue;
    }
    const int size = (patch.DegreeU + 1) * (patch.DegreeV + 1);
    for (int k = patch.FirstLeaf; k < patch.FirstLeaf + patch.GridU * patch.GridV; ++k)
    {
      boxes.push_back(BoxOfNet(NetOfPart(patch, this->Net(patch), DomainOf(patch, k), part), size));
    }
  }
  return boxes;
}

int SurfaceModel::MeasureBox(int index, LeafBox& box) const
{
  const int number = this->LeafOrder[index];
  const auto next = std::upper_bound(this->Patches.begin(), this->Patches.end(), number,
    [](int leaf, const BezierPatch& patch) { return leaf < patch.FirstLeaf; });
  const BezierPatch& patch = *(next - 1);
  const PartDomain domain = DomainOf(patch, number);
  Vec4 part[(MaximumDegree + 1) * (MaximumDegree + 1)];
  Leaf& leaf = this->Leaves[number];
  leaf.Patch = static_cast<int>(&patch - this->Patches.data());
  MeasureLeaf(patch, domain, NetOfPart(patch, this->Net(patch), domain, part), leaf, box);
  return number + 1;
}

/// Nearly flat leaves, none too slender, but not many more of them than patches where these are
/// many.
void SurfaceModel::ChooseGrids(const Shapes& shapes)
{
  constexpr std::size_t Affordable = 50000;
  LeafLimits limits{ 0.25, MostSlender }; // beyond a flatness of about 0.5 queries get slower
  for (int attempt = 0; attempt < 4; ++attempt)
  {
    std::size_t count = 0;
    for (std::size_t k = 0; k < shapes.size(); ++k)
    {
      BezierPatch& patch = this->Patches[k];
      ChooseGrid(shapes[k], limits, patch);
      count += static_cast<std::size_t>(patch.GridU) * patch.GridV;
    }
    if (count <= std::max(Affordable, shapes.size() + shapes.size() / 2))
    {
      break;
    }
    limits.Flatness *= 1.5;
    limits.Slenderness *= 1.5;
  }
}

/// Flat patches have one leaf; those that a loop crosses need more, to leave its holes empty.
void SurfaceModel::RefineTrimmedGrids()
{
  constexpr double CellsAcross = 24;
  constexpr int Finest = 32;
  for (std::size_t k = 0; k < this->Patches.size(); ++k)
  {
    if (!this->Patches[k].Curve)
    {
      continue;
    }
    const BezierPatch& curve = this->Patches[k];
    const FaceData& data = this->Data[curve.Face];
    BezierPatch& patch = this->Patches[this->PatchAt(
      curve.Face, 0.5 * (curve.U0 + curve.U1), 0.5 * (curve.V0 + curve.V1))];
    const Vec4* net = this->Net(patch);
    const Vec3 a = BezierPoint(patch, net, 0, 0.5), b = BezierPoint(patch, net, 0.5, 0.5),
               c = BezierPoint(patch, net, 1, 0.5), d = BezierPoint(patch, net, 0.5, 0),
               e = BezierPoint(patch, net, 0.5, 1);
    const double lengthU = (b - a).norm() + (c - b).norm();
    const double lengthV = (b - d).norm() + (e - b).norm();
    const double cell =
      std::max(lengthU * data.SpansU.Count(), lengthV * data.SpansV.Count()) / CellsAcross;
    const auto divisions = [=](double length)
    { return std::clamp(static_cast<int>(std::ceil(length / cell)), 1, Finest); };
    patch.GridU = std::max(patch.GridU, divisions(lengthU));
    patch.GridV = std::max(patch.GridV, divisions(lengthV));
  }
}

void SurfaceModel::FindTrimStates()
{
  // Leaves touched by a loop are crossed; the others are inside or outside as a whole.
  for (const BezierPatch& curve : this->Patches)
  {
    if (!curve.Curve)
    {
      continue;
    }
    const Vec2 a(curve.U0, curve.V0), b(curve.U1, curve.V1), middle = 0.5 * (a + b);
    const BezierPatch& patch = this->Patches[this->PatchAt(curve.Face, middle.x(), middle.y())];
    const Vec2 p = patch.Local(a), q = patch.Local(b);
    const auto cell = [](double x, int n)
    { return std::clamp(static_cast<int>(std::floor(x * n)), 0, n - 1); };
    const Vec2 low = p.cwiseMin(q).array() - 1e-9, high = p.cwiseMax(q).array() + 1e-9;
    for (int j = cell(low.y(), patch.GridV); j <= cell(high.y(), patch.GridV); ++j)
    {
      for (int i = cell(low.x(), patch.GridU); i <= cell(high.x(), patch.GridU); ++i)
      {
        const Vec2 cellLow(i / double(patch.GridU) - 1e-9, j / double(patch.GridV) - 1e-9);
        const Vec2 cellHigh(
          (i + 1) / double(patch.GridU) + 1e-9, (j + 1) / double(patch.GridV) + 1e-9);
        double t0, t1;
        if (ClipToRectangle(p, q, cellLow, cellHigh, t0, t1))
        {
          this->TrimStates[patch.FirstLeaf + j * patch.GridU + i] = TrimState::Crossed;
        }
      }
    }
  }
  for (const BezierPatch& patch : this->Patches)
  {
    const bool trimmed = !this->Data[patch.Face].Loops.Empty();
    if (!patch.Curve && (trimmed || this->Faces.size() > 1)) // to compare their areas
    {
      for (int k = patch.FirstLeaf; k < patch.FirstLeaf + patch.GridU * patch.GridV; ++k)
      {
        this->FindTrimState(patch, k);
      }
    }
  }
}

/// Of a leaf that may be crossed; and adds its area.
void SurfaceModel::FindTrimState(const BezierPatch& patch, int leaf)
{
  FaceData& data = this->Data[patch.Face];
  const PartDomain d = DomainOf(patch, leaf);
  const double s = 0.5 * (d.S0 + d.S1), t = 0.5 * (d.T0 + d.T1);
  double share = 1.0;
  if (this->TrimStates[leaf] == TrimState::Crossed)
  {
    share = 0.5;
  }
  else if (!data.Loops.Empty() && !data.Loops.Inside(patch.U(s, t), patch.V(s, t)))
  {
    this->TrimStates[leaf] = TrimState::Outside;
    share = 0.0;
  }
  if (this->Faces.size() > 1)
  {
    SurfaceJet jet;
    EvaluateBezier(patch, this->Net(patch), s, t, jet);
    data.Area += share * jet.Su.cross(jet.Sv).norm() * (d.S1 - d.S0) * (d.T1 - d.T0);
  }
}

}
