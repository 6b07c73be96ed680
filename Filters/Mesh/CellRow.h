/**
 * @file CellRow.h
 * @brief Rows of hexahedra, as most meshes have them: each begins with the face that the one before
 * ends with, so that a row has four lines of nodes, and half as many to look at as its cells have.
 */
#ifndef CellRow_h
#define CellRow_h

#include "HexMesh.h"

#include <array>
#include <type_traits>

namespace trim
{

/// Nodes of the two faces that an axis of a hexahedron begins and ends with, opposite each other.
struct RowAxis
{
  std::array<int, 4> Begin, End;
};
inline constexpr std::array<RowAxis, 3> RowAxes{ { { { 0, 3, 4, 7 }, { 1, 2, 5, 6 } },
  { { 0, 1, 4, 5 }, { 3, 2, 7, 6 } }, { { 0, 1, 2, 3 }, { 4, 5, 6, 7 } } } };

/// The axis, by its place in RowAxes, of two hexahedra the second of which begins with the face
/// that the first ends with; -1: there is none.
template <typename Nodes>
int AxisOfRow(const Nodes& before, const Nodes& nodes)
{
  for (std::size_t axis = 0; axis < RowAxes.size(); ++axis)
  {
    bool same = true;
    for (int i = 0; i < 4; ++i)
    {
      same &= nodes[RowAxes[axis].Begin[i]] == before[RowAxes[axis].End[i]];
    }
    if (same)
    {
      return static_cast<int>(axis);
    }
  }
  return -1;
}

/// So many hexahedra in a row.
struct CellRow
{
  static constexpr int Cells = 16;
  using Line = std::array<Id, Cells + 1>;

  int Axis;                  ///< in RowAxes
  std::array<Line, 4> Lines; ///< of nodes: by the corner of the face that a cell begins with
  bool Counts;               ///< each node is the one before it in its line, plus one

  /// Calls action(corner, node) for the corners of a cell.
  template <typename Action>
  void ForCorners(int cell, const Action& action) const
  {
    const RowAxis& axis = RowAxes[this->Axis];
    for (int i = 0; i < 4; ++i)
    {
      action(axis.Begin[i], this->Lines[i][cell]);
      action(axis.End[i], this->Lines[i][cell + 1]);
    }
  }

  /// Takes the cells from `first` on, which need not be good; false if they are no row or have a
  /// defect.
  bool Take(const HexMesh& mesh, Id first)
  {
    return mesh.Offsets64 ? this->Take(mesh, mesh.Connectivity64, mesh.Offsets64, first)
                          : this->Take(mesh, mesh.Connectivity32, mesh.Offsets32, first);
  }

private:
  template <typename T>
  bool Take(const HexMesh& mesh, const T* connectivity, const T* offsets, Id first)
  {
    if (first + Cells > mesh.NumberOfCells || !mesh.AreHexahedra(first, Cells))
    {
      return false;
    }
    const T* const nodes = connectivity + offsets[first];
    this->Axis = AxisOfRow(nodes, nodes + 8);
    this->Counts = this->Axis >= 0 && Count(nodes);
    if (this->Counts)
    {
      this->TakeCounting(nodes);
      return mesh.AreGood(first, first + 1) && mesh.AreGood(first + Cells - 1, first + Cells);
    }
    return this->Axis >= 0 && this->TakeLines(nodes, RowAxes[this->Axis]) &&
      mesh.AreGood(first, first + Cells);
  }

  /// Whether the nodes of each cell are those of the one before, plus one.
  template <typename T>
  static bool Count(const T* nodes)
  {
    using Unsigned = std::make_unsigned_t<T>; // which may overflow
    Unsigned differ = 0;
    for (int i = 0; i < 8 * (Cells - 1); ++i)
    {
      differ |= static_cast<Unsigned>(nodes[i + 8]) - static_cast<Unsigned>(nodes[i]) - 1;
    }
    return differ == 0;
  }

  template <typename T>
  void TakeCounting(const T* nodes)
  {
    for (int i = 0; i < 4; ++i)
    {
      const Id begin = nodes[RowAxes[this->Axis].Begin[i]];
      for (int s = 0; s <= Cells; ++s)
      {
        this->Lines[i][s] = begin + s;
      }
    }
  }

  template <typename T>
  bool TakeLines(const T* nodes, const RowAxis& axis)
  {
    bool joined = true;
    for (int i = 0; i < 4; ++i)
    {
      this->Lines[i][0] = nodes[axis.Begin[i]];
      for (int c = 0; c < Cells; ++c)
      {
        joined &= nodes[8 * c + axis.Begin[i]] == this->Lines[i][c];
        this->Lines[i][c + 1] = nodes[8 * c + axis.End[i]];
      }
    }
    return joined;
  }
};

}

#endif
