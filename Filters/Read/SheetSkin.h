/**
 * @file SheetSkin.h
 * @brief The skin of a mesh of hexahedra and wedges, node by node, to sweep a trim line through it.
 */
#ifndef SheetSkin_h
#define SheetSkin_h

#include "NurbsSurface.h"

#include <Eigen/Geometry>

#include <vector>

class vtkDataObject;

namespace nurbs
{
struct SheetSkin
{
  std::vector<Vec3> Points; ///< the nodes of the skin
  std::vector<Vec3> Areas;  ///< a fourth of the outward area vectors of the skin's faces round each
  Eigen::AlignedBox3d Box;  ///< of all nodes of elements

  /**
   * The axis that the skin's normals near these places have on the whole: the principal one,
   * weighted by area, of all nodes that are at most `reach` farther from a place than the node
   * nearest to it. Both skins of a sheet, whose normals are opposed, count alike. Its largest
   * coordinate is positive.
   */
  Vec3 MeanNormal(const std::vector<Vec3>& places, double reach) const;
};

/**
 * The skin of an unstructured grid, or of those in a composite. The area vectors of all faces of
 * all elements are added up at their nodes, where those of inner faces cancel each other. Elements
 * other than hexahedra and wedges are passed over.
 */
SheetSkin BuildSheetSkin(vtkDataObject* data);
}

#endif
