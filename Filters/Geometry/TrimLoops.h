/**
 * @file TrimLoops.h
 * @brief Restriction of a face to the inside of its trim loops (even-odd rule in (u, v)).
 */
#ifndef TrimLoops_h
#define TrimLoops_h

#include "NurbsSurface.h"

#include <vector>

namespace nurbs
{
/// What the trim loops leave of a piece of surface.
enum class TrimState : unsigned char
{
  Inside,
  Crossed,
  Outside
};

class TrimLoops
{
public:
  TrimLoops() = default;
  /// Loops that run round the whole parameter rectangle restrict nothing and are dropped.
  explicit TrimLoops(const NurbsSurface& surface);

  bool Empty() const { return this->Edges.empty(); }

  /// Even-odd rule. Cost: the edges of one band of v.
  bool Inside(double u, double v) const;

  /// The same for a rectangle in (u, v).
  TrimState Classify(const Vec2& low, const Vec2& high) const;

  struct Edge
  {
    Vec2 From, To;
    int Loop, Index;
  };
  const std::vector<Edge>& AllEdges() const { return this->Edges; }
  /// Edge of a loop by its index, taken round the loop.
  const Edge& LoopEdge(int loop, int index) const;
  /// True if the inside lies to the left of the loop.
  bool InsideIsLeft(int loop) const { return this->LeftInside[loop]; }

private:
  void BuildBands();
  /// Of places beside some of a loop's edges: where loops touch, one alone says nothing.
  int VotesForLeft(int loop) const;
  /// The band that v lies in, or the one nearest to it.
  int Band(double v) const;
  std::vector<Edge> Edges;
  std::vector<int> FirstEdge; ///< of each loop, and one past the last
  std::vector<bool> LeftInside;
  double Low = 0, High = 0, Scale = 0;
  Vec2 Size = Vec2::Ones(); ///< of the box round all loops
  std::vector<int> BandStart, BandEdges;
};

/// The part of a-b inside a rectangle, as the interval [t0, t1] of a-b; false if there is none.
bool ClipToRectangle(
  const Vec2& a, const Vec2& b, const Vec2& low, const Vec2& high, double& t0, double& t1);

}

#endif
