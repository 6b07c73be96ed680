/**
 * @file Facet.h
 * @brief The surface of one face of an element: a plane triangle or a bilinear quadrilateral.
 */
#ifndef Facet_h
#define Facet_h

#include "Band.h"

#include <array>
#include <vector>

namespace trim
{

/// Closest point on the (unbounded) surface of a facet.
struct FacetFoot
{
  Vec3 Point;
  Vec3 Normal;        ///< unit
  double Outside = 0; ///< how far beyond the facet's own edges, in its parameters; 0: inside
};

enum class FootSought
{
  Any,
  Inside ///< the facet's own edges
};

class Facet
{
public:
  /// @param places of the band's nodes.
  Facet(const std::vector<Vec3>& places, const BandFace& face);
  Facet(const Band& band, const BandFace& face)
    : Facet(band.Point, face)
  {
  }

  /// @param sought what is surely not so need not be found out to the last digit.
  FacetFoot Project(const Vec3& x, FootSought sought = FootSought::Any) const;

  /**
   * How well a direction leads from a corner node into the facet: the smaller of its two
   * components along the facet's edges there, over its length; >= 0 inside.
   */
  double LeadsInto(int corner, const Vec3& direction) const;

  /// Length of a move from a corner, measured in the facet's edges there.
  double LengthInEdges(int corner, const Vec3& move) const;

  /// Unit normal at a corner.
  Vec3 NormalAt(int corner) const;

  /// Unit normal on the whole: across both diagonals; of a triangle too.
  Vec3 MeanNormal() const;

private:
  friend class FacetSearch;

  int Count;
  std::array<Vec3, 4> Corner;
};

/// A facet that many points are looked for in. Plane facets, most of all, need no iteration.
class FacetSearch
{
public:
  explicit FacetSearch(const Facet& facet);

  /// True only if every point of the facet is farther from x than a distance.
  bool IsFarther(const Vec3& x, double distance) const
  {
    const double reach = this->Radius + distance;
    return (x - this->Middle).squaredNorm() > reach * reach;
  }

  double SquaredToMiddle(const Vec3& x) const { return (x - this->Middle).squaredNorm(); }

  /**
   * The foot of x, if it is inside the facet.
   * @param slack how far beyond the edges, in parameters, still counts as inside.
   */
  bool FindInside(const Vec3& x, double slack, Vec3& place) const;

private:
  bool FindPlaneAndConvex() const;

  Facet Searched;
  Vec3 Middle; ///< of the corners; the ball round it holds them, and with them the facet
  double Radius = 0.0;
  Vec3 Normal;
  bool PlaneAndConvex;
  std::array<Vec3, 4> Inward;    ///< from each edge, as long as the edge
  std::array<double, 4> Squared; ///< length of each edge, squared
};

}

#endif
