/**
 * @file CellMeasure.h
 * @brief Volumes and boxes of cells, several at a time, as many as the processor has room for.
 */
#ifndef CellMeasure_h
#define CellMeasure_h

#include "CellRow.h"

#include <algorithm>
#include <array>

namespace trim
{

/// The points of a row, line by line: in memory as they are if they are one after the other there.
class RowPoints
{
public:
  void Take(const CellRow& row, const double* points)
  {
    for (int i = 0; row.Counts && i < 4; ++i)
    {
      this->Lines[i] = points + 3 * row.Lines[i][0];
    }
    if (!row.Counts)
    {
      this->Copy(row, points);
    }
  }
  void Take(const CellRow& row, const float* points) { this->Copy(row, points); }

  std::array<const double*, 4> Lines;

private:
  template <typename Coordinate>
  void Copy(const CellRow& row, const Coordinate* points)
  {
    for (int i = 0; i < 4; ++i)
    {
      for (int s = 0; s <= CellRow::Cells; ++s)
      {
        for (int k = 0; k < 3; ++k)
        {
          this->Copies[i][3 * s + k] = points[3 * row.Lines[i][s] + k];
        }
      }
      this->Lines[i] = this->Copies[i].data();
    }
  }

  std::array<std::array<double, 3 * (CellRow::Cells + 1)>, 4> Copies;
};

/// Cells for which one box is made.
constexpr int CellsPerBox = 8;

/// The corners of hexahedra that are in no row, coordinate by coordinate, so that those of several
/// are side by side.
struct CellCorners
{
  double At[3][8][CellsPerBox];

  template <typename Coordinate>
  void Set(int cell, const Coordinate* points, const std::array<Id, 8>& nodes)
  {
    for (int i = 0; i < 8; ++i)
    {
      for (int k = 0; k < 3; ++k)
      {
        this->At[k][i][cell] = points[3 * nodes[i] + k];
      }
    }
  }

  /// Where there are fewer cells: the first one again.
  void FillFrom(int count)
  {
    for (auto& coordinate : this->At)
    {
      for (auto& cells : coordinate)
      {
        std::fill(cells + count, cells + CellsPerBox, cells[0]);
      }
    }
  }
};

/// The largest of many cells, lane by lane.
struct CellSizes
{
  using Lanes = std::array<double, CellsPerBox>;

  alignas(64) std::array<Lanes, 3> Sides{};
  alignas(64) Lanes Diagonal{}; ///< squared
  /// Of terms that each coordinate is in: finite only if all of these are.
  alignas(64) Lanes Sum{};
  alignas(64) Lanes LeastVolume{}; ///< below zero if one is turned inside out
};

/// The box of some cells.
struct CellBounds
{
  double Low[3], High[3];
};

/// @param volumes of the cells, >= 0.
/// @param boxes of the first and the second half of the row.
/// @param[in,out] sizes with those of the cells.
void MeasureRow(const RowPoints& points, int axis, double* volumes,
  CellBounds (&boxes)[CellRow::Cells / CellsPerBox], CellSizes& sizes);

/// The same of hexahedra that are in no row.
void MeasureCells(
  const CellCorners& corners, double (&volumes)[CellsPerBox], CellBounds& box, CellSizes& sizes);

}

#endif
