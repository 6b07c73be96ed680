/**
 * @file Decision.h
 * @brief Which elements stay (paper, section 2.3: V^e against 50 %), one decision a column.
 *
 * In a sheet of several layers under a surface that is not quite perpendicular, element by
 * element decisions would leave facets between layers on the new boundary, whose nodes cannot
 * all move to the surface. So the elements of a column fall together, on their total volume.
 */
#ifndef Decision_h
#define Decision_h

#include "Band.h"
#include "Columns.h"
#include "LastAsked.h"
#include "MovingNodes.h"
#include "TrimmingSurface.h"
#include "VolumeShares.h"

#include <cstdint>
#include <map>
#include <vector>

namespace trim
{

/// Fate that the validity ladder has set for a column against its volume.
enum class Fate : signed char
{
  ByVolume,
  Keep,
  Eliminate
};

/**
 * Decides by volume or by the fate set, then mends what cannot become a mesh: elements that
 * would touch the rest by an edge or a node only; and, where nodes move, elements that would
 * collapse because all their nodes go to one place of the surface, or that lose a whole facet of
 * the border of the mesh.
 *
 * It is taken again and again, under other fates; what was found out about elements and nodes is
 * kept, so one thread at a time may take it. What it is given must outlive it.
 */
class Decision
{
public:
  /// @param threshold EliminationFraction: a column goes when its share is larger.
  /// @param movesNodes false for type I, where no element is deformed.
  Decision(const Band& band, const Columns& columns, const VolumeShares& shares,
    const nurbs::TrimmingSurface& surface, double threshold, bool movesNodes);

  /// @param fate by column (index: smallest element of the column).
  /// @return for each band element whether it is kept.
  const std::vector<char>& Take(const std::vector<Fate>& fate);

  /// See MovingNodes.
  const std::vector<char>& FindMovingNodes(const std::vector<char>& kept)
  {
    return this->Moving.Find(kept);
  }

  /// Whether the share of its column alone keeps an element.
  bool StaysByVolume(int e) const;

  /// Of a column, ascending.
  Band::Range ElementsOf(int column) const
  {
    return { this->Members.begin(column), this->Members.end(column) };
  }

private:
  std::vector<char> TakeAnew(const std::vector<Fate>& fate);
  double RoundingOf(int column) const;
  void FindInnerNodes();
  void SetColumn(int column, char to, std::vector<char>& kept) const;
  /// By column the pillars, in a block the nodes, of sides on the border that lie beyond the
  /// surface.
  using LostSides = std::map<int, std::vector<int>>;
  void EliminateLostBorders(const std::vector<Fate>& fate, std::vector<char>& kept) const;
  LostSides FindLostSides(const std::vector<Fate>& fate, const std::vector<char>& kept) const;
  std::vector<int> FindBacked(const LostSides& lost, const std::vector<char>& kept) const;
  bool EliminateCollapsing(const std::vector<Fate>& fate, std::vector<char>& kept);
  bool Collapses(int e);
  bool MakesPinch(int node, const std::vector<char>& kept) const;
  bool IsPinched(std::size_t inner, const std::vector<char>& kept);
  bool MendPinches(bool onlyEliminate, std::vector<char>& kept);
  bool MendPinch(int node, bool onlyEliminate, std::vector<char>& kept) const;

  const Band& TheBand;
  const Columns& TheColumns;
  const VolumeShares& Shares;
  const nurbs::TrimmingSurface& Surface;
  double Threshold;
  bool MovesNodes;
  Band::Lists Members;
  MovingNodes Moving;
  std::vector<char> Whole;
  std::vector<int> InnerNodes;
  static constexpr signed char Unknown = -1;
  std::vector<signed char> Collapsing;   ///< by element
  std::vector<std::uint64_t> NotPinched; ///< by inner node: elements kept when it was none, as bits
  LastAsked<std::vector<Fate>, std::vector<char>> Taken;
};

}

#endif
