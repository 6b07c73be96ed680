/**
 * @class   vtkNURBSSurfaceSource
 * @brief   a NURBS surface from degrees, knots, control points and weights
 *
 * Output: a vtkPolyData with a tessellation, for the eye, and the exact surface in its field
 * data (NURBSFieldData.h). The tessellation carries normals along S_u x S_v: the side they point
 * to is the one that vtkTrimHexahedralGrid eliminates.
 *
 * The default is a gently waving bicubic surface of 7 x 4 control points that stands upright
 * about the plane x = 0, with y from -1 to 1 and z from -0.5 to 0.5; its normal points to
 * positive x.
 *
 * Knots, degrees and control points that do not fit together, knots that decrease, values that
 * are not finite and weights that are not positive are one error that says what has to be
 * changed, and the output is empty.
 *
 * @sa vtkCADSurfaceReader vtkTrimHexahedralGrid
 */
#ifndef vtkNURBSSurfaceSource_h
#define vtkNURBSSurfaceSource_h

#include "NURBSTrimReadModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"

#include <vector> // For the lists of numbers

class NURBSTRIMREAD_EXPORT vtkNURBSSurfaceSource : public vtkPolyDataAlgorithm
{
public:
  static vtkNURBSSurfaceSource* New();
  vtkTypeMacro(vtkNURBSSurfaceSource, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Degrees p and q along u and v, 1 to 25. Default 3, 3.
   */
  vtkSetVector2Macro(Degrees, int);
  vtkGetVector2Macro(Degrees, int);
  ///@}

  ///@{
  /**
   * Number of control points n+1 along u and m+1 along v; at least p+1 and q+1. Default 7, 4.
   */
  vtkSetVector2Macro(ControlNetSize, int);
  vtkGetVector2Macro(ControlNetSize, int);
  ///@}

  ///@{
  /**
   * The control points x y z w, Cartesian (not multiplied by the weight w), u running fastest;
   * as many as the product of ControlNetSize. SetNumberOfControlPoints changes the number,
   * keeping what is there; the index of SetControlPoint counts from 0.
   */
  void SetNumberOfControlPoints(int count);
  int GetNumberOfControlPoints();
  void SetControlPoint(int index, double x, double y, double z, double w);
  void GetControlPoint(int index, double point[4]);
  ///@}

  ///@{
  /**
   * The knots, non-decreasing, clamped or not: n+p+2 along u and m+q+2 along v.
   */
  void SetNumberOfKnotsU(int count);
  int GetNumberOfKnotsU();
  void SetKnotU(int index, double knot);
  double GetKnotU(int index);
  void SetNumberOfKnotsV(int count);
  int GetNumberOfKnotsV();
  void SetKnotV(int index, double knot);
  double GetKnotV(int index);
  ///@}

  ///@{
  /**
   * The tessellation has at least this many strips along either direction. It is for the eye
   * only. Default 32, range 1 to 1000.
   */
  vtkSetClampMacro(Resolution, int, 1, 1000);
  vtkGetMacro(Resolution, int);
  ///@}

protected:
  vtkNURBSSurfaceSource();
  ~vtkNURBSSurfaceSource() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  int Degrees[2] = { 3, 3 };
  int ControlNetSize[2] = { 7, 4 };
  std::vector<double> ControlPoints; ///< four values each
  std::vector<double> KnotsU;
  std::vector<double> KnotsV;
  int Resolution = 32;

private:
  vtkNURBSSurfaceSource(const vtkNURBSSurfaceSource&) = delete;
  void operator=(const vtkNURBSSurfaceSource&) = delete;

  void Resize(std::vector<double>& values, int count, int components);
  void SetValues(std::vector<double>& values, int index, const double* given, int components);
};

#endif
