#include "LayerRelaxation.h"

#include "InsertedLayer.h"
#include "Jacobian.h"
#include "JointRelaxation.h"
#include "Moves.h"
#include "Relaxation.h"

#include <algorithm>
#include <unordered_map>

namespace trim
{
namespace
{

/// The scaled Jacobian looks at corners only: the nodes of an element that is spoiled otherwise go
/// back to where all were.
void UndoSpoiled(const Band& layered, const BandQuality& quality,
  const std::vector<RelaxedElement>& elements, Moves& moves)
{
  const auto goBack = [&](int node)
  {
    const bool moved = moves.Position[node] != layered.Point[node];
    moves.Position[node] = layered.Point[node];
    return moved;
  };
  for (bool changed = true; changed;)
  {
    changed = false;
    for (std::size_t e = 0; e < elements.size(); ++e)
    {
      const auto& element = elements[e];
      const bool spoiled = element.Count > 0 && layered.HasInsertedNode(static_cast<int>(e)) &&
        quality.Spoils(static_cast<int>(e), PointsAt(moves.Position, element), element.Count);
      for (int i = 0; spoiled && i < element.Count; ++i)
      {
        changed |= goBack(element.Node[i]);
      }
    }
  }
}

/// Gives the inserted nodes of `cells` the places that those of the band have come to.
bool TakePlaces(const Band& layered, const Moves& moves, BandCells& cells)
{
  std::unordered_map<int, Vec3> places; // by the node in whose place each was inserted
  for (int n = 0; n < layered.NumberOfNodes(); ++n)
  {
    if (layered.IsInsertedNode(n) && moves.Position[n] != layered.Point[n])
    {
      places.emplace(layered.NodeOrigins[n].Index, moves.Position[n]);
    }
  }
  for (auto& node : cells.Nodes)
  {
    const auto place = node.From.Inserted ? places.find(node.From.Index) : places.end();
    node.Point = place == places.end() ? node.Point : place->second;
  }
  return !places.empty();
}

}

bool RelaxLayer(const Band& layered, const NodeMover& mover, const BandQuality& quality,
  double goal, const std::vector<char>& bare, const AbortCheck& aborted, BandCells& cells)
{
  std::vector<RelaxedElement> elements;
  std::vector<int> below;
  for (int e = 0; e < layered.NumberOfElements(); ++e)
  {
    const BandElement& element = layered.Elements[e];
    const bool stays = !IsOnBareNode(layered, bare, e);
    elements.push_back({ stays ? element.Count : 0, element.Node });
    if (stays && layered.HasInsertedNode(e) &&
      ScaledJacobian(PointsOf(layered, e), element.Count) < goal)
    {
      below.push_back(e);
    }
  }
  // On the skin, which is divided by the layer, they would leave the facets that the mesh came
  // with.
  std::vector<char> fixed;
  for (int n = 0; n < layered.NumberOfNodes(); ++n)
  {
    const auto faces = layered.FacesOfNode(n);
    fixed.push_back(!layered.IsInsertedNode(n) ||
      std::any_of(faces.begin(), faces.end(), [&](int f) { return layered.Faces[f].Exterior; }));
  }
  const std::vector<char> onCut(fixed.size(), 0);
  const RelaxationCase given{ layered, mover, elements, fixed, onCut, aborted };
  Moves moves = MoveNodes(layered, mover, onCut, Correction::None, {}); // none
  Relax(given, below, { goal, 0.0, Thorough }, moves);
  RelaxJointly(given, below, { goal, 0.0, Thorough }, moves);
  UndoSpoiled(layered, quality, elements, moves);
  return TakePlaces(layered, moves, cells);
}

}
