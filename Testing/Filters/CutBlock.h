/**
 * @file CutBlock.h
 * @brief A band for tests of parts of the stages.
 */
#ifndef CutBlock_h
#define CutBlock_h

#include "Decision.h"
#include "Expect.h"
#include "InsertedLayer.h"
#include "LayerSearch.h"
#include "MoverMemory.h"
#include "NodeMover.h"
#include "SampleSurfaces.h"
#include "Status.h"
#include "ValidityLadder.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace judge
{

using namespace trim;

/// A block of unit cubes, cut by a leaning plane.
class CutBlock
{
public:
  static constexpr int Side = 6; ///< elements along an edge

  CutBlock()
    : Mesh(CellsOfBlock(), 4, false)
    , Surface({ samples::Plane(
                Vec3(Middle, Middle, Middle) - 20 * (AlongU + AlongV), 40 * AlongU, 40 * AlongV) },
        0.0)
    , Structure(NoColumns(this->Mesh, {}))
  {
    std::array<int, 2> missed;
    Expect(MeasureShares(this->Mesh, this->Structure, this->Surface, 0.0, this->Shares, missed),
      "the plane cuts the block");
  }

  Decision NewDecision() const
  {
    return Decision(this->Mesh, this->Structure, this->Shares, this->Surface, 0.5, true);
  }

  NodeMover MoverTo(const nurbs::TrimmingSurface& surface) const
  {
    return NodeMover(this->Mesh, this->Structure, surface, 1e-8);
  }

  NodeMover MoverWith(const std::shared_ptr<MoverMemory>& memory) const
  {
    return NodeMover(this->Mesh, this->Structure, this->Surface, 1e-8, false, memory);
  }

  bool SlidingMatters(const MoverMemory& memory) const
  {
    return trim::SlidingMatters(this->Mesh, this->Structure, memory);
  }

  /// See InsertLayer.
  std::vector<int> InsertLayer(
    const std::vector<char>& kept, const std::vector<char>& bare, BandCells& cells) const
  {
    return trim::InsertLayer(
      this->Mesh, this->Structure, this->MoverTo(this->Surface), kept, bare, cells);
  }

  /// The band with a layer before any correction; none: there is no room.
  std::optional<Band> FindLayer(double qualityFloor, AbortCheck aborted) const
  {
    TrimBand near(this->Mesh);
    near.Structure = this->Structure;
    near.Shares = this->Shares;
    BandOptions options;
    options.Ladder.QualityFloor = qualityFloor;
    const BandTask task{ this->Surface, 1e-8, options };
    const auto before = std::make_shared<const Band>(this->Mesh);
    return LayerSearch(near, before, false, { 0.5, false }, task, std::move(aborted)).Find();
  }

  TrimCase Case() const
  {
    return { this->Mesh, this->Structure, this->Shares, this->Surface, 1e-8 };
  }

  TrimmedBand Climb(const Promise& promises) const
  {
    const TrimCase given = this->Case();
    LadderPosition position;
    return ClimbLadder(given, LadderOptions(), position, { promises, {} });
  }

  const Band Mesh;

private:
  static constexpr double Middle = 0.5 * Side + 0.07;
  static inline const Vec3 Normal = Vec3(0.8, 0.48, 0.36), AlongU = Vec3(-0.6, 0.64, 0.48),
                           AlongV = Vec3(0.0, -0.6, 0.8);

  static unsigned char StatusAt(const Vec3& p)
  {
    return Normal.dot(p - Vec3(Middle, Middle, Middle)) > 0.0 ? NodeEliminate : NodeKeep;
  }

  static BandCells CellsOfBlock()
  {
    BandCells cells;
    const auto node = [](int i, int j, int k) { return i + (Side + 1) * (j + (Side + 1) * k); };
    for (int n = 0; n < node(0, 0, Side + 1); ++n)
    {
      const Vec3 p(n % (Side + 1), n / (Side + 1) % (Side + 1), n / (Side + 1) / (Side + 1));
      cells.Nodes.push_back({ n, p, StatusAt(p) });
    }
    for (int c = 0; c < Side * Side * Side; ++c)
    {
      const int i = c % Side, j = c / Side % Side, k = c / Side / Side;
      BandCells::Cell cell;
      cell.Global = c;
      cell.Count = 8;
      cell.Node = { node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k), node(i, j + 1, k),
        node(i, j, k + 1), node(i + 1, j, k + 1), node(i + 1, j + 1, k + 1),
        node(i, j + 1, k + 1) };
      unsigned char status[8];
      std::transform(cell.Node.begin(), cell.Node.end(), status,
        [&cells](int n) { return cells.Nodes[n].Status; });
      cell.Status = StatusOfElement(status, 8);
      cell.Ring = cell.Status == ElementToTreat ? 0 : 1;
      cells.Cells.push_back(cell);
    }
    return cells;
  }

  const nurbs::TrimmingSurface Surface;
  const Columns Structure;
  VolumeShares Shares;
};

}

#endif
