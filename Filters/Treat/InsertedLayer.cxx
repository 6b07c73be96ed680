#include "InsertedLayer.h"

#include "DirectionBehind.h"
#include "Jacobian.h"
#include "Moves.h"
#include "MovingNodes.h"
#include "NodeConstraint.h"
#include "Status.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

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
/// From here on the skin has a ridge, which holds its nodes.
const double RidgeTurn = std::acos(SameSideCosine);
/// A node has room behind the faces of the cut where its way is under no smaller angle to them.
constexpr double LeastSine = 0.15;
/// What a step leads behind each face, of the depth that it is to have there, at least.
constexpr double LeastOfDepth = 0.5;

/// What a node of the cut has to go behind, and what holds it.
struct FacesAtCut
{
  std::vector<Vec3> Normals, Skin; ///< unit, out of the kept elements
  std::vector<int> Faces;          ///< of Normals
};

Vec3 NormalAt(const Band& band, const BandFace& face, int node)
{
  return Facet(band, face).NormalAt(CornerOf(face, node));
}

FacesAtCut FacesAt(const Band& band, const std::vector<char>& kept, int node)
{
  FacesAtCut faces;
  for (const int f : band.FacesOfNode(node))
  {
    const BandFace& face = band.Faces[f];
    if (IsCutFace(face, kept))
    {
      faces.Normals.emplace_back((kept[face.Element[0]] ? 1.0 : -1.0) * NormalAt(band, face, node));
      faces.Faces.push_back(f);
    }
    else if (face.Exterior && kept[face.Element[0]])
    {
      faces.Skin.push_back(NormalAt(band, face, node));
    }
  }
  return faces;
}

DirectionBehind DirectionBehindAll(const FacesAtCut& faces)
{
  return FindDirectionBehind(faces.Normals, faces.Skin, RidgeTurn);
}

class LayerBuilder
{
public:
  LayerBuilder(const Band& band, const Columns& columns, const NodeMover& mover,
    const std::vector<char>& kept, const std::vector<char>& bare)
    : TheBand(band)
    , TheColumns(columns)
    , Mover(mover)
    , Kept(kept)
    , Bare(bare)
    , AllKept(band.NumberOfNodes(), NodeKeep)
    , InnerNode(band.NumberOfNodes(), -1)
  {
  }

  std::vector<int> Build(BandCells& cells)
  {
    std::vector<int> noRoom = this->FindNoDirection();
    if (!noRoom.empty())
    {
      return noRoom;
    }
    cells = BandCells();
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
      cells.Nodes.push_back(TakeNode(band, n, { n, false }));
    }
    for (int e = 0; e < band.NumberOfElements(); ++e)
    {
      cells.Cells.push_back(TakeElement(band, e, { e, false }, [](int n) { return n; }));
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

  void AddCells(BandCells& cells)
  {
    for (std::size_t f = 0; f < this->TheBand.Faces.size(); ++f)
    {
      const BandFace& face = this->TheBand.Faces[f];
      if (IsCutFace(face, this->Kept))
      {
        this->CutFaces.push_back(static_cast<int>(f));
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
    const FacesAtCut faces = FacesAt(this->TheBand, this->Kept, node);
    const auto cut = static_cast<Eigen::Index>(faces.Normals.size());
    const auto skin = static_cast<Eigen::Index>(faces.Skin.size());
    Eigen::MatrixXd normals(cut + skin, 3);
    Eigen::VectorXd depths = Eigen::VectorXd::Zero(cut + skin);
    for (Eigen::Index i = 0; i < cut; ++i)
    {
      const BandFace& face = this->TheBand.Faces[faces.Faces[i]];
      const int side = this->Kept[face.Element[0]] ? 0 : 1;
      normals.row(i) = faces.Normals[i];
      depths[i] = -share * this->DepthBehind(face.Element[side], face.Slot[side]);
    }
    for (Eigen::Index i = 0; i < skin; ++i)
    {
      normals.row(cut + i) = SkinWeight * faces.Skin[i];
    }
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;
    solver.setThreshold(LeastTurn / SkinWeight);
    solver.compute(normals);
    const Vec3 step = solver.solve(depths);
    const auto reached = (normals.topRows(cut) * step).array();
    if ((reached <= LeastOfDepth * depths.head(cut).array()).all())
    {
      return step;
    }
    // Where faces turn against each other the mean of what they ask for leads behind none.
    const Vec3 direction = DirectionBehindAll(faces).Direction;
    const Eigen::ArrayXd ways =
      depths.head(cut).array() / (normals.topRows(cut) * direction).array();
    return ways.minCoeff() * direction;
  }

  /// Nodes of the cut from which no way leads behind all faces of it there.
  std::vector<int> FindNoDirection() const
  {
    const std::vector<char> onCut = FindCutNodes(this->TheBand, this->Kept);
    std::vector<int> nodes;
    for (int n = 0; n < this->TheBand.NumberOfNodes(); ++n)
    {
      if (onCut[n] && !this->Bare[n] && !HasRoomForLayer(this->TheBand, this->Kept, n))
      {
        nodes.push_back(n);
      }
    }
    return nodes;
  }

  /// Places the new nodes; where an element has no room, the layer is thinner. Returns the nodes
  /// of the cut where it still has none.
  std::vector<int> Place(BandCells& cells) const
  {
    std::vector<double> share(cells.Nodes.size(), LayerShare);
    std::vector<int> noRoom;
    for (int halvings = 0; halvings <= MostHalvings; ++halvings)
    {
      std::vector<char> unplaced(cells.Nodes.size(), 0);
      for (std::size_t n = 0; n < cells.Nodes.size(); ++n)
      {
        auto& node = cells.Nodes[n];
        unplaced[n] = node.From.Inserted && !this->Bare[node.From.Index] &&
          !this->PlaceBehind(node.From.Index, share[n], node.Point);
      }
      noRoom = this->FindNoRoom(cells, unplaced, share);
      if (noRoom.empty())
      {
        break;
      }
    }
    return noRoom;
  }

  bool PlaceBehind(int node, double share, Vec3& place) const
  {
    // What the other elements are held by goes with them.
    NodeFreedom freedom;
    freedom.Constraint =
      ConstrainNode(this->TheBand, this->TheColumns, this->AllKept, this->Kept, node);
    const Vec3 wanted = this->TheBand.Point[node] + this->StepBehind(node, share);
    const bool found = freedom.Constraint.Kind != ConstraintKind::Fixed &&
      this->Mover.Constrained(node, freedom, wanted, false, place);
    place = AsStored(this->TheBand, place);
    return found;
  }

  /// Nodes of faces under invalid elements of the layer, those without a place, and those of other
  /// invalid elements; the shares there are halved.
  std::vector<int> FindNoRoom(
    const BandCells& cells, std::vector<char> bad, std::vector<double>& share) const
  {
    std::vector<char> thin(cells.Nodes.size(), 0);
    std::vector<char> invalid(cells.Cells.size(), 0);
    for (std::size_t c = 0; c < cells.Cells.size(); ++c)
    {
      const auto& cell = cells.Cells[c];
      invalid[c] = IsInvalid(cells, cell);
      for (int i = 0; invalid[c] && i < cell.Count; ++i)
      {
        thin[cell.Node[i]] = 1;
        bad[cell.Node[i]] |= !cell.From.Inserted;
      }
    }
    for (std::size_t n = 0; n < thin.size(); ++n)
    {
      share[n] *= thin[n] ? 0.5 : 1.0;
    }
    for (std::size_t i = 0; i < this->CutFaces.size(); ++i)
    {
      const BandFace& face = this->TheBand.Faces[this->CutFaces[i]];
      for (int k = 0; invalid[this->TheBand.NumberOfElements() + i] && k < face.Count; ++k)
      {
        bad[this->InnerNode[face.Node[k]]] = 1;
      }
    }
    std::vector<int> nodes;
    for (int n = 0; n < this->TheBand.NumberOfNodes(); ++n)
    {
      if (this->InnerNode[n] >= 0 && bad[this->InnerNode[n]])
      {
        nodes.push_back(n);
      }
    }
    return nodes;
  }

  /// Whether a cell with new nodes is that did not come so.
  bool IsInvalid(const BandCells& cells, const BandCells::Cell& cell) const
  {
    ElementPoints points, before;
    bool changed = false, goes = false;
    for (int i = 0; i < cell.Count; ++i)
    {
      const auto& node = cells.Nodes[cell.Node[i]];
      points[i] = node.Point;
      before[i] = this->TheBand.Point[node.From.Index];
      changed |= points[i] != before[i];
      goes |= cell.From.Inserted && this->Bare[node.From.Index];
    }
    const auto isInvalid = [&cell](const ElementPoints& p)
    { return !(MeasureJacobian(p, cell.Count).Bezier > 0.0); };
    return changed && !goes && isInvalid(points) && (cell.From.Inserted || !isInvalid(before));
  }

  const Band& TheBand;
  const Columns& TheColumns;
  const NodeMover& Mover;
  const std::vector<char>& Kept;
  const std::vector<char>& Bare;
  std::vector<unsigned char> AllKept; ///< status of the nodes as if there were no cut
  std::vector<int> InnerNode;         ///< by node of the band: the new one behind it, -1: none
  std::vector<int> CutFaces;          ///< the layer's elements stand on, in their order
};

}

bool HasRoomForLayer(const Band& band, const std::vector<char>& kept, int node)
{
  const FacesAtCut faces = FacesAt(band, kept, node);
  return faces.Normals.empty() || DirectionBehindAll(faces).Sine > LeastSine;
}

std::vector<int> InsertLayer(const Band& band, const Columns& columns, const NodeMover& mover,
  const std::vector<char>& kept, const std::vector<char>& bare, BandCells& cells)
{
  return LayerBuilder(band, columns, mover, kept, bare).Build(cells);
}

bool IsOnBareNode(const Band& layered, const std::vector<char>& bare, int e)
{
  const BandElement& element = layered.Elements[e];
  return layered.IsInserted(e) &&
    std::any_of(
      element.begin(), element.end(), [&](int n) { return bare[NodeWithoutLayer(layered, n)]; });
}

}
