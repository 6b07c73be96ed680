/**
 * @class   vtkTrimLineSource
 * @brief   lines, open or closed, swept along a direction into NURBS surfaces to trim with
 *
 * A line is given by points: the very curve that ParaView's spline widget shows
 * (vtkParametricSpline: a cubic spline over the chord length, its first derivative zero at open
 * ends, periodic if closed), or straight pieces with sharp corners. Or it comes from a file: points
 * from a CSV file, or the curves of an IGES or STEP file that belong to no face, joined end to end
 * within the file's tolerance whatever their order and direction, exactly (arcs stay arcs).
 *
 * The line is swept along Direction by Length to either side. Where these are zero, the default,
 * they are found: with a mesh on the input port, the axis that its skin's normals have on the whole
 * near the line, and a length that passes through the whole mesh; without, the normal of what a
 * closed line encloses or else 0 0 1, and the size of the line.
 *
 * Input (optional): the mesh to be trimmed, a vtkUnstructuredGrid of hexahedra and wedges or a
 * composite of such. It is looked at for Direction and Length only; without hexahedra and wedges it
 * is of no use, and a warning says so.
 *
 * Output: a vtkPolyData with a tessellation, for the eye, and the exact surface, of the line's
 * degree x 1, in its field data (NURBSFieldData.h); if a file holds several lines, a
 * vtkMultiBlockDataSet of such, together one trimming surface. Field data of each poly data also
 * has `Direction` and `Length` as they were used.
 *
 * vtkTrimHexahedralGrid eliminates the side that the normal points to. The normal of a closed line
 * points to what it encloses, whichever way round it was drawn: a hole is cut. A closed line
 * within another one keeps what it encloses (even-odd rule): of an outer contour with holes, the
 * offcut is what the filter keeps, unless its InvertSide is set. The normal of an open line points
 * to its right, seen with Direction pointing to the viewer; among several lines of a file open
 * ones are turned so that they agree on what goes.
 *
 * Fewer than 2 points (3 if closed), values that are not finite, consecutive points that coincide,
 * a Direction along the line, a negative Length, a closed line that encloses nothing, lines that
 * cross or turn back on themselves or cross each other, a file that cannot be read, is damaged or
 * holds no curve, and curves of which more than two meet are one error that says where and what to
 * change, and the output is empty. IGES and STEP files are read by a forked process, as in
 * vtkCADSurfaceReader.
 *
 * @sa vtkNURBSSurfaceSource vtkCADSurfaceReader vtkTrimHexahedralGrid
 */
#ifndef vtkTrimLineSource_h
#define vtkTrimLineSource_h

#include "NURBSTrimReadModule.h" // For export macro
#include "vtkPolyDataAlgorithm.h"

#include <memory> // For what is kept between updates
#include <vector> // For the points

class vtkMultiProcessController;

class NURBSTRIMREAD_EXPORT vtkTrimLineSource : public vtkPolyDataAlgorithm
{
public:
  static vtkTrimLineSource* New();
  vtkTypeMacro(vtkTrimLineSource, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /**
   * Connects the mesh to the input port, whatever `port` says: the same as SetInputConnection, for
   * proxies. There the mesh must not count as the first input, which pvpython would connect to
   * whatever source is active.
   */
  void SetSheetConnection(int port, vtkAlgorithmOutput* mesh);

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

  /// How points are joined.
  enum LineTypes
  {
    SPLINE = 0,
    POLYLINE = 1
  };

  ///@{
  /**
   * A smooth curve through the points, or straight pieces that keep the corners. Default SPLINE;
   * other numbers than these two are an error.
   */
  vtkSetMacro(LineType, int);
  vtkGetMacro(LineType, int);
  ///@}

  ///@{
  /**
   * The direction of the sweep, of any length. Default 0 0 0: found by the mesh on the input port
   * or by the line.
   */
  vtkSetVector3Macro(Direction, double);
  vtkGetVector3Macro(Direction, double);
  ///@}

  ///@{
  /**
   * How far the sweep reaches to either side of the line. Default 0: found by the mesh on the input
   * port or by the line.
   */
  vtkSetMacro(Length, double);
  vtkGetMacro(Length, double);
  ///@}

  ///@{
  /**
   * A file that takes the place of the points above: CSV with x, y, z in each line, where a last
   * point that repeats the first closes the line, or IGES or STEP, told by the content, whose
   * curves are open or closed by themselves. Default: none.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * The unit of what is read from an IGES or STEP file, one of vtkCADSurfaceReader::LengthUnits.
   * Default: millimetres.
   */
  vtkSetMacro(LengthUnit, int);
  vtkGetMacro(LengthUnit, int);
  ///@}

  ///@{
  /**
   * The tessellation has at least this many strips along either direction. It is for the eye
   * only. Default 64, range 1 to 1000.
   */
  vtkSetClampMacro(Resolution, int, 1, 1000);
  vtkGetMacro(Resolution, int);
  ///@}

  ///@{
  /**
   * The ranks that have the pieces of the mesh; all of them come to the same direction and length.
   * Default: the global controller.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

protected:
  vtkTrimLineSource();
  ~vtkTrimLineSource() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestDataObject(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector);
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  std::vector<double> Points; ///< three values each
  vtkTypeBool Closed = 0;
  int LineType = SPLINE;
  double Direction[3] = { 0.0, 0.0, 0.0 };
  double Length = 0.0;
  char* FileName = nullptr;
  int LengthUnit = 0;
  int Resolution = 64;
  vtkMultiProcessController* Controller = nullptr;

private:
  struct Cache;
  /// Sees that the lines, and what is wrong with them, are those of the points or the file.
  const Cache& TakeLines();
  void MakeLines();
  std::unique_ptr<Cache> Kept;

  vtkTrimLineSource(const vtkTrimLineSource&) = delete;
  void operator=(const vtkTrimLineSource&) = delete;
};

#endif
