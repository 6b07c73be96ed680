/**
 * @file CADModel.h
 * @brief The faces of an IGES or STEP file as OpenCASCADE transfers them, with their names.
 */
#ifndef CADModel_h
#define CADModel_h

#include "CADFormat.h"

#include <TopoDS_Shape.hxx>

#include <functional>
#include <string>
#include <vector>

namespace nurbs
{
struct CADFace
{
  TopoDS_Shape Shape;    ///< a face, in millimetres, with its location and orientation
  std::string Name;      ///< the file's name for it, or empty
  std::string OwnerName; ///< the nearest named shell, body or product around it, or empty
  /// Part of the surface's parameters u, u, v, v that the file restricts the face to, where
  /// OpenCASCADE does not; empty: all of it.
  std::vector<double> Range;
};

struct CADModel
{
  std::vector<CADFace> Faces;
  bool HasCurves = false; ///< there are edges that belong to no face
  int Untransferred = 0;  ///< surfaces in the file of which OpenCASCADE made no face
};

/**
 * Reads and transfers a whole file. OpenCASCADE is kept from printing meanwhile; its exceptions
 * pass through.
 *
 * @return false with `error` (without the file's name) if it cannot be read; also when
 * `progress` (0..1) returns false, then with an empty `error`.
 */
bool ReadCADModel(const std::string& path, CADFormat format, CADModel& model, std::string& error,
  const std::function<bool(double)>& progress);
}

#endif
