/**
 * @file Surfaces.h
 * @brief Trimming surfaces for the tests: NURBS on poly data, each with its oracle.
 */
#ifndef Surfaces_h
#define Surfaces_h

#include "Meshes.h"
#include "Oracle.h"

#include <vtkDataObject.h>
#include <vtkSmartPointer.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace judge
{
/// Where in a mesh's frame a surface goes.
struct Placement
{
  double X = 0.13, Y = -0.07; ///< in half sizes of the mesh
  double Angle = 0.3;         ///< about the thickness direction, radians
  double Lean = 0;            ///< from the thickness direction, radians
  double Size = 0.4;          ///< radius or half width, in the smaller half size of the mesh
  unsigned Seed = 1;          ///< of freeform shapes
  bool Reversed = false;      ///< normal turned round
};

struct Surface
{
  std::string Name;
  vtkSmartPointer<vtkDataObject> Data;
  std::shared_ptr<Oracle> Truth;
  double Sign = 1;                                                ///< of the oracle's distance
  double MinimumRadius = std::numeric_limits<double>::infinity(); ///< of curvature, in the grid
  bool HasPlane = false;                                          ///< the surface is a plane
  Vec3 PlanePoint = Vec3::Zero(), PlaneNormal = Vec3::UnitX();

  double Signed(const Vec3& p) const { return this->Sign * this->Truth->Signed(p); }
  double Roughly(const Vec3& p) const { return this->Sign * this->Truth->Roughly(p); }
};

/**
 * kind: plane, wavy, cylinder, cone, arc, scurve, contour, roundrect (a shell of eight faces,
 * oriented at random), slot (open at one end, crosses the sheet twice), trimmedface (plane with
 * trim loops that lie outside the grid). All part the grid if the placement lets them. Besides
 * sphere, torus and rectangle (four planes with sharp edges between them).
 */
Surface MakeSurface(const std::string& kind, const Frame& frame, const Placement& placement);

/// All kinds above, but for the last three.
std::vector<std::string> SurfaceKinds();

/// These three too.
std::vector<std::string> AllSurfaceKinds();

/// A plane that ends within the grid; its oracle knows the whole plane.
Surface EndingPlane(const Frame& frame, const Placement& placement);

/// A plane whose trim loop ends within the grid.
Surface EndingTrimLoop(const Frame& frame, const Placement& placement);

/// A plane of given point and normal, in model coordinates.
Surface PlaneThrough(const Vec3& point, const Vec3& normal, double halfSize);

/// A sphere in model coordinates, its poles along z; what is outside goes.
Surface SphereAt(const Vec3& centre, double radius);

/// A closed polyline through a sheet, as a drawn contour is: one surface of degree 1; what it holds
/// goes.
Surface Polyline(const std::vector<Vec2>& corners);

/// A round hole about (x, y), in elements of size 1 of a sheet from (0, 0) on; what is inside goes.
Surface RoundHole(const Mesh& sheet, double x, double y, double radius, double lean = 0);

/// Of sheets side by side along x, the second one from x = 9 on: spares a strip of that one, too
/// narrow for elements, and makes a hole in the first one, too small to be opened. Without an
/// oracle.
Surface StripAndHole(const Mesh& sheets);

/// Two as one trimming surface, of which no truth is known.
Surface Together(vtkDataObject* one, vtkDataObject* other);

/// The spline behind a poly data made here: rows of the contract read back.
SplineSurface ReadSpline(vtkPolyData* data);

}

#endif
