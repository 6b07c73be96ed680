/**
 * @file LayerSearch.h
 * @brief What is kept of the mesh, so that a layer of new elements along the cut has room on it.
 */
#ifndef LayerSearch_h
#define LayerSearch_h

#include "BandDecision.h"
#include "Decision.h"
#include "LayerRoom.h"
#include "NodeMover.h"

#include <memory>
#include <optional>
#include <vector>

namespace trim
{

/// By whole columns in a sheet, element by element in a block: there the layer makes up for it.
Columns ColumnsForLayer(const Band& band, bool isSheet);

/// What a layer may be made like.
struct LayerKind
{
  /// How much of an element under it, in a sheet of one of its column, may lie beyond the surface.
  double LargestShare;
  /// Whether it may be left out at a few nodes, where there is no room for it or a kept element
  /// would fall below the quality floor.
  bool MayBeBare;
};

class LayerSearch
{
public:
  /// What it is given must outlive it.
  /// @param near, before see TrimWithLayer.
  /// @param isSheet whether all of it has a thickness direction.
  LayerSearch(const TrimBand& near, const std::shared_ptr<const Band>& before, bool isSheet,
    const LayerKind& kind, const BandTask& task, AbortCheck aborted);

  LayerSearch(const LayerSearch&) = delete; // the members refer to each other
  void operator=(const LayerSearch&) = delete;

  /// The band with a layer as good as it can be before any correction; none: there is no room.
  std::optional<Band> Find();

  /// Other elements at some nodes are to be kept from now on; false if there is no other choice.
  bool PartElsewhere(const std::vector<int>& nodes)
  {
    return this->Room.PartElsewhere(this->Kept, nodes, this->Fates);
  }

  /// By which what Find has kept stays so, the layer with it, and nothing else.
  VolumeShares SharesByFate(const Band& layered) const;

  /// Whether an element went, or stays, that neither its volume nor the layer's own share would
  /// have gone, or stay: to give the layer room, or with others of its column.
  bool IsAgainstVolume(int element) const;

  /// See trim::ReturnToSkin.
  void ReturnToSkin(const Band& layered, TrimmedBand& trimmed) const;

  /// Whether the layer that was found is left out anywhere.
  bool HasBareNodes() const;

private:
  std::vector<int> Insert(BandCells& cells);
  Band WithoutSpoiled(Band layered);
  std::optional<Band> FindWithBareNodes(std::vector<int> bare);
  bool FewAreBare() const;
  std::vector<int> FindSpoiling(const Band& layered) const;
  Band MakeBand(const BandCells& cells) const;
  Band Relaxed(BandCells cells) const;
  BandQuality QualityOf(const Band& layered) const;

  const TrimBand& Near;
  const std::shared_ptr<const Band>& Before;
  bool IsSheet;
  LayerKind Kind;
  const BandTask& Task;
  AbortCheck Aborted;
  Columns TheColumns;
  VolumeShares Reach; ///< of each element the largest share in its column
  Decision TheDecision;
  NodeMover Mover;
  LayerRoom Room;
  std::vector<Fate> Fates; ///< by column
  std::vector<char> Kept;  ///< by element
  std::vector<char> Bare;  ///< nodes, by node, where the layer is left out
};

}

#endif
