/**
 * @file CADModel.h
 * @brief The faces and free edges of an IGES or STEP file as OpenCASCADE transfers them, with their
 * names.
 */
#ifndef CADModel_h
#define CADModel_h

#include <TopAbs_ShapeEnum.hxx>
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
  int Body = -1;  ///< index of the body that it is of; -1: none
  int Shell = -1; ///< number of the shell that it is of; -1: none
  /// It goes from pole to pole, and OpenCASCADE has taken the wrong part of its surface.
  bool IsOtherPart = false;
  TopoDS_Shape InBody; ///< as its body has it, which was sewn; null where that is `Shape`
};

/// An edge that belongs to no face.
struct CADEdge
{
  TopoDS_Shape Shape; ///< in millimetres, with its location and orientation
  std::string Name;   ///< the file's name for it or for its nearest named owner, or empty
};

struct CADModel
{
  std::vector<CADFace> Faces;
  /// Solids, of the file or sewn, in millimetres, with location and orientation.
  std::vector<TopoDS_Shape> Bodies;
  std::vector<CADEdge> Edges;
  int Unjoined = 0;                    ///< bodies near each other that could not be joined
  int Untransferred = 0;               ///< surfaces in the file of which OpenCASCADE made no face
  int UntransferredCurves = 0;         ///< curves in the file that gave no edge
  std::vector<std::string> References; ///< other files that an assembly keeps its parts in
  double DrawnScale = 1.0; ///< of the model in an IGES file, which nothing applies to its places
};

/**
 * Reads and transfers a whole file, its format told by its content. OpenCASCADE is kept from
 * printing meanwhile; its exceptions pass through.
 *
 * @return false with one line in `error` that names the file, what is wrong and what to do; also
 * when `progress` (0..1) returns false, then with an empty `error`.
 */
bool ReadCADModel(const std::string& path, CADModel& model, std::string& error,
  const std::function<bool(double)>& progress);

/// Runs `work`; what OpenCASCADE or the standard library throws becomes one line in `error` that
/// names the file, and false.
bool CatchFailures(const std::string& path, std::string& error, const std::function<bool()>& work);

/// What `work` returns, or in a few words what OpenCASCADE or the standard library throws: what is
/// wrong with one face or curve is not to lose the others.
std::string CatchReason(const std::function<std::string()>& work);

/// How many shapes of a type a shape holds, those in it more than once each time.
int CountShapes(TopAbs_ShapeEnum type, const TopoDS_Shape& shape);

/// Appends to what there is to say of a file that its scale is not applied; nothing if it is 1.
void TellScale(const std::string& path, const CADModel& model, std::string& remarks);

/**
 * Reads a file and takes items from it.
 *
 * @param transferShare of the progress that reading and transferring take.
 * @param take          (model): fills `items`; false with an `error`.
 * @return              false with an `error`, and no items.
 */
template <typename Item, typename Take>
bool ReadItems(const std::string& path, std::vector<Item>& items, std::string& error,
  const std::function<bool(double)>& progress, double transferShare, const Take& take)
{
  items.clear();
  const bool success = CatchFailures(path, error,
    [&]
    {
      CADModel model;
      const auto transferProgress = [&](double share)
      { return !progress || progress(transferShare * share); };
      if (!ReadCADModel(path, model, error, transferProgress) || !take(model))
      {
        return false;
      }
      TellScale(path, model, error);
      return true;
    });
  if (!success)
  {
    items.clear();
  }
  return success;
}
}

#endif
