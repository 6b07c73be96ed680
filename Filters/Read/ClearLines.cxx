#include "ClearLines.h"

#include <algorithm>
#include <limits>

namespace nurbs
{
namespace
{

/// Distance of x to the closest of the sorted values.
double Clearance(const std::vector<double>& sorted, double x)
{
  auto next = std::lower_bound(sorted.begin(), sorted.end(), x);
  double clearance = std::numeric_limits<double>::infinity();
  if (next != sorted.end())
  {
    clearance = *next - x;
  }
  if (next != sorted.begin())
  {
    clearance = std::min(clearance, x - *(next - 1));
  }
  return clearance;
}

/// A line through the middle of each loop that lies between two lines: one crossing is enough to
/// have no loop within a cell.
void PartLoops(const std::vector<std::vector<Vec2>>& loops, int axis, std::vector<double>& lines)
{
  for (const std::vector<Vec2>& loop : loops)
  {
    const auto range = std::minmax_element(
      loop.begin(), loop.end(), [axis](const Vec2& a, const Vec2& b) { return a[axis] < b[axis]; });
    const double low = (*range.first)[axis];
    const double high = (*range.second)[axis];
    auto next = std::upper_bound(lines.begin(), lines.end(), low);
    if (low < high && (next == lines.end() || *next >= high || next + 1 == lines.end()))
    {
      lines.insert(next == lines.end() ? next - 1 : next, 0.5 * (low + high));
    }
  }
  std::sort(lines.begin(), lines.end());
}

/// The place for a line, less than a hundredth of the room beside it away, that is clear of the
/// sorted corners.
double ClearPlace(double line, double room, const std::vector<double>& corners)
{
  double best = line;
  for (int shift : { 0, 1, -1, 2, -2, 3, -3, 5, -5, 7, -7 })
  {
    const double trial = line + 0.001 * shift * room;
    if (Clearance(corners, trial) > Clearance(corners, best))
    {
      best = trial;
    }
    if (Clearance(corners, best) > 0.0004 * room)
    {
      break;
    }
  }
  return best;
}

}

std::vector<double> ClearLines(
  std::vector<double> lines, const std::vector<std::vector<Vec2>>& loops, int axis)
{
  std::vector<double> corners;
  for (const std::vector<Vec2>& loop : loops)
  {
    for (const Vec2& corner : loop)
    {
      corners.push_back(corner[axis]);
    }
  }
  std::sort(corners.begin(), corners.end());
  if (axis == 0)
  {
    PartLoops(loops, axis, lines);
  }
  for (size_t i = 1; i + 1 < lines.size(); ++i)
  {
    const double room = std::min(lines[i] - lines[i - 1], lines[i + 1] - lines[i]);
    lines[i] = ClearPlace(lines[i], room, corners);
  }
  const double margin = 1e-3 * (lines.back() - lines.front());
  lines.front() -= margin;
  lines.back() += margin;
  return lines;
}

}
