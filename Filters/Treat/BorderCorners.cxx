#include "BorderCorners.h"

#include "Facet.h"
#include "Status.h"

#include <algorithm>

namespace trim
{
namespace
{

/// Less of an edge is cut off at any vertex of a border that is not straight.
constexpr double LargestCut = 0.1;

class CornerSearch
{
public:
  CornerSearch(const Band& band, const Columns& columns, const nurbs::TrimmingSurface& surface,
    const TrimmedBand& trimmed)
    : TheBand(band)
    , TheColumns(columns)
    , Surface(surface)
    , Trimmed(trimmed)
  {
  }

  std::vector<int> Find()
  {
    std::vector<int> found;
    for (int n = 0; n < this->TheBand.NumberOfNodes(); ++n)
    {
      if (this->WentBehind(n) && this->CutsOff(n))
      {
        found.push_back(n);
      }
    }
    return found;
  }

private:
  bool WentBehind(int node) const
  {
    return this->Trimmed.Moving[node] && this->TheBand.NodeStatus[node] == NodeEliminate &&
      this->Trimmed.NodeMoves.Applied[node] == Correction::Relax &&
      this->TheColumns.IsOnBorder(this->TheBand, node);
  }

  bool CutsOff(int node)
  {
    if (this->AtCut.empty()) // most trims have no such node
    {
      this->AtCut = FindBoundaryNodes(this->TheBand, this->Trimmed);
    }
    const auto faces = this->TheBand.FacesOfNode(node);
    return !this->AtCut[node] &&
      std::any_of(faces.begin(), faces.end(), [&](int f) { return this->CutsOff(node, f); });
  }

  /// Whether that is so along a side of the model.
  bool CutsOff(int node, int f) const
  {
    const auto& face = this->TheBand.Faces[f];
    if (!face.Exterior || !this->Trimmed.Kept[face.Element[0]] ||
      this->TheColumns.IsLayerFace(this->TheBand, f))
    {
      return false;
    }
    const auto next = NeighboursOf(face, node);
    return std::any_of(next.begin(), next.end(),
      [&](int other)
      {
        return this->AtCut[other] &&
          this->TheColumns.Pillar[other] != this->TheColumns.Pillar[node] &&
          this->IsAstray(face, node, other);
      });
  }

  /// Whether the middle of what an edge has become lies neither on its side nor on the surface.
  bool IsAstray(const BandFace& face, int a, int b) const
  {
    const auto& places = this->Trimmed.NodeMoves.Position;
    const double limit = LargestCut * (this->TheBand.Point[a] - this->TheBand.Point[b]).norm();
    const Vec3 middle = 0.5 * (places[a] + places[b]);
    return (Facet(this->TheBand, face).Project(middle).Point - middle).norm() > limit &&
      this->Surface.ClosestPoint(middle).Distance > limit;
  }

  const Band& TheBand;
  const Columns& TheColumns;
  const nurbs::TrimmingSurface& Surface;
  const TrimmedBand& Trimmed;
  std::vector<char> AtCut;
};

}

std::vector<int> FindCornersCutOff(const Band& band, const Columns& columns,
  const nurbs::TrimmingSurface& surface, const TrimmedBand& trimmed)
{
  return CornerSearch(band, columns, surface, trimmed).Find();
}

}
