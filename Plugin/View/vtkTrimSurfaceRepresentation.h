/**
 * @class vtkTrimSurfaceRepresentation
 * @brief shows the surface of a trimmed grid
 *
 * As vtkGeometryRepresentationWithFaces, but faster: the surface is extracted by
 * vtkHexahedralSkinFilter, and edges that have faded everywhere are not drawn.
 */
#ifndef vtkTrimSurfaceRepresentation_h
#define vtkTrimSurfaceRepresentation_h

#include "NURBSTrimViewModule.h" // For export macro
#include "vtkGeometryRepresentationWithFaces.h"

class NURBSTRIMVIEW_EXPORT vtkTrimSurfaceRepresentation : public vtkGeometryRepresentationWithFaces
{
public:
  static vtkTrimSurfaceRepresentation* New();
  vtkTypeMacro(vtkTrimSurfaceRepresentation, vtkGeometryRepresentationWithFaces);

protected:
  vtkTrimSurfaceRepresentation();
  ~vtkTrimSurfaceRepresentation() override = default;

  void UpdateColoringParameters() override;

private:
  vtkTrimSurfaceRepresentation(const vtkTrimSurfaceRepresentation&) = delete;
  void operator=(const vtkTrimSurfaceRepresentation&) = delete;

  bool HaveEdgesFaded();
};

#endif
