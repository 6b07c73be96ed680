#include "InsertedLayer.h"

#include "Decision.h"
#include "Moves.h"
#include "Status.h"

#include <Eigen/QR>

#include <algorithm>

namespace trim
{
namespace
{

/// How much of the depth of the elements at the cut the layer takes, and how often it may be
/// thinner by half.
constexpr double LayerShare = 0.3;
constexpr int MostHalvings = 3;
/// Weight of the skin against the depth of the layer.
constexpr double SkinWeight = 30.0;
/// Faces that turn by less than this, about, count as one direction.
constexpr double LeastTurn = 0.2;

class LayerBuilder
{
public:
  LayerBuilder(const Band& band, const NodeMover& mover, const std::vector<char>& kept)
    : TheBand(band)
    , Mover(mover)
    , Kept(kept)
    , InnerNode(band.NumberOfNodes(), -1)
  {
  }

  bool Build(BandCells& cells)
  {
    this->TakeBand(cells);
    this->AddNodes(cells);
    this->AddCells(cells);
    return this->Place(cells);
  }

private:
  void TakeBand(BandCells& cells) const
  {
    const Band& band = this->TheBand;
    for (int n = 0; n < band.NumberOfNodes(); ++n)
    {
      cells.Nodes.push_back(
        { band.GlobalNode[n], band.Point[n], band.NodeStatus[n], { n, false } });
    }
    for (int e = 0; e < band.NumberOfElements(); ++e)
    {
      const BandElement& element = band.Elements[e];
      cells.Cells.push_back({ element.Global, element.Count, element.Ring, band.ElementStatus[e],
        element.Node, { e, false } });
    }
  }

  /// A node behind each node of the cut, which the kept elements there have in its stead.
  void AddNodes(BandCells& cells)
  {
    const std::vector<char> onCut = FindCutNodes(this->TheBand, this->Kept);
    for (int n = 0; n < this->TheBand.NumberOfNodes(); ++n)
    {
      if (onCut[n])
      {
        this->InnerNode[n] = static_cast<int>(cells.Nodes.size());
        cells.Nodes.push_back(
          { this->TheBand.GlobalNode[n], this->TheBand.Point[n], NodeKeep, { n, true } });
      }
    }
    for (int e = 0; e < this->TheBand.NumberOfElements(); ++e)
    {
      auto& cell = cells.Cells[e];
      for (int i = 0; this->Kept[e] && i < cell.Count; ++i)
      {
        cell.Node[i] = this->Behind(cell.Node[i]);
      }
    }
  }

  int Behind(int node) const { return this->InnerNode[node] >= 0 ? this->InnerNode[node] : node; }

  void AddCells(BandCells& cells) const
  {
    for (const BandFace& face : this->TheBand.Faces)
    {
      if (IsCutFace(face, this->Kept))
      {
        cells.Cells.push_back(this->CellOn(face));
      }
    }
  }

  BandCells::Cell CellOn(const BandFace& face) const
  {
    const int side = this->Kept[face.Element[0]] ? 0 : 1;
    const int element = face.Element[side];
    const auto& nodes = TopologyOf(this->TheBand.Elements[element].Count).Faces[face.Slot[side]];
    BandCells::Cell cell;
    cell.Count = 2 * face.Count;
    cell.From = { element, true };
    unsigned char status[8] = {};
    for (int i = 0; i < std::min(face.Count, 4); ++i) // the compiler does not know its limit
    {
      const int node = this->TheBand.Elements[element].Node[nodes.Node[i]];
      cell.Node[i] = this->InnerNode[node];
      cell.Node[i + face.Count] = node;
      status[i] = NodeKeep;
      status[i + face.Count] = this->TheBand.NodeStatus[node];
    }
    cell.Status = StatusOfElement(status, cell.Count);
    return cell;
  }

  /// How far an element reaches behind one of its faces.
  double DepthBehind(int element, int slot) const
  {
    const BandElement& own = this->TheBand.Elements[element];
    const auto& topology = TopologyOf(own.Count);
    const auto& face = topology.Faces[slot];
    const auto inFace = [&face](int i)
    {
      return std::find(face.Node.begin(), face.Node.begin() + face.Count, i) !=
        face.Node.begin() + face.Count;
    };
    double depth = 0.0;
    int count = 0;
    for (int i = 0; i < topology.NumberOfEdges; ++i)
    {
      const auto& edge = topology.Edges[i];
      if (inFace(edge.First) != inFace(edge.Second))
      {
        depth +=
          (this->TheBand.Point[own.Node[edge.First]] - this->TheBand.Point[own.Node[edge.Second]])
            .norm();
        ++count;
      }
    }
    return depth / count;
  }

  /// The step from a node of the cut that leads its share of the elements' depth behind all faces
  /// of the cut there, and stays on the skin as far as it is plane.
  Vec3 StepBehind(int node, double share) const
  {
    std::vector<std::pair<Vec3, double>> rows;
    for (const int f : this->TheBand.FacesOfNode(node))
    {
      const BandFace& face = this->TheBand.Faces[f];
      if (IsCutFace(face, this->Kept))
      {
        const int side = this->Kept[face.Element[0]] ? 0 : 1;
        const Vec3 normal = (side == 0 ? 1.0 : -1.0) * this->NormalOf(face, node);
        rows.emplace_back(normal, -share * this->DepthBehind(face.Element[side], face.Slot[side]));
      }
      else if (face.Exterior && this->Kept[face.Element[0]])
      {
        rows.emplace_back(SkinWeight * this->NormalOf(face, node), 0.0);
      }
    }
    Eigen::MatrixXd normals(rows.size(), 3);
    Eigen::VectorXd depths(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
      normals.row(i) = rows[i].first;
      depths[i] = rows[i].second;
    }
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
    solver.setThreshold(LeastTurn / SkinWeight);
    solver.compute(normals);
    return solver.solve(depths);
  }

  Vec3 NormalOf(const BandFace& face, int node) const
  {
    const auto begin = face.Node.begin();
    const int corner = static_cast<int>(std::find(begin, begin + face.Count, node) - begin);
    return Facet(this->TheBand, face).NormalAt(corner);
  }

  /// Places the new nodes; where an element has no room, the layer is thinner.
  bool Place(BandCells& cells) const
  {
    std::vector<double> share(cells.Nodes.size(), LayerShare);
    for (int halvings = 0; halvings <= MostHalvings; ++halvings)
    {
      for (auto& node : cells.Nodes)
      {
        if (node.From.Inserted &&
          !this->PlaceBehind(node.From.Index, share[&node - cells.Nodes.data()], node.Point))
        {
          return false;
        }
      }
      if (!this->ThinWhereInvalid(cells, share))
      {
        return true;
      }
    }
    return false;
  }

  bool PlaceBehind(int node, double share, Vec3& place) const
  {
    NodeFreedom freedom = this->Mover.FreedomOf(node);
    const Vec3 wanted = this->TheBand.Point[node] + this->StepBehind(node, share);
    const bool found = freedom.Constraint.Kind != ConstraintKind::Fixed &&
      this->Mover.Constrained(node, freedom, wanted, false, place);
    place = AsStored(this->TheBand, place);
    return found;
  }

  /// Halves the shares at invalid elements with new nodes; false if there are none.
  bool ThinWhereInvalid(const BandCells& cells, std::vector<double>& share) const
  {
    std::vector<char> thin(cells.Nodes.size(), 0);
    bool any = false;
    for (const auto& cell : cells.Cells)
    {
      ElementPoints points;
      bool changed = false;
      for (int i = 0; i < cell.Count; ++i)
      {
        points[i] = cells.Nodes[cell.Node[i]].Point;
        changed |= cells.Nodes[cell.Node[i]].From.Inserted;
      }
      if (changed && !(MeasureJacobian(points, cell.Count).Bezier > 0.0))
      {
        any = true;
        std::for_each(
          cell.Node.begin(), cell.Node.begin() + cell.Count, [&thin](int n) { thin[n] = 1; });
      }
    }
    for (std::size_t n = 0; n < thin.size(); ++n)
    {
      share[n] *= thin[n] ? 0.5 : 1.0;
    }
    return any;
  }

  const Band& TheBand;
  const NodeMover& Mover;
  const std::vector<char>& Kept;
  std::vector<int> InnerNode; ///< by node of the band: the new one behind it, -1: none
};

}

bool InsertLayer(
  const Band& band, const NodeMover& mover, const std::vector<char>& kept, BandCells& cells)
{
  return LayerBuilder(band, mover, kept).Build(cells);
}

}
