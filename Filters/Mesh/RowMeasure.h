/**
 * @file RowMeasure.h
 * @brief Volumes and boxes of the cells of a row, several at a time, as many as the processor has
 * room for.
 */
#ifndef RowMeasure_h
#define RowMeasure_h

#include "CellRow.h"

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
constexpr int CellsPerRowBox = 8;

/// The largest of many cells, lane by lane.
struct RowSizes
{
  using Lanes = std::array<double, CellsPerRowBox>;

  alignas(64) std::array<Lanes, 3> Sides{};
  alignas(64) Lanes Diagonal{}; ///< squared
  /// Of terms that each coordinate is in: finite only if all of these are.
  alignas(64) Lanes Sum{};
};

struct RowBox
{
  double Low[3], High[3];
};

/// @param volumes of the cells, >= 0.
/// @param boxes of the first and the second half of the row.
void MeasureRow(const RowPoints& points, int axis, double* volumes,
  RowBox (&boxes)[CellRow::Cells / CellsPerRowBox], RowSizes& sizes);

}

#endif
