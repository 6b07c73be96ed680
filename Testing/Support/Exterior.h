/**
 * @file Exterior.h
 * @brief The exterior surface of a model: its facets, ridges and corners, whether it is a
 * closed manifold, and how far a point is from it.
 */
#ifndef Exterior_h
#define Exterior_h

#include "Model.h"

#include <array>
#include <map>
#include <set>
#include <unordered_map>
#include <vector>

namespace judge
{
/// Facets that belong to one element only, and the number of those shared by more than two.
struct FacetTable
{
  std::vector<Facet> Exterior;
  std::map<std::array<Id, 4>, int> Uses; ///< by FacetKey: elements that have it
  int OverUsed = 0;                      ///< facets of more than two

  explicit FacetTable(const Model& model);
};

/// What is wrong with the boundary as a closed 2-manifold; the first place of each kind.
struct ManifoldDefects
{
  int Edges = 0;    ///< boundary edges with other than two boundary facets
  int Vertices = 0; ///< vertices whose boundary facets form more than one fan
  Id EdgePoint = -1;
  Id VertexPoint = -1;
  std::set<Id> Points; ///< all of them, and of such edges both ends
};
ManifoldDefects FindManifoldDefects(const FacetTable& facets);

/**
 * The exterior of an input model with its ridges: edges where the exterior turns by more than
 * SureAngle are ridges for certain, between MaybeAngle and SureAngle it is a matter of taste
 * and nothing is asked of the filter.
 */
class Exterior
{
public:
  static constexpr double SureAngle = 60; ///< degrees
  static constexpr double MaybeAngle = 35;

  explicit Exterior(const Model& model);

  enum class Place : unsigned char
  {
    Inside,  ///< not on the exterior
    Face,    ///< on smooth exterior facets only
    Ridge,   ///< on one ridge line that passes through
    Corner,  ///< where ridges meet, end, or turn sharply
    Doubtful ///< where it depends on the angle one takes for a ridge
  };
  Place PlaceOf(Id point) const { return this->Places[point]; }

  /// Smooth part of the exterior, bounded by sure ridges, that a point of place Face lies in;
  /// any of them for points on ridges, -1 inside.
  int PatchOf(Id point) const { return this->PointPatch[point]; }

  /// Distance from a point to the exterior (bilinear facets), or to one smooth part of it.
  double Distance(const Vec3& p, int patch = -1) const;

  /// Distance to the ridges, doubtful ones included.
  double RidgeDistance(const Vec3& p) const;

  const FacetTable& Facets() const { return this->Table; }

private:
  void FindRidges();
  void FindPlaces();
  void FindPatches();
  void FillBins();
  Id BinOf(const Vec3& p, int dx, int dy, int dz) const;

  const Model& Mesh;
  FacetTable Table;
  std::vector<Place> Places;
  std::vector<int> FacetPatch, PointPatch;
  struct Ridge
  {
    Id A, B;
    bool Sure;
  };
  std::vector<Ridge> Ridges;
  std::unordered_map<Id, std::vector<Id>> FacetBins;
  std::unordered_map<Id, std::vector<Id>> RidgeBins;
  Vec3 Low = Vec3::Zero();
  double BinSize = 1;
};

/// Distance from a point to a segment.
double DistanceToSegment(const Vec3& p, const Vec3& a, const Vec3& b);

}

#endif
