/**
 * @class   vtkTrimLineSource
 * @brief   a line of points, open or closed, swept along a direction into a NURBS surface
 *
 * The line is the very curve that ParaView's spline widget shows (vtkParametricSpline: a cubic
 * spline over the chord length, its first derivative zero at open ends, periodic if closed), as
 * one cubic B-spline. It is swept along Direction by Length to either side.
 *
 * Output: a vtkPolyData with a tessellation, for the eye, and the exact surface, of degrees
 * 3 x 1, in its field data (NURBSFieldData.h). vtkTrimHexahedralGrid eliminates the side that the
 * normal points to. The normal of a closed line points to what it encloses, whichever way round
 * it was drawn: a hole is cut. That of an open line points to its right, seen with Direction
 * pointing to the viewer.
 *
 * Fewer than 2 points (3 if closed), values that are not finite, consecutive points that coincide,
 * a Direction that is zero or along the line, a Length that is not positive, a closed line that
 * encloses nothing and a file that cannot be read are one error that says what has to be changed,
 * and the output is empty.
 *
 * @sa vtkNURBSSurfaceSource vtkTrimHexahedralGrid
 */
#ifndef vtkTrimLineSource_h
#define vtkTrimLineSource_h

#include "NURBSTrimReadModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"

#include <vector> // For the points

class NURBSTRIMREAD_EXPORT vtkTrimLineSource : public vtkPolyDataAlgorithm
{
public:
  static vtkTrimLineSource* New();
  vtkTypeMacro(vtkTrimLineSource, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The points of the line. SetNumberOfPoints changes the number, keeping what is there; the
   * index counts from 0, and SetPoint beyond the end makes the line longer. Default: five points
   * of a wave along x from -0.5 to 0.5 in the plane z = 0.
   */
  void SetNumberOfPoints(int count);
  int GetNumberOfPoints();
  void SetPoint(int index, double x, double y, double z);
  void GetPoint(int index, double point[3]);
  ///@}

  ///@{
  /**
   * Does the line return from its last point to the first? Default 0.
   */
  vtkSetMacro(Closed, vtkTypeBool);
  vtkGetMacro(Closed, vtkTypeBool);
  vtkBooleanMacro(Closed, vtkTypeBool);
  ///@}

  ///@{
  /**
   * The direction of the sweep, of any length. Default 0 0 1.
   */
  vtkSetVector3Macro(Direction, double);
  vtkGetVector3Macro(Direction, double);
  ///@}

  ///@{
  /**
   * How far the sweep reaches to either side of the line. Default 1.
   */
  vtkSetMacro(Length, double);
  vtkGetMacro(Length, double);
  ///@}

  ///@{
  /**
   * A CSV file of points, x, y, z in each line, which then take the place of those above. A
   * closed line may repeat its first point at the end. Default: none.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * The tessellation has at least this many strips along either direction. It is for the eye
   * only. Default 64, range 1 to 1000.
   */
  vtkSetClampMacro(Resolution, int, 1, 1000);
  vtkGetMacro(Resolution, int);
  ///@}

protected:
  vtkTrimLineSource();
  ~vtkTrimLineSource() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  std::vector<double> Points; // three values each
  vtkTypeBool Closed = 0;
  double Direction[3] = { 0.0, 0.0, 1.0 };
  double Length = 1.0;
  char* FileName = nullptr;
  int Resolution = 64;

private:
  vtkTrimLineSource(const vtkTrimLineSource&) = delete;
  void operator=(const vtkTrimLineSource&) = delete;
};

#endif
