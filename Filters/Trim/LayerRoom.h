/**
 * @file LayerRoom.h
 * @brief Which elements are kept, so that an inserted layer finds room on them.
 */
#ifndef LayerRoom_h
#define LayerRoom_h

#include "Columns.h"
#include "Decision.h"

#include <map>
#include <vector>

namespace trim
{

/// What it is given must outlive it.
class LayerRoom
{
public:
  /// @param reach how much of a column lies beyond the surface, at most.
  LayerRoom(const Band& band, const Columns& columns, const VolumeShares& reach);

  /**
   * Where there is no room at nodes, one or two of the columns at each go or stay instead.
   *
   * @param kept by element.
   * @param[in,out] fates by column; those that were set before stay.
   * @return false if none may change.
   */
  bool PartElsewhere(
    const std::vector<char>& kept, const std::vector<int>& nodes, std::vector<Fate>& fates) const;

private:
  std::vector<int> FindBest(
    int node, std::vector<char>& kept, const std::vector<Fate>& fates) const;
  std::vector<int> FreeColumnsAt(int node, const std::vector<Fate>& fates) const;
  bool LacksRoom(const std::vector<char>& kept, int node) const;
  bool GivesRoom(
    const std::vector<int>& turned, std::vector<char>& kept, std::map<int, bool>& lacking) const;
  std::vector<int> NodesOf(const std::vector<int>& columns) const;
  Band::Range Members(int e) const;
  void Turn(int e, std::vector<char>& kept) const;

  const Band& TheBand;
  const Columns& TheColumns;
  const VolumeShares& Reach;
  Band::Lists ElementsOf; ///< by column
};

}

#endif
