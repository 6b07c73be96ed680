#include "TrimmedParameterGrid.h"

#include "ClearLines.h"
#include "EarClipping.h"
#include "PieceTracing.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace nurbs
{
namespace
{
/// Where a loop crosses a line of the grid.
struct Crossing
{
  int Point;       ///< index of the point
  double Position; ///< along the line
};

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
    for (const Chain& piece : TracePieces(this->InsideArcs(i, j, inside), found->second))
    {
      TriangulatePolygon(this->Result.Points, piece, this->Result.Polygons);
    }
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
