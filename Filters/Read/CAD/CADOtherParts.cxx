#include "CADOtherParts.h"

#include "CADFaceConversion.h"

#include <TopoDS.hxx>
#include <TopoDS_Face.hxx>

#include <algorithm>
#include <map>
#include <set>

namespace nurbs
{
namespace
{
/// Finds the faces from pole to pole of which OpenCASCADE has taken the wrong part. It turns such a
/// face round to fit its neighbours: in its shell it is of the few that face as the file says while
/// the others do not, or the other way round.
class OtherParts
{
public:
  OtherParts(CADModel& model, const SenseOfFace& senseOf)
    : Model(model)
    , SenseOf(senseOf)
  {
    for (CADFace& face : model.Faces)
    {
      if (face.Shell >= 0 && this->SenseOf(face))
      {
        this->Shells[face.Shell].push_back(&face);
      }
    }
  }

  void Mark()
  {
    std::map<int, std::set<int>> ofBody;
    for (const CADFace& face : this->Model.Faces)
    {
      ofBody[face.Body].insert(face.Shell);
    }
    for (const auto& shell : this->Shells)
    {
      const int body = shell.second.front()->Body;
      if (this->MarkIn(shell.second) && body >= 0 && ofBody[body].size() == 1)
      {
        this->Orient(shell.second);
      }
    }
  }

private:
  bool FacesAsSaid(const CADFace& face) const
  {
    return *this->SenseOf(face) == (face.Shape.Orientation() == TopAbs_FORWARD);
  }

  /// Whether there are any.
  bool MarkIn(const std::vector<CADFace*>& shell)
  {
    const auto asSaid = std::count_if(
      shell.begin(), shell.end(), [this](const CADFace* face) { return this->FacesAsSaid(*face); });
    const auto others = static_cast<std::ptrdiff_t>(shell.size()) - asSaid;
    bool any = false;
    for (CADFace* face : shell)
    {
      const bool isOfFew = this->FacesAsSaid(*face) ? asSaid < others : others < asSaid;
      if (isOfFew && HasOtherPart(TopoDS::Face(face->Shape)))
      {
        face->IsOtherPart = any = true;
        face->Shape.Reverse();
      }
    }
    return any;
  }

  /// As the file says: the wrong part may have turned the whole shell inside out. Not where voids
  /// face the other way.
  void Orient(const std::vector<CADFace*>& shell)
  {
    for (CADFace* face : shell)
    {
      face->Shape.Orientation(*this->SenseOf(*face) ? TopAbs_FORWARD : TopAbs_REVERSED);
    }
  }

  CADModel& Model;
  const SenseOfFace& SenseOf;
  std::map<int, std::vector<CADFace*>> Shells;
};
}

//------------------------------------------------------------------------------
void MarkOtherParts(CADModel& model, const SenseOfFace& senseOf)
{
  OtherParts(model, senseOf).Mark();
}
}
