/**
 * @class vtkHexahedralSkinFilter
 * @brief ParaView's geometry filter, fast for a grid of hexahedra and wedges
 *
 * Makes of such a grid what vtkPVGeometryFilter makes of it: the facets that belong to one element
 * only, with all arrays and with the ids of points and cells. The arrays know their ranges, for
 * which ParaView would otherwise look. All other data, and ghost cells, are left to the superclass.
 */
#ifndef vtkHexahedralSkinFilter_h
#define vtkHexahedralSkinFilter_h

#include "NURBSTrimViewModule.h" // For export macro
#include "vtkPVGeometryFilter.h"

class vtkUnstructuredGrid;

class NURBSTRIMVIEW_EXPORT vtkHexahedralSkinFilter : public vtkPVGeometryFilter
{
public:
  static vtkHexahedralSkinFilter* New();
  vtkTypeMacro(vtkHexahedralSkinFilter, vtkPVGeometryFilter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Of all facets of the last output, 0 if they are not known.
  vtkGetMacro(LongestEdge, double);

protected:
  vtkHexahedralSkinFilter() = default;
  ~vtkHexahedralSkinFilter() override = default;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  double LongestEdge = 0.0;

  vtkHexahedralSkinFilter(const vtkHexahedralSkinFilter&) = delete;
  void operator=(const vtkHexahedralSkinFilter&) = delete;
};

#endif
