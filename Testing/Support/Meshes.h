/**
 * @file Meshes.h
 * @brief Input grids for the tests, with data arrays of many kinds on them.
 */
#ifndef Meshes_h
#define Meshes_h

#include "Model.h"

#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <functional>
#include <initializer_list>
#include <string>
#include <vector>

namespace judge
{
/// A box round the mesh, turned as the mesh is: the third axis is the thickness.
struct Frame
{
  Vec3 Centre = Vec3::Zero();
  Eigen::Matrix3d Axes = Eigen::Matrix3d::Identity();
  double HalfX = 1, HalfY = 1, HalfZ = 1;
  double ElementSize = 1;    ///< the longest edge in the plane of the first two axes, about
  double LayerThickness = 0; ///< of one element of a sheet; 0: no thickness direction
};

struct MeshOptions
{
  bool Float = false;    ///< points in single precision
  bool Short = false;    ///< 32-bit connectivity
  bool Permuted = false; ///< points and cells numbered at random
  double Perturbed = 0;  ///< inner columns moved in the plane, in element sizes
  bool Data = true;      ///< arrays of all kinds
  double Scale = 1;      ///< of the whole mesh, before the shift
  Vec3 Shift = Vec3::Zero();
  unsigned Seed = 1;
};

struct Mesh
{
  std::string Name;
  vtkSmartPointer<vtkUnstructuredGrid> Grid;
  Frame Box;
  bool Flat = true;           ///< skin is plane: volumes of parts are comparable
  bool Sheet = true;          ///< has a thickness direction
  double BorderTurn = 0;      ///< angle at the vertices of a polygonal border, radians
  bool Regular = false;       ///< rectangular sheet of equal elements, not permuted or perturbed
  int Nx = 0, Ny = 0, Nz = 0; ///< elements of a rectangular sheet; 0: it is none
};

/// Plain points and elements, before they become a grid.
struct RawMesh
{
  std::vector<Vec3> Points;
  std::vector<Element> Elements;

  void Add(int size, std::initializer_list<Id> nodes);
};

Frame BoxOf(const RawMesh& raw, double elementSize);

/// The grid of a mesh, scaled and shifted with its frame.
Mesh Finish(const std::string& name, const RawMesh& raw, Frame frame, const MeshOptions& options);

/// Puts each point elsewhere, and says so.
void MovePoints(vtkPointSet* data, const std::function<Vec3(const Vec3&)>& to);

/// Turns a sheet of elements of 1 x 1 inside out in such a way that no order of their nodes mends
/// it: all pillars but one of each element.
void FoldElements(vtkPointSet* sheet);

/// Arrays of several types, components and attributes on points, cells and the grid.
void AddData(vtkUnstructuredGrid* grid, unsigned seed);

// Where nothing else is said elements are 1 x 1 in the plane, of sheets 0.4 thick and of blocks 1;
// n is the number of elements along an edge, nz that of layers.

/// @param element sides of an element.
Mesh Sheet(int nx, int ny, int nz, const Vec3& element, const MeshOptions& options = {});
Mesh Block(int nx, int ny, int nz, const MeshOptions& options = {});
/// Sheets of nx x ny x nz elements of 1 x 1 x `layer`, each shifted as it is said, without data or
/// common nodes.
Mesh Sheets(int nx, int ny, int nz, double layer, const std::vector<Vec3>& shifts);
/// The first one is not shifted.
Mesh TwoSheets(int nx, int ny, int nz, double layer, const Vec3& shift);
/// Eight blocks of n^3 elements that have nodes in common at their edges alone, not on their faces.
Mesh BlocksJoinedAtEdges(int n);
/// What is left of a square without one of its quarters, about.
Mesh LShape(int n, int nz, const MeshOptions& options = {});
/// The hole is a square off the middle.
Mesh PlateWithHole(int n, int nz, const MeshOptions& options = {});
/// Three squares side by side, an element's width apart.
Mesh Islands(int n, int nz, const MeshOptions& options = {});
/// A fourth of the elements, drawn at random, are two wedges each.
Mesh SheetWithWedges(int nx, int ny, int nz, const MeshOptions& options = {});
/// Triangles split into three quadrilaterals each, extruded.
Mesh Irregular(int n, int nz, const MeshOptions& options = {});
/// Round blank (a square grid blown up to a polygon of 4 n sides).
Mesh Blank(int n, int rings, int nz, const MeshOptions& options = {});
/// A profile of bottom, walls and flanges with round bends between, n long.
Mesh Channel(int n, int nz, const MeshOptions& options = {});
/// A round blank bent to a part of a sphere.
Mesh Dome(int n, int nz, const MeshOptions& options = {});
/// A round blank drawn to bottom, wall and flange.
Mesh Cup(int n, int nz, const MeshOptions& options = {});

/// A sheet with a patch on one half of it: its columns have nz layers here and twice as many there.
Mesh PatchedSheet(int nx, int ny, int nz, const MeshOptions& options = {});

/// A few degrees of a solid of revolution about z, in one element: wedges on the axis, so that its
/// two sides meet there in a thin edge.
Mesh Segment(int nr, int nz, double angle, const MeshOptions& options = {});

/// A cube of n^3 cubes of 1 x 1 x 1, each divided into six tetrahedra, and these into four
/// hexahedra each, as some meshers make hexahedra.
/// @param bulge of the cube's faces; its edges are straight.
Mesh DividedTetrahedra(int n, double bulge, const MeshOptions& options = {});

/// A mesh of hexahedra and wedges from a file (.vtu), of which nothing is known; its frame is the
/// box round it, with the shortest side as thickness. Throws std::invalid_argument.
Mesh ReadMesh(const std::string& path);

/// By name, as the tests' arguments call them; throws std::invalid_argument.
Mesh MakeMesh(const std::string& name);
std::vector<std::string> MeshNames();

/// Others by name: tubes, bars, ribs, sheets of changing thickness, and some with odd corners. The
/// matrix does not have them.
Mesh MakePart(const std::string& name);

/// MeshNames() and these, but for those with odd corners.
std::vector<std::string> AllMeshNames();

}

#endif
