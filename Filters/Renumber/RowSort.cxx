#include "RowSort.h"

#include "Runs.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <vector>

namespace trim
{
namespace
{

/// Coordinates are rounded to this many steps of the extent; rows are this many steps apart.
constexpr double Steps = 2147483648.0;
constexpr std::uint64_t RowGap = 2147;

/// Items are a step in the upper and an index in the lower half.
std::uint64_t StepIn(std::uint64_t item)
{
  return item >> 32;
}

/// Steps in so few that there is no gap among them.
constexpr int GroupShift = 42;
static_assert(std::uint64_t(1) << (GroupShift - 32) <= RowGap, "groups are narrower than a gap");
std::uint64_t GroupOf(std::uint64_t item)
{
  return item >> GroupShift;
}

/// Sorts by groups: two passes of eleven bits.
void RadixSort(PageVector<std::uint64_t>& items)
{
  PageVector<std::uint64_t> other(items.size());
  for (const int shift : { GroupShift, GroupShift + 11 })
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

/// Coordinates along an axis, rounded to steps of their extent.
class Rounding
{
public:
  Rounding(double low, double high)
    : Low(low)
    , Scale(high > low ? (Steps - 1.0) / (high - low) : 0.0)
  {
  }
  std::uint64_t StepOf(double value) const
  {
    return static_cast<std::uint64_t>(
      std::clamp((value - this->Low) * this->Scale, 0.0, Steps - 1.0));
  }

private:
  double Low, Scale;
};

/// The different values of a regular mesh's coordinates, which are few.
class FewValues
{
public:
  /// Number of a value in the order of their coming, -1: there are too many.
  int Add(double value)
  {
    if (!this->Values.empty() && value == this->Values[this->Last])
    {
      return this->Last;
    }
    std::uint64_t bits;
    const double positive = value + 0.0; // no negative zero
    std::memcpy(&bits, &positive, sizeof(bits));
    std::size_t slot = (bits * 0x9e3779b97f4a7c15u) >> (64 - Bits);
    while (this->Slots[slot] >= 0 && this->Values[this->Slots[slot]] != value)
    {
      slot = (slot + 1) % this->Slots.size();
    }
    if (this->Slots[slot] < 0)
    {
      if (this->Values.size() >= Most)
      {
        return -1;
      }
      this->Slots[slot] = static_cast<int>(this->Values.size());
      this->Values.push_back(value);
    }
    return this->Last = this->Slots[slot];
  }

  std::vector<double> Values;

private:
  static constexpr int Bits = 14;
  static constexpr std::size_t Most = std::size_t(1) << (Bits - 2);
  PageVector<int> Slots = PageVector<int>(std::size_t(1) << Bits, -1);
  int Last = 0;
};

/// Rows of items; returns how many.
int FindRows(PageVector<std::uint64_t>& items, PageVector<int>& row)
{
  RadixSort(items);
  int current = 0;
  std::uint64_t highest = 0; // of the group before
  for (std::size_t begin = 0, end; begin < items.size(); begin = end)
  {
    std::uint64_t low = StepIn(items[begin]);
    std::uint64_t high = low;
    for (end = begin; end < items.size() && GroupOf(items[end]) == GroupOf(items[begin]); ++end)
    {
      low = std::min(low, StepIn(items[end]));
      high = std::max(high, StepIn(items[end]));
    }
    current += begin > 0 && low - highest > RowGap;
    highest = high;
    for (std::size_t i = begin; i < end; ++i)
    {
      row[items[i] & 0xffffffffu] = current;
    }
  }
  return current + 1;
}

/// The rows by those of the values, if these are few; else 0.
int FindRowsOfFew(
  const PageVector<nurbs::Vec3>& points, const nurbs::Vec3& axis, PageVector<int>& row)
{
  FewValues few;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    row[i] = few.Add(points[i].dot(axis));
    if (row[i] < 0)
    {
      return 0;
    }
  }
  const auto [low, high] = std::minmax_element(few.Values.begin(), few.Values.end());
  const Rounding rounding(*low, *high);
  PageVector<std::uint64_t> items;
  for (const double value : few.Values)
  {
    items.push_back((rounding.StepOf(value) << 32) | items.size());
  }
  PageVector<int> rowOfValue(items.size());
  const int rows = FindRows(items, rowOfValue);
  for (int& r : row)
  {
    r = rowOfValue[r];
  }
  return rows;
}

/// Row of each point along one axis; returns how many rows there are.
int FindRows(const PageVector<nurbs::Vec3>& points, const nurbs::Vec3& axis, PageVector<int>& row)
{
  if (const int rows = FindRowsOfFew(points, axis, row))
  {
    return rows;
  }
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const nurbs::Vec3& point : points)
  {
    low = std::min(low, point.dot(axis));
    high = std::max(high, point.dot(axis));
  }
  const Rounding rounding(low, high);
  PageVector<std::uint64_t> items(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    items[i] = (rounding.StepOf(points[i].dot(axis)) << 32) | i;
  }
  return FindRows(items, row);
}

/// Sorts an order by a key of each point, below `keys`; among equals it stays as it was.
void SortByKey(const PageVector<int>& key, int keys, PageVector<int>& order)
{
  PageVector<int> start(keys + 1, 0);
  for (const int k : key)
  {
    ++start[k + 1];
  }
  std::partial_sum(start.begin(), start.end(), start.begin());
  PageVector<int> next(order.size());
  for (const int i : order)
  {
    next[start[key[i]]++] = i;
  }
  order.swap(next);
}

}

PageVector<int> SortByRows(const PageVector<nurbs::Vec3>& points, const Eigen::Matrix3d& axes)
{
  std::array<PageVector<int>, 3> row;
  std::array<int, 3> rows{};
  ForAll(
    3,
    [&](int axis)
    {
      row[axis].resize(points.size());
      rows[axis] = FindRows(points, axes.col(axis), row[axis]);
    },
    1);
  PageVector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  // The innermost axis first: each pass keeps the order of the one before within a row. Axes whose
  // rows make no more keys than there are points, about, go in one pass.
  const auto most = static_cast<std::int64_t>(2 * points.size());
  for (int inner = 2; inner >= 0;)
  {
    PageVector<int> key = std::move(row[inner]);
    std::int64_t keys = rows[inner];
    int outer = inner - 1;
    for (; outer >= 0 && keys * rows[outer] <= most; --outer)
    {
      for (std::size_t i = 0; rows[outer] > 1 && i < key.size(); ++i)
      {
        key[i] += static_cast<int>(keys) * row[outer][i];
      }
      keys *= rows[outer];
    }
    if (keys > 1)
    {
      SortByKey(key, static_cast<int>(keys), order);
    }
    inner = outer;
  }
  return order;
}

}
