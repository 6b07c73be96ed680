/**
 * @file HexMesh.h
 * @brief A read-only view of an unstructured grid's raw arrays, for loops over the whole mesh.
 *
 * Debian's VTK is built without optimisation, so nothing of it is called per node or cell:
 * the pointers are taken once. The grid must outlive the view.
 */
#ifndef HexMesh_h
#define HexMesh_h

#include "PageVector.h"
#include "Types.h"

#include <array>
#include <cstring>
#include <string>

class vtkUnstructuredGrid;

namespace trim
{
using nurbs::PageVector;
using nurbs::UnsetVector;

struct HexMesh
{
  Id NumberOfPoints = 0;
  Id NumberOfCells = 0;
  const double* PointsDouble = nullptr; ///< one of the two is set
  const float* PointsFloat = nullptr;
  const vtkTypeInt64* Connectivity64 = nullptr; ///< the pair of one width is set
  const vtkTypeInt64* Offsets64 = nullptr;
  const vtkTypeInt32* Connectivity32 = nullptr;
  const vtkTypeInt32* Offsets32 = nullptr;
  Id ConnectivitySize = 0;
  const unsigned char* Types = nullptr;
  bool TurnsInsideOut = false; ///< OrientedCell looks for hexahedra that are inside out

  Vec3 Point(Id i) const
  {
    if (this->PointsDouble)
    {
      // Copied as a whole: a point that is stored number by number is slow to be read in pairs.
      Vec3 point;
      std::memcpy(point.data(), this->PointsDouble + 3 * i, sizeof(point));
      return point;
    }
    const float* p = this->PointsFloat + 3 * i;
    return Vec3(p[0], p[1], p[2]);
  }

  /// Node ids of cell c in the order of the grid; returns their number, 8 or 6.
  int Cell(Id c, std::array<Id, 8>& nodes) const
  {
    return this->Offsets64 ? Gather(this->Connectivity64, this->Offsets64, c, nodes)
                           : Gather(this->Connectivity32, this->Offsets32, c, nodes);
  }

  /// The same with the nodes in the order of ElementTopology.h even if the grid has them in the
  /// other one, as meshes that were mirrored have, and the wedges of VTK.
  int OrientedCell(Id c, std::array<Id, 8>& nodes) const
  {
    const int count = this->Cell(c, nodes);
    if (count == 6)
    {
      this->OrientWedge(nodes);
    }
    else if (this->TurnsInsideOut)
    {
      this->OrientHexahedron(nodes);
    }
    return count;
  }

  /// Hexahedra that are sound but for the order of their nodes.
  Id CountInsideOut() const;

  /// 8 or 6 of each cell from first to last.
  Id NumberOfNodes(Id first, Id last) const
  {
    return this->Offsets64 ? this->Offsets64[last + 1] - this->Offsets64[first]
                           : this->Offsets32[last + 1] - this->Offsets32[first];
  }

  Id FirstNode(Id c) const
  {
    return this->Offsets64 ? this->Connectivity64[this->Offsets64[c]]
                           : this->Connectivity32[this->Offsets32[c]];
  }

  /// Whether cells are free of the defects that ViewGrid tells; asked before anything else of cells
  /// that were not checked.
  bool AreGood(Id begin, Id end) const;

  /// Whether so many cells are hexahedra one after the other within the connectivity, whatever
  /// their nodes are.
  bool AreHexahedra(Id first, int count) const;

  // Inlined in any case: GCC leaves out calls of functions that do nothing else.

  /// Has the processor fetch the nodes of a cell that is asked for soon: of itself it does so
  /// within a page of memory only.
  EIGEN_ALWAYS_INLINE void Prefetch(Id c) const
  {
    this->PrefetchNode(8 * c); // most are hexahedra
  }

  /// The same for cells that are asked for here and there.
  EIGEN_ALWAYS_INLINE void PrefetchCell(Id c) const
  {
    __builtin_prefetch(this->Offsets64 ? static_cast<const void*>(this->Offsets64 + c)
                                       : static_cast<const void*>(this->Offsets32 + c));
    this->PrefetchNode(8 * c);
    this->PrefetchNode(8 * c + 7); // mostly in another line of the cache
  }

  /// Has the processor fetch the points of a cell.
  EIGEN_ALWAYS_INLINE void PrefetchPoints(Id c) const
  {
    std::array<Id, 8> nodes;
    const int count = this->Cell(c, nodes);
    for (int i = 0; i < count; ++i)
    {
      const Id first = 3 * nodes[i];
      __builtin_prefetch(this->PointsDouble ? static_cast<const void*>(this->PointsDouble + first)
                                            : static_cast<const void*>(this->PointsFloat + first));
    }
  }

private:
  EIGEN_ALWAYS_INLINE void PrefetchNode(Id place) const
  {
    if (place < this->ConnectivitySize)
    {
      __builtin_prefetch(this->Offsets64 ? static_cast<const void*>(this->Connectivity64 + place)
                                         : static_cast<const void*>(this->Connectivity32 + place));
    }
  }

  void OrientWedge(std::array<Id, 8>& nodes) const;
  bool OrientHexahedron(std::array<Id, 8>& nodes) const; ///< returns whether it had to

  template <typename T>
  static int Gather(const T* connectivity, const T* offsets, Id c, std::array<Id, 8>& nodes)
  {
    const T first = offsets[c];
    const int count = static_cast<int>(offsets[c + 1] - first);
    if (count == 8) // most are: a copy of known length needs no call
    {
      for (int i = 0; i < 8; ++i)
      {
        nodes[i] = connectivity[first + i];
      }
      return count;
    }
    for (int i = 0; i < count; ++i)
    {
      nodes[i] = connectivity[first + i];
    }
    return count;
  }
};

/**
 * Takes the view of a grid. Returns false with an error that names the cell or point and the
 * remedy if the grid holds cells that are neither hexahedra nor wedges, cells with a wrong
 * number of nodes, node ids out of range or repeated, or coordinates that are not finite.
 */
bool ViewGrid(vtkUnstructuredGrid* grid, HexMesh& mesh, std::string& error);

/// The same without a look at each cell and point: true does not tell that these are free of
/// defects.
bool ViewUnchecked(vtkUnstructuredGrid* grid, HexMesh& mesh);

}

#endif
