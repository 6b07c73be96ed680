/**
 * @file CADUnion.h
 * @brief What bodies of a CAD file fill together.
 */
#ifndef CADUnion_h
#define CADUnion_h

#include "CADModel.h"
#include "CADSolids.h"

#include <BRepAlgoAPI_Fuse.hxx>
#include <Message_ProgressRange.hxx>

namespace nurbs
{
enum class UnionOutcome
{
  Joined,
  Apart, ///< nothing to join
  Failed ///< not soundly
};

/// The union of bodies by OpenCASCADE's general fuse, and where its faces come from.
class CADUnion
{
public:
  /// @param bodies closed solids, not inside out, two at least.
  CADUnion(const std::vector<TopoDS_Shape>& bodies, const Message_ProgressRange& progress);

  /// Whether it is to be had and is what the bodies are: closed, valid by OpenCASCADE's own check,
  /// neither less than the largest body nor more than all, and the same space.
  UnionOutcome Judge();

  /// Whether nothing is left of the faces of a body that was sewn: it may be a void in another one.
  bool SwallowsSewn(const std::vector<CADFace>& faces);

  const TopoDS_Shape& Shape() { return this->Fuse.Shape(); }

  /// Of each face of the bodies given the faces of the union that are it, or a part of it; see
  /// PartsOf.
  std::vector<std::vector<CADFace>> TakeFaces(const std::vector<CADFace>& faces)
  {
    return PartsOf(faces, *this->Fuse.History(), this->Fuse.Shape());
  }

private:
  std::vector<TopoDS_Shape> Given;
  BRepAlgoAPI_Fuse Fuse;
};
}

#endif
