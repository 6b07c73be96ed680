/**
 * @file Rescue.h
 * @brief The values of the cell array Rescue: how the validity ladder saved an element.
 */
#ifndef Rescue_h
#define Rescue_h

#include "TrimBand.h"

namespace trim
{

enum class Rescue : unsigned char
{
  None = 0,
  Relaxation = 1, ///< the nodes round it moved
  Treatment = 2,  ///< the other treatment of pentahedra
  Correction = 3, ///< the other correction type
  Fate = 4,       ///< its column, or one beside it, was kept or eliminated against its volume
  Left = 5        ///< its nodes were left off the surface
};

inline Rescue RescueBy(Rung rung)
{
  switch (rung)
  {
    case Rung::Treatment:
      return Rescue::Treatment;
    case Rung::Correction:
      return Rescue::Correction;
    case Rung::FateFirst:
    case Rung::Fate:
    case Rung::FateAround:
      return Rescue::Fate;
    case Rung::Left:
      return Rescue::Left;
    default:
      return Rescue::None;
  }
}

/// How a column was saved, or another one by it.
inline Rescue RescueOfColumn(const TrimmedBand& trimmed, int column)
{
  const Rescue rung = RescueBy(trimmed.RescuedBy[column]);
  return rung == Rescue::None && trimmed.AgainstVolume[column] ? Rescue::Fate : rung;
}

/// The last rung of an element of the band; of one that went, that of its column.
inline Rescue RescueOf(const TrimBand& near, int element)
{
  const Rescue byColumn = RescueOfColumn(near.Trimmed, near.Structure.Column[element]);
  const bool relaxed =
    near.Trimmed.Kept[element] && !near.Trimmed.Relaxed.empty() && near.Trimmed.Relaxed[element];
  return byColumn == Rescue::None && relaxed ? Rescue::Relaxation : byColumn;
}

}

#endif
