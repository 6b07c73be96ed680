#include "RowSort.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace trim
{
namespace
{

/// Coordinates are rounded to this many steps of the extent; rows are this many steps apart.
constexpr double Steps = 2147483648.0;
constexpr std::uint64_t RowGap = 2147;

/// Sorts by the upper 32 bits: three passes of eleven.
void RadixSort(std::vector<std::uint64_t>& items)
{
  std::vector<std::uint64_t> other(items.size());
  for (const int shift : { 32, 43, 54 })
  {
    std::vector<std::size_t> start(2049, 0);
    for (const std::uint64_t item : items)
    {
      ++start[((item >> shift) & 2047) + 1];
    }
    std::partial_sum(start.begin(), start.end(), start.begin());
    for (const std::uint64_t item : items)
    {
      other[start[(item >> shift) & 2047]++] = item;
    }
    items.swap(other);
  }
}

/// Row of each point along one axis; returns how many rows there are.
int FindRows(const std::vector<nurbs::Vec3>& points, const nurbs::Vec3& axis, std::vector<int>& row)
{
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const auto& point : points)
  {
    const double value = point.dot(axis);
    low = std::min(low, value);
    high = std::max(high, value);
  }
  const double scale = high > low ? (Steps - 1.0) / (high - low) : 0.0;
  std::vector<std::uint64_t> items(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const double value = std::clamp((points[i].dot(axis) - low) * scale, 0.0, Steps - 1.0);
    items[i] = (static_cast<std::uint64_t>(value) << 32) | i;
  }
  RadixSort(items);
  int current = 0;
  for (std::size_t i = 0; i < items.size(); ++i)
  {
    if (i > 0 && (items[i] >> 32) - (items[i - 1] >> 32) > RowGap)
    {
      ++current;
    }
    row[items[i] & 0xffffffffu] = current;
  }
  return current + 1;
}

}

std::vector<int> SortByRows(const std::vector<nurbs::Vec3>& points, const Eigen::Matrix3d& axes)
{
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::vector<int> row(points.size());
  std::vector<int> next(points.size());
  // The innermost axis first: each pass keeps the order of the one before within a row.
  for (const int axis : { 2, 1, 0 })
  {
    const int rows = FindRows(points, axes.col(axis), row);
    std::vector<int> start(rows + 1, 0);
    for (const int r : row)
    {
      ++start[r + 1];
    }
    std::partial_sum(start.begin(), start.end(), start.begin());
    for (const int i : order)
    {
      next[start[row[i]]++] = i;
    }
    order.swap(next);
  }
  return order;
}

}
