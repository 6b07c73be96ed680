#include "ValueWeights.h"

#include "BandPlace.h"
#include "ElementMap.h"
#include "Runs.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace trim
{
namespace
{

/// Directions in which the neighbours tell less than this share of what they tell in the best one
/// have no gradient: through a sheet of one layer there is no telling.
constexpr double LeastTold = 0.02;

void AddWeight(int source, double weight, std::vector<std::pair<int, double>>& sources)
{
  for (auto& known : sources)
  {
    if (known.first == source)
    {
      known.second += weight;
      return;
    }
  }
  sources.emplace_back(source, weight);
}

/// Those that were made, in order.
std::vector<ValueRow> Filled(std::vector<ValueRow> rows)
{
  rows.erase(std::remove_if(
               rows.begin(), rows.end(), [](const ValueRow& row) { return row.Sources.empty(); }),
    rows.end());
  for (ValueRow& row : rows)
  {
    std::sort(row.Sources.begin(), row.Sources.end());
  }
  return rows;
}

Vec3 CentroidOf(const ElementPoints& points, int count)
{
  Vec3 moment = Vec3::Zero();
  double volume = 0.0;
  ForVolumes<2>(points, count,
    [&](const Vec3& place, double part)
    {
      moment += part * (place - points[0]);
      volume += part;
    });
  return volume > 0.0 ? Vec3(points[0] + moment / volume) : points[0];
}

class ElementRows
{
public:
  ElementRows(const Band& band)
    : TheBand(band)
    , Centroid(band.NumberOfElements())
  {
    ForAll(band.NumberOfElements(),
      [this](int e) {
        this->Centroid[e] = CentroidOf(PointsOf(this->TheBand, e), this->TheBand.Elements[e].Count);
      });
  }

  /// The weights for an element's new shape within or round an element of the band; none if that
  /// has no volume or lies nowhere.
  std::vector<std::pair<int, double>> Sources(int element, const FinalElement& shape) const
  {
    const std::vector<Share> shares = this->SharesOf(element, shape);
    double volume = 0.0;
    for (const Share& share : shares)
    {
      volume += share.Volume;
    }
    std::vector<std::pair<int, double>> sources;
    for (const Share& share : shares)
    {
      AddWeight(share.Element, share.Volume / volume, sources);
      this->AddGradient(share.Element, share.Moment / volume, sources);
    }
    return sources;
  }

private:
  /// What of a new shape lies in an old element.
  struct Share
  {
    int Element;
    double Volume = 0.0;
    Vec3 Moment = Vec3::Zero(); ///< of the volume about the old element's centroid
  };

  std::vector<Share> SharesOf(int element, const FinalElement& shape) const
  {
    const std::vector<Share> shares = this->SharesByRule<3>(element, shape);
    // Elements that are left folded at a corner have a volume at their integration points.
    return shares.empty() ? this->SharesByRule<2>(element, shape) : shares;
  }

  /// None if the shape has no volume at one of the rule's points, or that lies nowhere.
  template <int N>
  std::vector<Share> SharesByRule(int element, const FinalElement& shape) const
  {
    std::vector<Share> shares;
    bool found = true;
    int start = element;
    ForVolumes<N>(shape.Points, shape.Count,
      [&](const Vec3& point, double volume)
      {
        const int at = FindBandPlace(this->TheBand, start, point).Element;
        found = found && at >= 0 && volume > 0.0;
        if (!found)
        {
          return;
        }
        start = at;
        auto share = std::find_if(
          shares.begin(), shares.end(), [at](const Share& s) { return s.Element == at; });
        if (share == shares.end())
        {
          share = shares.insert(share, { at });
        }
        share->Volume += volume;
        share->Moment += volume * (point - this->Centroid[at]);
      });
    return found ? shares : std::vector<Share>();
  }

  /// Adds what an element's gradient makes at a distance from its centroid.
  void AddGradient(
    int element, const Vec3& distance, std::vector<std::pair<int, double>>& sources) const
  {
    // Neighbours count by direction, near ones and far ones alike: a layer is thin.
    std::array<int, 6> neighbours;
    std::array<Vec3, 6> ways;
    int count = 0;
    Eigen::Matrix3d told = Eigen::Matrix3d::Zero();
    for (int slot = 0; slot < TopologyOf(this->TheBand.Elements[element].Count).NumberOfFaces;
         ++slot)
    {
      const int other = this->TheBand.Neighbour(element, slot);
      const Vec3 way =
        other >= 0 ? Vec3(this->Centroid[other] - this->Centroid[element]) : Vec3(Vec3::Zero());
      if (way.squaredNorm() > 0.0)
      {
        neighbours[count] = other;
        ways[count++] = way / way.squaredNorm();
        told += way * way.transpose() / way.squaredNorm();
      }
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(told);
    Vec3 inverse = Vec3::Zero();
    for (int i = 0; i < 3; ++i)
    {
      const double value = solver.eigenvalues()[i];
      inverse[i] = value > LeastTold * solver.eigenvalues()[2] ? 1.0 / value : 0.0;
    }
    const Vec3 along =
      solver.eigenvectors() * inverse.cwiseProduct(solver.eigenvectors().transpose() * distance);
    for (int i = 0; i < count; ++i)
    {
      const double weight = along.dot(ways[i]);
      AddWeight(neighbours[i], weight, sources);
      AddWeight(element, -weight, sources);
    }
  }

  const Band& TheBand;
  std::vector<Vec3> Centroid; ///< by element of the band
};

}

std::vector<ValueRow> WeightsOfNodes(const MovedNodes& moved)
{
  const int count = static_cast<int>(moved.Nodes.size());
  std::vector<ValueRow> rows(count);
  ForAll(count,
    [&](int i)
    {
      const Band& band = WithoutLayer(*moved.TheBand);
      const int node = moved.Nodes[i];
      BandPlace place;
      for (const int e : band.ElementsOfNode(NodeWithoutLayer(*moved.TheBand, node)))
      {
        // From each of them: it may belong to several parts, and where the border bends inwards a
        // walk may end beside the place, which rounding may put outside of all elements.
        const BandPlace other = FindBandPlace(band, e, moved.NodeMoves->Position[node]);
        place = other.Outside < place.Outside ? other : place;
        if (place.Inside)
        {
          break;
        }
      }
      if (place.Element < 0)
      {
        return;
      }
      const auto& element = band.Elements[place.Element];
      const NodeWeights weights = ShapeFunctions(element.Count, place.Parameters);
      rows[i].Target = node;
      for (int k = 0; k < element.Count; ++k)
      {
        if (weights[k] != 0.0)
        {
          rows[i].Sources.emplace_back(element.Node[k], weights[k]);
        }
      }
    });
  return Filled(std::move(rows));
}

std::vector<ValueRow> WeightsOfElements(const Band& band, const BandShapes& shapes)
{
  const ElementRows elements(WithoutLayer(band));
  std::vector<ValueRow> rows(shapes.Count);
  ForAll(shapes.Count,
    [&](int i)
    {
      const FinalElement shape = shapes.ShapeOf(i);
      if (shape.Count > 0 && shape.Touched)
      {
        const int start = ElementWithoutLayer(band, shapes.BandElementOf(i));
        rows[i] = { i, elements.Sources(start, shape) };
      }
    });
  return Filled(std::move(rows));
}

}
