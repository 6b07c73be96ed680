/**
 * @file TrimInputs.h
 * @brief The grid and the trimming surface of a trim, with all that depends on one of them alone:
 * it is kept until that one changes.
 */
#ifndef TrimInputs_h
#define TrimInputs_h

#include "GhostCells.h"
#include "GridState.h"
#include "HexMesh.h"
#include "MeshBlocks.h"
#include "SharedNodes.h"
#include "TrimmingSurface.h"

#include <vtkDataObject.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkWeakPointer.h>

#include <memory>
#include <string>
#include <vector>

namespace trim
{

class TrimInputs
{
public:
  /**
   * Takes what has changed of the inputs, and shares it among the ranks. Collective.
   *
   * @param grid an unstructured grid, a composite with one, or null if there is none.
   * @param surface poly data that carries NURBS surfaces, or null if there is none.
   * @param error what is wrong and what to do; the same on all ranks.
   * @return false, on all ranks, with an error.
   */
  bool Take(vtkDataObject* grid, vtkDataObject* surface, const Ranks& ranks, std::string& error);

  /// The ranks are others from now on.
  void ForgetOtherRanks();

  // After Take:
  const OwnCells& Own() const { return this->TheOwn; } ///< the grid without ghost cells
  const HexMesh& Mesh() const { return this->TheMesh; }
  const MeshBlocks& Blocks() const { return this->TheBlocks; }
  const SharedNodes& Shared() const { return this->TheShared; }
  /// Of the nodes, where they tell those of several ranks apart; else null.
  const Id* GlobalIds() const;
  nurbs::TrimmingSurface& Surface() const { return *this->TheSurface; }
  /// What is to be said of the grid, its pieces and the surface. The same on all ranks.
  std::vector<std::string> Remarks() const;

private:
  bool TakeGrid(vtkUnstructuredGrid* grid, std::string& error);
  bool TakeChecked(vtkUnstructuredGrid* grid, std::string& error);
  bool TakeSurface(vtkDataObject* data, std::string& error);
  /// Collective: what the pieces have in common.
  bool JoinPieces(const Ranks& ranks, std::string& error);
  /// Collective: all faces on each rank, unless their surface is made.
  /// @param[out] faces none if it is.
  bool JoinFaces(const Ranks& ranks, std::vector<nurbs::NurbsSurface>& faces, std::string& error);
  /// Collective: the whole surface on each rank, with gaps for this grid.
  /// @param faces none if it is made already, for another grid maybe.
  void MakeSurface(const Ranks& ranks, std::vector<nurbs::NurbsSurface> faces);

  const vtkNew<vtkUnstructuredGrid> NoGrid; ///< stands for that of a composite without one
  vtkWeakPointer<vtkUnstructuredGrid> Grid;
  nurbs::GridState StateOfGrid;
  OwnCells TheOwn;
  HexMesh TheMesh;
  MeshBlocks TheBlocks;
  bool Joined = false; ///< TheBlocks and TheShared know of the other ranks' pieces
  SharedNodes TheShared;
  vtkSmartPointer<vtkIdTypeArray> TheGlobalIds; ///< of this piece; null: they are not used
  std::string OwnSurplus;                       ///< arrays of this rank's piece that are too long
  Id OwnInsideOut = 0;                          ///< hexahedra of this rank's piece
  Id OwnWedges = 0;                             ///< hexahedra of this rank's piece, see WithWedges
  std::vector<std::string> GridRemarks;         ///< empty ones: nothing is to be said

  vtkWeakPointer<vtkDataObject> SurfaceData;
  std::vector<nurbs::GridState> SurfaceStates;
  std::vector<nurbs::NurbsSurface> OwnFaces; ///< those that this rank was given
  std::vector<Id> BlocksOfFaces;
  std::vector<Vec3> Shown; ///< see SamplePolygons
  std::string SurfaceRemark;
  double SizeOfFaces = 0.0; ///< of the box of all ranks' control points
  double SizeOfGaps = 0.0;  ///< the size that the gaps of the surface go by
  std::unique_ptr<nurbs::TrimmingSurface> TheSurface; ///< of all ranks' faces; null: not made yet
};

}

#endif
