/**
 * @file NURBSFieldData.h
 * @brief How poly data carries NURBS surfaces: the exact surface lies in the field data.
 *
 * The points and polygons of such poly data are a tessellation, for the eye; the exact surface
 * is in these field arrays, so that it survives a .vtp file:
 *
 * | field array               | tuples x components | meaning                                    |
 * |---------------------------|---------------------|--------------------------------------------|
 * | NURBSDegrees (int)        | 1 x 2               | p, q                                       |
 * | NURBSControlNetSize (int) | 1 x 2               | n+1, m+1                                   |
 * | NURBSControlPoints        | (n+1)(m+1) x 4      | x y z w, Cartesian, u running fastest      |
 * | NURBSKnotsU, NURBSKnotsV  | (n+p+2) x 1, ...    | non-decreasing, clamped or not             |
 * | NURBSTrimLoops            | points x 2          | u, v of closed polygons (optional)         |
 * | NURBSTrimLoopOffsets (int)| loops+1 x 1         | where each loop begins in NURBSTrimLoops   |
 * | NURBSTolerance            | 1 x 1               | how far borders of joined faces may lie    |
 * |                           |                     | apart, as a length (optional)              |
 *
 * One surface per poly data; the faces of a shell are a composite data set of such poly data and
 * are together one trimming surface. The functions are in the namespace of the kernel, whose
 * types they take; none of them prints.
 */
#ifndef NURBSFieldData_h
#define NURBSFieldData_h

#include "NURBSTrimReadModule.h" // For export macro
#include "NurbsSurface.h"        // For nurbs::NurbsSurface

#include <string>
#include <vector>

class vtkDataObject;
class vtkFieldData;

namespace nurbs
{
/**
 * Writes the definition of `surface` to `fieldData` as double and int arrays. Arrays of the same
 * names are replaced; stale trim loops are removed when the surface has none.
 */
NURBSTRIMREAD_EXPORT void WriteNURBSFieldData(const NurbsSurface& surface, vtkFieldData* fieldData);

/**
 * Reads one surface from field data. Any numeric value type is accepted; tuples and components
 * have to be exactly those of the table above, and the surface must be free of defects
 * (nurbs::FindDefect).
 *
 * @return false with one line in `error` that names the array, what is wrong with it and what
 * was expected; `surface` is then unspecified.
 */
NURBSTRIMREAD_EXPORT bool ReadNURBSFieldData(
  vtkFieldData* fieldData, NurbsSurface& surface, std::string& error);

/// True if the field data holds at least one of the NURBS arrays.
NURBSTRIMREAD_EXPORT bool HasNURBSFieldData(vtkFieldData* fieldData);

/**
 * Reads the faces of one trimming surface from poly data, or from a composite of poly data
 * nested in any way (multi-block, partitioned data set, collection of such). Empty (null)
 * blocks are passed over.
 *
 * @return false with one line in `error` that names the block, by its name and index, if a
 * block is not poly data, has no NURBS definition or a defective one, or if there is no surface
 * at all.
 */
NURBSTRIMREAD_EXPORT bool ReadTrimmingSurface(
  vtkDataObject* data, std::vector<NurbsSurface>& surfaces, std::string& error);
}

#endif
