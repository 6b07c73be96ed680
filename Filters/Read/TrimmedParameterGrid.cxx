#include "TrimmedParameterGrid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace nurbs
{
namespace
{
double Cross(const Vec2& a, const Vec2& b, const Vec2& c)
{
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

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

/**
 * The lines that the trimmed grid uses along one axis: the outermost are moved outwards, so that
 * loops along the border of the domain lie inside; the others clear of the loops' corners.
 */
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
  // A line through the middle of each loop that lies between two lines (u only: one crossing
  // is enough to have no loop within a cell).
  if (axis == 0)
  {
    for (const std::vector<Vec2>& loop : loops)
    {
      const auto range = std::minmax_element(
        loop.begin(), loop.end(), [](const Vec2& a, const Vec2& b) { return a.x() < b.x(); });
      const double low = range.first->x();
      const double high = range.second->x();
      auto next = std::upper_bound(lines.begin(), lines.end(), low);
      if (low < high && (next == lines.end() || *next >= high || next + 1 == lines.end()))
      {
        lines.insert(next == lines.end() ? next - 1 : next, 0.5 * (low + high));
      }
    }
    std::sort(lines.begin(), lines.end());
  }
  for (size_t i = 1; i + 1 < lines.size(); ++i)
  {
    const double room = 0.01 * std::min(lines[i] - lines[i - 1], lines[i + 1] - lines[i]);
    double best = lines[i];
    for (int shift : { 0, 1, -1, 2, -2, 3, -3, 5, -5, 7, -7 })
    {
      const double trial = lines[i] + 0.1 * shift * room;
      if (Clearance(corners, trial) > Clearance(corners, best))
      {
        best = trial;
      }
      if (Clearance(corners, best) > 0.04 * room)
      {
        break;
      }
    }
    lines[i] = best;
  }
  const double margin = 1e-3 * (lines.back() - lines.front());
  lines.front() -= margin;
  lines.back() += margin;
  return lines;
}

/// Are the corners between two corners of a loop within the tolerance of their chord?
bool IsChord(
  const std::vector<Vec2>& loop, size_t first, size_t last, const Vec2& unit, double tolerance)
{
  const Vec2 origin = loop[first].cwiseQuotient(unit);
  const Vec2 chord = loop[last % loop.size()].cwiseQuotient(unit) - origin;
  for (size_t k = first + 1; k < last; ++k)
  {
    const Vec2 arm = loop[k].cwiseQuotient(unit) - origin;
    const double along =
      chord.squaredNorm() > 0.0 ? std::clamp(arm.dot(chord) / chord.squaredNorm(), 0.0, 1.0) : 0.0;
    if ((arm - along * chord).norm() > tolerance)
    {
      return false;
    }
  }
  return true;
}

/// Where a loop crosses a line of the grid.
struct Crossing
{
  int Point;       ///< index of the point
  double Position; ///< along the line
};

/// A stretch of a loop within one cell, from crossing to crossing, as point indices.
using Chain = std::vector<int>;

/// The division of a trimmed rectangle: cells, the loops' chains in them, pieces traced.
class ParameterGrid
{
public:
  ParameterGrid(const std::vector<double>& linesU, const std::vector<double>& linesV,
    const std::vector<std::vector<Vec2>>& loops)
    : Lines{ ClearLines(linesU, loops, 0), ClearLines(linesV, loops, 1) }
  {
    for (const std::vector<Vec2>& loop : loops)
    {
      this->AddLoop(loop);
    }
    for (auto& edge : this->EdgeCrossings)
    {
      std::sort(edge.second.begin(), edge.second.end(),
        [](const Crossing& a, const Crossing& b) { return a.Position < b.Position; });
    }
  }

  ParameterPolygons Divide()
  {
    const int cellsU = static_cast<int>(this->Lines[0].size()) - 1;
    const int cellsV = static_cast<int>(this->Lines[1].size()) - 1;
    for (int j = 0; j < cellsV; ++j)
    {
      // The lower left corner of the first cell is outside; each crossing toggles.
      bool inside = false;
      for (int i = 0; i < cellsU; ++i)
      {
        this->DivideCell(i, j, inside);
        inside = inside != (this->CrossingsOf(0, i, j).size() % 2 == 1);
      }
    }
    return std::move(this->Result);
  }

private:
  /// An edge of the grid: axis 0 from vertex (i, j) along u, axis 1 along v.
  struct Edge
  {
    int Axis, I, J;
    bool operator<(const Edge& other) const
    {
      return std::tie(this->J, this->I, this->Axis) < std::tie(other.J, other.I, other.Axis);
    }
  };

  int AddPoint(const Vec2& point)
  {
    this->Result.Points.push_back(point);
    return static_cast<int>(this->Result.Points.size()) - 1;
  }

  /// Cell index along one axis; a value on a line belongs to the cell above it.
  int CellOf(double x, int axis) const
  {
    const std::vector<double>& lines = this->Lines[axis];
    const int above =
      static_cast<int>(std::upper_bound(lines.begin(), lines.end(), x) - lines.begin());
    return std::clamp(above - 1, 0, static_cast<int>(lines.size()) - 2);
  }

  const std::vector<Crossing>& CrossingsOf(int axis, int i, int j) const
  {
    static const std::vector<Crossing> none;
    auto found = this->EdgeCrossings.find(Edge{ axis, i, j });
    return found == this->EdgeCrossings.end() ? none : found->second;
  }

  /// Point index of the grid vertex (i, j), made on first use.
  int GridPoint(int i, int j)
  {
    auto inserted = this->GridPoints.emplace(std::make_pair(i, j), -1);
    if (inserted.second)
    {
      inserted.first->second = this->AddPoint(Vec2(this->Lines[0][i], this->Lines[1][j]));
    }
    return inserted.first->second;
  }

  /// Splits a closed loop at the grid's lines and hands the chains to the cells.
  void AddLoop(const std::vector<Vec2>& loop)
  {
    std::vector<int> first; // corners before the first crossing: the tail of the last chain
    Chain chain;
    bool crossed = false;
    int cell[2] = { this->CellOf(loop[0].x(), 0), this->CellOf(loop[0].y(), 1) };
    for (size_t k = 0; k < loop.size(); ++k)
    {
      const Vec2& p = loop[k];
      const Vec2& q = loop[(k + 1) % loop.size()];
      (crossed ? chain : first).push_back(this->AddPoint(p));
      for (const Step& step : this->StepsBetween(p, q))
      {
        const int point = this->AddCrossing(step, p, q, cell);
        if (crossed)
        {
          chain.push_back(point);
          this->Chains[{ cell[0], cell[1] }].push_back(chain);
        }
        else
        {
          first.push_back(point);
        }
        crossed = true;
        chain.assign(1, point);
        cell[step.Axis] += step.Direction;
      }
    }
    if (crossed)
    {
      chain.insert(chain.end(), first.begin(), first.end());
      this->Chains[{ cell[0], cell[1] }].push_back(chain);
    }
  }

  /// One line crossed on the way from p to q.
  struct Step
  {
    double T;
    int Axis, Direction;
    double Line;
  };

  std::vector<Step> StepsBetween(const Vec2& p, const Vec2& q) const
  {
    std::vector<Step> steps;
    for (int axis : { 0, 1 })
    {
      const int from = this->CellOf(p[axis], axis);
      const int to = this->CellOf(q[axis], axis);
      const int direction = from < to ? 1 : -1;
      for (int cell = from; cell != to; cell += direction)
      {
        const double line = this->Lines[axis][direction > 0 ? cell + 1 : cell];
        steps.push_back(Step{ (line - p[axis]) / (q[axis] - p[axis]), axis, direction, line });
      }
    }
    std::sort(steps.begin(), steps.end(), [](const Step& a, const Step& b) { return a.T < b.T; });
    return steps;
  }

  /// Makes the point where the loop leaves `cell` and notes it on the grid edge crossed.
  int AddCrossing(const Step& step, const Vec2& p, const Vec2& q, const int cell[2])
  {
    const int other = 1 - step.Axis;
    Vec2 point;
    point[step.Axis] = step.Line;
    point[other] = p[other] + step.T * (q[other] - p[other]);
    const int id = this->AddPoint(point);
    Edge edge{ other, cell[0], cell[1] };
    (step.Axis == 0 ? edge.I : edge.J) += step.Direction > 0 ? 1 : 0;
    this->EdgeCrossings[edge].push_back(Crossing{ id, point[other] });
    return id;
  }

  /// Emits the pieces of one cell; `inside` is the state of its lower left corner.
  void DivideCell(int i, int j, bool inside)
  {
    auto found = this->Chains.find({ i, j });
    if (found == this->Chains.end())
    {
      if (inside)
      {
        this->Result.Polygons.push_back({ this->GridPoint(i, j), this->GridPoint(i + 1, j),
          this->GridPoint(i + 1, j + 1), this->GridPoint(i, j + 1) });
      }
      return;
    }
    this->TracePieces(this->InsideArcs(i, j, inside), found->second);
  }

  /**
   * The stretches of a cut cell's border that are inside, counter-clockwise, each from one
   * crossing to the next.
   */
  std::vector<Chain> InsideArcs(int i, int j, bool inside)
  {
    std::vector<Chain> arcs;
    Chain arc;
    Chain first; // what comes before the first crossing closes the last arc
    bool started = false;
    const bool firstInside = inside;
    auto meet = [&](int point)
    {
      arc.push_back(point);
      if (!started)
      {
        first = arc;
        started = true;
      }
      else if (inside)
      {
        arcs.push_back(arc);
      }
      arc.assign(1, point);
      inside = !inside;
    };
    const Edge border[4] = { { 0, i, j }, { 1, i + 1, j }, { 0, i, j + 1 }, { 1, i, j } };
    const int corners[4][2] = { { i, j }, { i + 1, j }, { i + 1, j + 1 }, { i, j + 1 } };
    for (int side = 0; side < 4; ++side)
    {
      if (inside)
      {
        arc.push_back(this->GridPoint(corners[side][0], corners[side][1]));
      }
      std::vector<Crossing> crossings =
        this->CrossingsOf(border[side].Axis, border[side].I, border[side].J);
      if (side >= 2)
      {
        std::reverse(crossings.begin(), crossings.end());
      }
      for (const Crossing& crossing : crossings)
      {
        meet(crossing.Point);
      }
    }
    if (started && firstInside)
    {
      arc.insert(arc.end(), first.begin(), first.end());
      arcs.push_back(arc);
    }
    return arcs;
  }

  /// Joins border arcs and chains, which meet at the crossings, to closed pieces.
  void TracePieces(const std::vector<Chain>& arcs, const std::vector<Chain>& chains)
  {
    std::multimap<int, const Chain*> links; // from either end of a chain or arc
    for (const std::vector<Chain>* list : { &arcs, &chains })
    {
      for (const Chain& link : *list)
      {
        links.emplace(link.front(), &link);
        links.emplace(link.back(), &link);
      }
    }
    auto take = [&links](const Chain* link)
    {
      for (int end : { link->front(), link->back() })
      {
        auto range = links.equal_range(end);
        auto found = std::find_if(
          range.first, range.second, [link](const auto& entry) { return entry.second == link; });
        if (found == range.second)
        {
          return false;
        }
        links.erase(found);
      }
      return true;
    };
    // Every piece has an arc; run along the arc's direction it is counter-clockwise.
    for (const Chain& arc : arcs)
    {
      if (!take(&arc))
      {
        continue;
      }
      std::vector<int> piece(arc.begin(), arc.end() - 1);
      int end = arc.back();
      for (auto next = links.find(end); end != arc.front() && next != links.end();
           next = links.find(end))
      {
        const Chain* link = next->second;
        const bool forward = link->front() == end;
        take(link);
        forward ? piece.insert(piece.end(), link->begin(), link->end() - 1)
                : piece.insert(piece.end(), link->rbegin(), link->rend() - 1);
        end = forward ? link->back() : link->front();
      }
      TriangulatePolygon(this->Result.Points, piece, this->Result.Polygons);
    }
  }

  std::vector<double> Lines[2];
  std::map<Edge, std::vector<Crossing>> EdgeCrossings;
  std::map<std::pair<int, int>, std::vector<Chain>> Chains; // by cell
  std::map<std::pair<int, int>, int> GridPoints;
  ParameterPolygons Result;
};
}

//------------------------------------------------------------------------------
ParameterPolygons DivideRectangle(
  const std::vector<double>& linesU, const std::vector<double>& linesV)
{
  ParameterPolygons result;
  const int countU = static_cast<int>(linesU.size());
  for (size_t j = 0; j < linesV.size(); ++j)
  {
    for (int i = 0; i < countU; ++i)
    {
      result.Points.emplace_back(linesU[i], linesV[j]);
      if (i > 0 && j > 0)
      {
        const int corner = static_cast<int>(result.Points.size()) - 1;
        result.Polygons.push_back({ corner - countU - 1, corner - countU, corner, corner - 1 });
      }
    }
  }
  return result;
}

//------------------------------------------------------------------------------
ParameterPolygons DivideTrimmedRectangle(const std::vector<double>& linesU,
  const std::vector<double>& linesV, const std::vector<std::vector<Vec2>>& loops)
{
  return ParameterGrid(linesU, linesV, loops).Divide();
}

//------------------------------------------------------------------------------
std::vector<std::vector<Vec2>> ThinLoops(
  const std::vector<std::vector<Vec2>>& loops, const Vec2& unit, double tolerance)
{
  std::vector<std::vector<Vec2>> thinned;
  for (const std::vector<Vec2>& loop : loops)
  {
    std::vector<Vec2> thin;
    const size_t n = loop.size();
    for (size_t anchor = 0; anchor < n;)
    {
      thin.push_back(loop[anchor]);
      // The farthest corner that a chord reaches, not more than a third of the loop away so
      // that a loop stays a loop.
      size_t end = anchor + 1;
      while (end < n && end + 1 - anchor <= std::max<size_t>(1, n / 3) &&
        IsChord(loop, anchor, end + 1, unit, tolerance))
      {
        ++end;
      }
      anchor = end;
    }
    thinned.push_back(thin.size() < 3 ? loop : thin);
  }
  return thinned;
}

//------------------------------------------------------------------------------
void TriangulatePolygon(const std::vector<Vec2>& points, const std::vector<int>& polygon,
  std::vector<std::vector<int>>& triangles)
{
  std::vector<int> rest = polygon;
  size_t at = 0;
  size_t failures = 0;
  while (rest.size() > 3)
  {
    const size_t n = rest.size();
    const size_t before = (at + n - 1) % n;
    const size_t after = (at + 1) % n;
    const Vec2& a = points[rest[before]];
    const Vec2& b = points[rest[at]];
    const Vec2& c = points[rest[after]];
    bool ear = Cross(a, b, c) > 0.0;
    for (size_t k = 0; ear && k < n; ++k)
    {
      const Vec2& p = points[rest[k]];
      ear = k == before || k == at || k == after || p == a || p == b || p == c ||
        Cross(a, b, p) < 0.0 || Cross(b, c, p) < 0.0 || Cross(c, a, p) < 0.0;
    }
    // A round without an ear: the polygon is degenerate or crosses itself; go on regardless.
    if (ear || failures >= n)
    {
      triangles.push_back({ rest[before], rest[at], rest[after] });
      rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(at));
      // Go on at the next but one corner, so that the ears are spread round the polygon.
      at = (at + 1) % rest.size();
      failures = 0;
    }
    else
    {
      at = after;
      ++failures;
    }
  }
  if (rest.size() == 3)
  {
    triangles.push_back(rest);
  }
}
}
