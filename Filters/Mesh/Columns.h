/**
 * @file Columns.h
 * @brief The through-thickness structure of a sheet: columns of elements, pillars of nodes.
 *
 * The paper's meshes are sheets of one or more layers, so each element has a thickness axis:
 * the one whose chain of elements from skin to skin is the shortest. It is found locally in the
 * band and carried from element to element through their lateral faces, never taken from a
 * global direction, so that formed parts have it too. A solid block has none; there the cut can
 * choose one.
 */
#ifndef Columns_h
#define Columns_h

#include "Band.h"

#include <algorithm>
#include <functional>
#include <vector>

namespace trim
{

struct Columns
{
  std::vector<signed char> Axis; ///< thickness axis of each element, -1: none
  std::vector<int> Column;       ///< of each element: the smallest element of its column
  std::vector<int> Pillar;       ///< of each node: the smallest node of its pillar
  std::vector<int> Part; ///< of each element: those that faces join; empty: there is one alone
  /// Of each node: it has an element whose axis is by ChooseColumns; empty: there is none.
  std::vector<char> ChosenByCut;

  /// Of each column, ascending.
  Band::Lists Elements() const;

  /// Nodes of each pillar, by its number.
  Band::Lists Nodes() const;

  /// True if the columns of all elements up to this ring end at the skin, not at the band.
  bool Complete(const Band& band, int ring) const;

  /// A face that ends the thickness axis of its elements: skin or between layers.
  bool IsLayerFace(const Band& band, int face) const
  {
    const auto& f = band.Faces[face];
    const int axis = this->Axis[f.Element[0]];
    return axis >= 0 && TopologyOf(band.Elements[f.Element[0]].Count).FaceAxis[f.Slot[0]] == axis;
  }
  /// A node on the lateral border of a sheet, or anywhere on the exterior of a block.
  bool IsOnBorder(const Band& band, int node) const
  {
    const auto faces = band.FacesOfNode(node);
    return std::any_of(faces.begin(), faces.end(),
      [&](int f) { return band.Faces[f].Exterior && !this->IsLayerFace(band, f); });
  }
  bool IsChosenByCut(int node) const
  {
    return !this->ChosenByCut.empty() && this->ChosenByCut[node];
  }
  /// An edge from layer to layer.
  bool IsThicknessEdge(const Band& band, int edge) const
  {
    return this->Pillar[band.Edges[edge].First] == this->Pillar[band.Edges[edge].Second];
  }
  /// False for elements that have nodes in common at most, as at the end of a slit.
  bool InSamePart(int a, int b) const
  {
    return this->Part.empty() || this->Part[a] == this->Part[b];
  }
  bool HasThickness(int element) const { return this->Axis[element] >= 0; }
  bool AnyHasThickness() const
  {
    return std::any_of(
      this->Axis.begin(), this->Axis.end(), [](signed char axis) { return axis >= 0; });
  }
  bool AllHaveThickness() const
  {
    return std::all_of(
      this->Axis.begin(), this->Axis.end(), [](signed char axis) { return axis >= 0; });
  }
};

/// Whether a layer was inserted in a solid: its nodes have no places of their own yet, and need not
/// stay above each other.
inline bool HasLayerInSolid(const Band& band, const Columns& columns)
{
  return band.BeforeLayer && !columns.AnyHasThickness();
}

Columns FindColumns(const Band& band);

/**
 * Columns of sheets that meet at joints, as of a tee or a cross: each sheet has a thickness axis of
 * its own, which goes on along the width of another one, and the elements of the joint have none.
 * None at all where there are no such sheets.
 */
Columns FindJoinedSheets(const Band& band);

/// How far the cut wanders along an element, in elements, by element and axis.
using AxisShift = std::function<double(int, int)>;

/**
 * Gives the parts of a solid block the axis along which the cut wanders least. Where whole columns
 * stay or go no element has facets of the cut to all three sides at one corner, which no place of
 * its nodes makes valid; among elements that are decided one by one there always are such, for the
 * corner that lies farthest out along the surface's normal is one.
 *
 * @param largest way of the cut from end to end of a column, in the mean, that columns can follow.
 */
void ChooseColumns(const Band& band, const AxisShift& shift, double largest, Columns& columns);

/// Columns of a band that is to be treated as a solid block: every element for itself.
/// @param part of each element, see Columns::Part.
Columns NoColumns(const Band& band, std::vector<int> part);

}

#endif
