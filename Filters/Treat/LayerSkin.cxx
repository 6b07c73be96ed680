#include "LayerSkin.h"

#include "SortUnique.h"
#include "Status.h"

#include <algorithm>
#include <utility>

namespace trim
{
namespace
{

/// What is farther from the skin than this share of the longest edge is not off it for the layer.
constexpr double LongestReturn = 0.1;
/// What is nearer than this is on it.
constexpr double OnSkin = 1e-3;

class SkinReturn
{
public:
  SkinReturn(const Band& layered, const Columns& columns, const NodeMover& mover,
    const std::vector<char>& kept, const BandQuality& quality, TrimmedBand& trimmed)
    : Layered(layered)
    , TheColumns(columns)
    , Mover(mover)
    , Kept(kept)
    , Quality(quality)
    , Trimmed(trimmed)
    , AllKept(layered.BeforeLayer->NumberOfNodes(), NodeKeep)
  {
  }

  void Run()
  {
    const std::vector<Vec3> before = this->Trimmed.NodeMoves.Position;
    const std::vector<int> invalid = this->Quality.FindInvalid(this->Trimmed);
    this->TakeToSkin();
    for (bool changed = true; changed;)
    {
      changed = false;
      for (const int e : this->Quality.FindInvalid(this->Trimmed))
      {
        changed |=
          !std::binary_search(invalid.begin(), invalid.end(), e) && this->GoBack(e, before);
      }
    }
    this->TellFaults();
  }

private:
  void TakeToSkin()
  {
    const std::vector<int> users = CountUsers(this->Layered, this->Trimmed);
    const std::vector<char> onCut = FindBoundaryNodes(this->Layered, this->Trimmed);
    auto& moves = this->Trimmed.NodeMoves;
    for (int n = 0; n < this->Layered.NumberOfNodes(); ++n)
    {
      const bool moved = users[n] > 0 && moves.Applied[n] != Correction::None;
      // Corrected nodes behind the cut are on the surface, too.
      const bool onSurface = (onCut[n] || this->Trimmed.Moving[n]) && !moves.Left[n];
      Vec3 place;
      if (moved && this->FindPlace(n, onSurface, place))
      {
        moves.Position[n] = AsStored(this->Layered, place);
        this->Places.emplace_back(n, moves.Position[n]);
      }
    }
  }

  /// Elements below the floor, and those with a node that could not stay on the skin.
  void TellFaults()
  {
    const Band& band = *this->Layered.BeforeLayer;
    std::vector<int>& faults = this->Trimmed.BelowFloor;
    faults = this->Quality.FindBelowFloor(this->Trimmed);
    for (const auto& [n, place] : this->Places)
    {
      const double away = (this->Trimmed.NodeMoves.Position[n] - place).norm();
      if (away <= OnSkin * LongestEdgeAt(band, this->Layered.NodeOrigins[n].Index))
      {
        continue;
      }
      for (const int e : this->Layered.ElementsOfNode(n))
      {
        if (this->Trimmed.Kept[e])
        {
          faults.push_back(e);
        }
      }
    }
    SortUnique(faults);
  }

  /// Where a node belongs on the skin; false if it is on none, or on a ridge.
  bool FindPlace(int n, bool onSurface, Vec3& place) const
  {
    const Band& band = *this->Layered.BeforeLayer;
    const int origin = this->Layered.NodeOrigins[n].Index;
    const auto faces = band.FacesOfNode(origin);
    if (std::none_of(faces.begin(), faces.end(), [&band](int f) { return band.Faces[f].Exterior; }))
    {
      return false;
    }
    NodeFreedom freedom;
    freedom.Constraint = ConstrainNode(band, this->TheColumns, this->AllKept, this->Kept, origin);
    const Vec3& from = this->Trimmed.NodeMoves.Position[n];
    return freedom.Constraint.Kind == ConstraintKind::Faces &&
      this->Mover.Constrained(origin, freedom, from, onSurface, place) &&
      (place - from).norm() <= LongestReturn * LongestEdgeAt(band, origin);
  }

  bool GoBack(int e, const std::vector<Vec3>& before)
  {
    bool changed = false;
    const BandElement& element = this->Layered.Elements[e];
    for (int i = 0; i < element.Count; ++i)
    {
      Vec3& position = this->Trimmed.NodeMoves.Position[element.Node[i]];
      changed |= position != before[element.Node[i]];
      position = before[element.Node[i]];
    }
    return changed;
  }

  const Band& Layered;
  const Columns& TheColumns;
  const NodeMover& Mover;
  const std::vector<char>& Kept;
  const BandQuality& Quality;
  TrimmedBand& Trimmed;
  std::vector<unsigned char> AllKept;       ///< status of the nodes as if there were no cut
  std::vector<std::pair<int, Vec3>> Places; ///< of nodes on the skin
};

}

void ReturnToSkin(const Band& layered, const Columns& columns, const NodeMover& mover,
  const std::vector<char>& kept, const BandQuality& quality, TrimmedBand& trimmed)
{
  SkinReturn(layered, columns, mover, kept, quality, trimmed).Run();
}

}
