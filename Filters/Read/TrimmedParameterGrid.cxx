#include "TrimmedParameterGrid.h"

#include "EarClipping.h"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>

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

}
