/**
 * @class vtkTrimRepresentation
 * @brief shows a trimmed grid in any of ParaView's styles
 *
 * The styles that show the surface are vtkTrimSurfaceRepresentation's. View.xml adds them after
 * those that it inherits, which they replace.
 */
#ifndef vtkTrimRepresentation_h
#define vtkTrimRepresentation_h

#include "NURBSTrimViewModule.h" // For export macro
#include "vtkPVCompositeRepresentation.h"

class NURBSTRIMVIEW_EXPORT vtkTrimRepresentation : public vtkPVCompositeRepresentation
{
public:
  static vtkTrimRepresentation* New();
  vtkTypeMacro(vtkTrimRepresentation, vtkPVCompositeRepresentation);

  /// Replaces the style of this name without the superclass' warning.
  void AddRepresentation(const char* key, vtkPVDataRepresentation* repr) override;

protected:
  vtkTrimRepresentation() = default;
  ~vtkTrimRepresentation() override = default;

private:
  vtkTrimRepresentation(const vtkTrimRepresentation&) = delete;
  void operator=(const vtkTrimRepresentation&) = delete;
};

#endif
