/**
 * @file TestLayerParts.cxx
 * @brief What an inserted layer is made by: the way behind several planes, nodes where it is left
 * out, elements of it that are, and how it is told to end.
 */
#include "CutBlock.h"
#include "DirectionBehind.h"
#include "Jacobian.h"
#include "LayerPits.h"
#include "MovingNodes.h"
#include "NodesOfElements.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

using namespace judge;
using namespace trim;

namespace
{

/// No direction of many leads farther behind the planes.
void CheckDirectionBehind()
{
  constexpr double Turn = 0.785;
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  const auto behind = [&](const std::vector<Vec3>& normals, const std::vector<Vec3>& held)
  { return FindDirectionBehind(normals, held, Turn); };
  Expect((behind({ x }, {}).Direction + x).norm() < 1e-12, "behind one plane");
  Expect(std::abs(behind({ x, y, z }, {}).Sine - std::sqrt(1.0 / 3.0)) < 1e-12, "behind a corner");
  Expect(behind({ x, y, -y, z }, {}).Sine == 0.0, "no way between planes that face each other");
  Expect((behind({ x, Vec3(x + z).normalized() }, { z }).Direction + x).norm() < 1e-12,
    "along the skin");
  // A skin that bends by 20 degrees holds in one direction, a ridge in two.
  const Vec3 bent(0.0, std::sin(0.35), std::cos(0.35));
  Expect(behind({ y }, { z, bent }).Sine > 0.9, "along a bent skin");
  Expect(behind({ y }, { z, y }).Sine == 0.0, "off a ridge");
  std::mt19937 random(5);
  std::normal_distribution<double> any;
  const auto direction = [&] { return Vec3(any(random), any(random), any(random)).normalized(); };
  int found = 0;
  for (int trial = 0; trial < 200; ++trial)
  {
    std::vector<Vec3> normals;
    for (int i = 0; i < 2 + trial % 5 + (trial % 20 == 0 ? 60 : 0); ++i)
    {
      normals.push_back((direction() + 0.8 * x).normalized());
    }
    const auto leastOf = [&normals](const Vec3& d)
    {
      double least = 1.0;
      for (const Vec3& normal : normals)
      {
        least = std::min(least, -normal.dot(d));
      }
      return least;
    };
    const DirectionBehind best = behind(normals, {});
    found += best.Sine > 0.0;
    Expect(best.Sine == 0.0 || std::abs(leastOf(best.Direction) - best.Sine) < 1e-6,
      "the sine is that of the direction");
    for (int i = 0; i < 300; ++i)
    {
      Expect(leastOf(direction()) < best.Sine + 1e-6, "another direction leads farther behind");
    }
  }
  Expect(found > 100, "there mostly is a way: " + std::to_string(found));
}

/// A block with a layer on what is kept.
struct LayeredBlock
{
  explicit LayeredBlock(const std::vector<int>& bareNodes = {})
    : Kept(
        Block.NewDecision().Take(std::vector<Fate>(Block.Mesh.NumberOfElements(), Fate::ByVolume)))
    , Bare(Block.Mesh.NumberOfNodes(), 0)
  {
    for (const int n : bareNodes)
    {
      this->Bare[n] = 1;
    }
    this->NoRoom = this->Block.InsertLayer(this->Kept, this->Bare, this->Cells);
  }

  Band MakeBand() const
  {
    Band layered(this->Cells, 4, false);
    layered.BeforeLayer = std::make_shared<const Band>(this->Block.Mesh);
    return layered;
  }

  const CutBlock Block;
  std::vector<char> Kept, Bare;
  BandCells Cells;
  std::vector<int> NoRoom;
};

bool IsValid(const Band& band, int e)
{
  return MeasureJacobian(PointsOf(band, e), band.Elements[e].Count).Bezier > 0.0;
}

/// At a bare node the layer has no depth, and the kept elements are as they came.
void CheckBareNodes()
{
  const LayeredBlock whole;
  Expect(whole.NoRoom.empty(), "the layer has room");
  const std::vector<char> onCut = FindCutNodes(whole.Block.Mesh, whole.Kept);
  int bareOnes = 0;
  for (int n = 0; n < whole.Block.Mesh.NumberOfNodes(); n += 7)
  {
    if (!onCut[n])
    {
      continue;
    }
    const LayeredBlock block({ n });
    Expect(block.NoRoom.empty(), "the layer has room but for one node");
    const Band layered = block.MakeBand();
    int bare = 0, others = 0;
    for (int e = 0; e < layered.NumberOfElements(); ++e)
    {
      if (IsOnBareNode(layered, block.Bare, e))
      {
        ++bare;
        Expect(layered.IsInserted(e) && !IsValid(layered, e), "without depth at a bare node");
        continue;
      }
      others += layered.IsInserted(e);
      Expect(IsValid(layered, e), "all others are valid");
    }
    Expect(bare > 0 && others > bare, "only the elements at the node are");
    bareOnes += bare;
    for (int k = 0; k < layered.NumberOfNodes(); ++k)
    {
      const bool moved = layered.Point[k] != block.Block.Mesh.Point[NodeWithoutLayer(layered, k)];
      Expect(moved == (layered.IsInsertedNode(k) && NodeWithoutLayer(layered, k) != n),
        "inserted nodes give way, but for that at the bare one");
    }
  }
  Expect(bareOnes > 0, "there are nodes of the cut");
}

/// Elements of the layer go where the rest is sound, and nothing else does.
void CheckPits()
{
  const LayeredBlock block;
  const Band layered = block.MakeBand();
  const Columns columns = NoColumns(layered, {});
  TrimmedBand whole;
  whole.Moving.assign(layered.NumberOfNodes(), 0);
  whole.NodeMoves.Left.assign(layered.NumberOfNodes(), 0);
  whole.Treated.FlatCorner.assign(layered.NumberOfElements(), 0);
  std::vector<int> inserted;
  int under = -1;
  for (int e = 0; e < layered.NumberOfElements(); ++e)
  {
    whole.Kept.push_back(block.Kept[ElementWithoutLayer(layered, e)]);
    if (layered.IsInserted(e))
    {
      inserted.push_back(e);
    }
    else if (whole.Kept[e] && layered.HasInsertedNode(e))
    {
      under = e;
    }
  }
  whole.BelowFloor = inserted;
  // The first is a wedge, the last has a straight corner.
  whole.Treated.Count = 2;
  whole.Treated.Wedges.resize(1);
  whole.Treated.Wedges[0].Element = inserted.front();
  whole.Treated.FlatCorner[inserted.back()] = 1;
  int dug = 0, refused = 0;
  for (const int first : inserted)
  {
    for (const int second : inserted)
    {
      TrimmedBand pitted = whole;
      const bool sound = DigPits(layered, columns, { first, second }, pitted);
      (sound ? dug : refused)++;
      const auto gone = std::count(whole.Kept.begin(), whole.Kept.end(), 1) -
        std::count(pitted.Kept.begin(), pitted.Kept.end(), 1);
      const auto expected = sound ? 1 + (first != second) : 0;
      Expect(gone == expected && pitted.Kept[first] == !sound, "what was asked goes, or nothing");
      Expect(
        whole.BelowFloor.size() - pitted.BelowFloor.size() == static_cast<std::size_t>(expected),
        "what goes is not below the floor any more");
      const int treated = pitted.Kept[inserted.front()] + pitted.Kept[inserted.back()];
      Expect(pitted.Treated.Count == treated &&
          pitted.Treated.Wedges.size() == std::size_t(pitted.Kept[inserted.front()]) &&
          pitted.Treated.FlatCorner[inserted.back()] == pitted.Kept[inserted.back()],
        "nor a pentahedron");
      for (const int n : NodesOf(layered, { first, second }))
      {
        const bool left = sound && layered.IsInsertedNode(n);
        Expect(pitted.NodeMoves.Left[n] == left && pitted.Moving[n] == left,
          "what it stood on is left off the surface");
      }
    }
  }
  Expect(dug > 100, "most may go: " + std::to_string(dug));
  Expect(refused > 0, "two that meet in an edge may not");
  TrimmedBand same = whole;
  Expect(!DigPits(layered, columns, { inserted[0], under }, same) && same.Kept == whole.Kept,
    "an element of the mesh stays");
}

/// Who presses the red x does not wait for a layer that is relaxed.
void CheckAbort()
{
  const CutBlock block;
  const auto placesWith = [&block](double floor, bool stop)
  {
    const auto layered = block.FindLayer(floor, [stop] { return stop; });
    Expect(layered.has_value(), "the layer has room");
    return layered ? layered->Point : std::vector<Vec3>();
  };
  const std::vector<Vec3> unrelaxed = placesWith(0.0, false);
  Expect(placesWith(0.6, false) != unrelaxed, "abort: nothing to relax in the layer");
  Expect(placesWith(0.6, true) == unrelaxed, "abort: the layer is relaxed all the same");
}

}

int main()
{
  CheckDirectionBehind();
  CheckBareNodes();
  CheckPits();
  CheckAbort();
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
