/**
 * @file ElementsAstray.h
 * @brief Elements whose fate is not that of their side of the surface, farther than the border
 * reaches.
 */
#ifndef ElementsAstray_h
#define ElementsAstray_h

#include "Shortcomings.h"
#include "TrimBand.h"
#include "TrimmingSurface.h"

#include <array>
#include <cstddef>
#include <vector>

namespace trim
{

/// What is not where the cut has it, whatever the nodes do.
struct ElementsAstray
{
  /// Whole elements that went though they lie on the kept side, or stayed beyond, farther than one
  /// edge from the surface: the sum of their squared distances, in edges.
  double Squares = 0.0;
  /// Of all that went or stayed so, those that share no node with one of the other fate: no border
  /// reaches them.
  std::size_t Lost = 0;

  /// How much more or less is kept than lies on the kept side, in cut elements.
  double Volume = 0.0;
  std::size_t Cut = 0; ///< elements

  /// Whether more than corners and chords of the surface went or stayed: what a border on the
  /// surface reaches round is not lost, and the volume tells.
  /// @param share of the cut elements that may be missed.
  bool MissesWhole(double share = LargestMiss) const
  {
    return this->Volume > FewCorners + share * static_cast<double>(this->Cut) ||
      (this->Lost > 0 && this->Volume > 0.5 * static_cast<double>(this->Lost));
  }
  bool Any() const { return this->Squares > 0.0 || this->MissesWhole(); }
  double Sum() const { return this->Squares + SquaresOfElement * this->Volume; }

  /// Elements that a single corner of the model may take with it.
  static constexpr double FewCorners = 2.0;
  /// Share of the cut elements; nine of ten trims that leave no node miss less than a third of it.
  static constexpr double LargestMiss = 0.1;
};

/// Of an element as the mesh came, measured as it is after the trim: the six tetrahedra of the
/// shares have other volumes where its faces are warped, as those of an earlier trim are. With a
/// layer: of one that was not inserted, without it.
double VolumeBefore(const Band& band, int e);

/// How much more than what lies on the kept side is kept of an element. Nothing is due of an
/// inserted one, whose share is that of the element it stands on.
/// @param whole its volume before.
double ExcessOf(const TrimBand& near, int e, double whole);

/// The volume alone, of a trim whose border is the surface.
/// @param volumes of the elements before.
/// @param without by element those that do not count; empty: all count.
ElementsAstray MeasureVolumeAstray(
  const TrimBand& near, const std::vector<double>& volumes, const std::vector<char>& without = {});

/// Of each node, whether an eliminated element has it, and whether a kept one.
std::array<std::vector<char>, 2> NodesByFate(const TrimBand& near);

/// By the volumes of the shares, as the decision is made.
ElementsAstray FindElementsAstray(
  const TrimBand& near, const nurbs::TrimmingSurface& surface, Correction type);

}

#endif
