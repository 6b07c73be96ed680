/**
 * @file BandQuality.h
 * @brief Which elements of the trimmed band are invalid, or below the quality floor.
 */
#ifndef BandQuality_h
#define BandQuality_h

#include "Remembered.h"
#include "TrimmedBand.h"
#include "TrimmingSurface.h"

#include <memory>
#include <vector>

namespace trim
{

/// Whether an element of the input that is inside out or without volume is so in a shape, too.
bool StaysInvalid(const Band& band, int element, const ElementPoints& points, int count);

/// The touched elements that are invalid as they came, ascending.
std::vector<int> FindStillInvalid(const Band& band, const TrimmedBand& trimmed);

/**
 * The touched elements with an edge that has less than LeastEdgeShare of its length left,
 * ascending. Those of an inserted layer are measured by the nearest two nodes of the element on
 * which they stand.
 */
std::vector<int> FindShortEdged(const Band& band, const TrimmedBand& trimmed);

/// What an element is measured by.
enum class Measure
{
  Shape, ///< its scaled Jacobian
  Worth  ///< edges that vanish, too; see ElementWorth.h
};

class BandQuality
{
public:
  /**
   * @param treatment what counts as valid: with degenerated pentahedra a Jacobian that is positive
   * in the whole element, with distributed ones not negative, else positive at the integration
   * points; of wedges always in the whole element.
   * @param floor scaled Jacobian that touched elements have to reach; 0: none. Those that came
   * below it have to keep 0.2, if they had that.
   * @param measure what is compared with the floor.
   */
  BandQuality(
    const Band& band, Optimization treatment, double floor, Measure measure = Measure::Shape)
    : TheBand(band)
    , Treatment(treatment)
    , Floor(floor)
    , By(measure)
    , Before(std::make_shared<ElementsBefore>(band.NumberOfElements()))
  {
  }

  /// The same by another floor and measure.
  BandQuality With(double floor, Measure measure) const
  {
    BandQuality other = *this;
    other.Floor = floor;
    other.By = measure;
    return other;
  }

  /// The same, which tells of elements that leave the border of the model too.
  BandQuality WithBorder(const nurbs::TrimmingSurface& surface) const
  {
    BandQuality other = *this;
    other.Surface = &surface;
    return other;
  }

  double GetFloor() const { return this->Floor; }

  /// Kept elements that the trim made invalid, ascending.
  std::vector<int> FindInvalid(const TrimmedBand& trimmed) const;
  /// The same where it is known of all that are not asked, by element.
  /// @param others what was invalid, as far as it is not asked; ascending.
  std::vector<int> FindInvalid(const TrimmedBand& trimmed, const std::vector<char>& asked,
    const std::vector<int>& others) const;

  /// Touched elements below the floor that holds for them; the shape of those with a straight
  /// corner is exempt, unless all were to become wedges.
  /// @param asked by element; empty: all.
  std::vector<int> FindBelowFloor(
    const TrimmedBand& trimmed, const std::vector<char>& asked = {}) const;

  /// Touched elements worth less than this, and than what they were before.
  std::vector<int> FindShortOf(const TrimmedBand& trimmed, double worth) const;

  /// The smallest scaled Jacobian in a column, if these nodes went only part of their way; -1
  /// if another element at them fell below the floor, or farther below it.
  double LowestIfLeft(const TrimmedBand& trimmed, const Columns& columns, int column,
    const std::vector<int>& nodes, double way) const;

  struct Shortage
  {
    double Sum = 0;     ///< by how much elements miss the floor
    double Largest = 0; ///< by how much the worst one does
  };
  Shortage MeasureShortage(const TrimmedBand& trimmed) const;

  /// Whether an element becomes invalid by taking a shape.
  bool Spoils(int element, const ElementPoints& points, int count) const;

  /// Whether its scaled Jacobian falls below the floor by it.
  bool FallsBelowFloor(int element, const ElementPoints& points, int count) const;

  /// Whether it goes across a bend of the border; see HasBridge. False without a border.
  bool LeavesBorder(
    int element, const std::array<int, 8>& node, const ElementPoints& points, int count) const;

  /// Touched elements that do, ascending.
  /// @param asked by element; empty: all.
  std::vector<int> FindLeavingBorder(
    const TrimmedBand& trimmed, const std::vector<char>& asked = {}) const;

private:
  /// Of an element as it came.
  struct Size
  {
    double Volume;
    double ShortestDistance; ///< between any two of its nodes
    double LongestEdge;
  };
  struct Standard
  {
    double ScaledJacobian;
    bool Invalid; ///< it is not held to anything
  };
  struct ElementsBefore
  {
    explicit ElementsBefore(int count)
      : Sizes(count)
      , Standards(count)
    {
    }
    Remembered<Size> Sizes;
    Remembered<Standard> Standards;
  };

  template <typename Asked>
  std::vector<int> FindInvalid(const TrimmedBand& trimmed, const Asked& isAsked) const;
  const Size& SizeBefore(int element) const;
  const Standard& StandardBefore(int element) const;
  double FloorOf(int element) const;
  double MeasureOf(const TrimmedBand& trimmed, int element, const FinalElement& final) const;
  bool IsBelowFloor(int element, double measured) const;
  bool IsExempt(const TrimmedBand& trimmed, int element) const;

  const Band& TheBand;
  Optimization Treatment;
  double Floor;
  Measure By;
  const nurbs::TrimmingSurface* Surface = nullptr; ///< null: what leaves the border is as good
  std::shared_ptr<const ElementsBefore> Before;    ///< of all that were made from one
};

}

#endif
