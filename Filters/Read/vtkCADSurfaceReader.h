/**
 * @class   vtkCADSurfaceReader
 * @brief   reads the NURBS surfaces of an IGES or STEP file
 *
 * Output: a vtkMultiBlockDataSet with one vtkPolyData for each face of the file, named as the
 * file names it ("Face 3" where it does not). The polygons are a tessellation, for the eye; the
 * exact surface is in the field data (NURBSFieldData.h), so that the whole is one trimming
 * surface for vtkTrimHexahedralGrid.
 *
 * The format is told by the content, whatever the file is called. Read are, of IGES, surfaces
 * alone or within others (types 108, 114, 118, 120, 122, 128, 140), trimmed and bounded surfaces
 * (144, 143) and solids; of STEP, solids, shells and geometric sets. Every face becomes a NURBS
 * surface restricted to the face's parameter range: planes, cylinders, cones, spheres, tori,
 * extrusions and revolutions exactly; offset surfaces without an analytic form are approximated.
 * S_u x S_v is the face's normal: outward for a solid. Trim loops are present where the face is
 * less than its parameter rectangle.
 *
 * Bodies that touch or cross each other are joined, see JoinBodies.
 *
 * A file that is missing, a directory, empty, cut short, neither IGES nor STEP, or without
 * surfaces is one error, and the output is empty. Faces that cannot be converted are one
 * warning.
 *
 * The file is read by a process forked for it, because OpenCASCADE crashes on many damaged files:
 * that too is one error then. How long it may take is said at TimeLimit.
 *
 * Not handled: compressed and binary IGES; layers, colours and the structure of assemblies
 * beyond names and placement; curves, which vtkTrimLineSource reads.
 *
 * @sa vtkNURBSSurfaceSource vtkTrimHexahedralGrid
 */
#ifndef vtkCADSurfaceReader_h
#define vtkCADSurfaceReader_h

#include "NURBSTrimReadModule.h" // For export macro
#include "vtkMultiBlockDataSetAlgorithm.h"

class NURBSTRIMREAD_EXPORT vtkCADSurfaceReader : public vtkMultiBlockDataSetAlgorithm
{
public:
  static vtkCADSurfaceReader* New();
  vtkTypeMacro(vtkCADSurfaceReader, vtkMultiBlockDataSetAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file to read. Default: none.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  /// Units of length of the output.
  enum LengthUnits
  {
    MILLIMETRE = 0,
    CENTIMETRE = 1,
    METRE = 2,
    INCH = 3,
    FOOT = 4,
    MICROMETRE = 5
  };

  ///@{
  /**
   * The unit of the output. The unit of the file is honoured: a length of 1 inch in the file is
   * 25.4 with MILLIMETRE, the default. Other numbers than those of LengthUnits are an error.
   */
  vtkSetMacro(LengthUnit, int);
  vtkGetMacro(LengthUnit, int);
  ///@}

  /// The length of one of LengthUnits.
  static double InMillimetres(int lengthUnit);

  ///@{
  /**
   * Whether bodies of the file that touch or cross each other, as those of an assembly do, are
   * joined to one: where two lie against each other there is no surface then. Otherwise such a
   * surface has its sides mixed up there. Closed shells of faces without a body are bodies, too.
   * What OpenCASCADE cannot join and open shells stay as they are. Default: true.
   */
  vtkSetMacro(JoinBodies, bool);
  vtkGetMacro(JoinBodies, bool);
  vtkBooleanMacro(JoinBodies, bool);
  ///@}

  ///@{
  /**
   * The tessellation has at least this many strips along either direction of a surface's
   * parameters. It is for the eye only. Default 16, range 1 to 1000.
   */
  vtkSetClampMacro(Resolution, int, 1, 1000);
  vtkGetMacro(Resolution, int);
  ///@}

  /**
   * 1 if the file begins like IGES or STEP, whatever it is called, or is called .igs, .iges, .stp
   * or .step, whatever it holds: to read it is to be told what is wrong with it. Else 0.
   */
  static int CanReadFile(VTK_FILEPATH const char* fileName);

  ///@{
  /**
   * Processor seconds after which a file is given up, as damaged ones can keep OpenCASCADE busy
   * for ever, or ten times as many by the clock; 0 (the default): 10, and 100 more for each
   * megabyte of the file. Where joining its bodies takes too long they are read without, in as much
   * again.
   */
  vtkSetClampMacro(TimeLimit, double, 0.0, 1e9);
  vtkGetMacro(TimeLimit, double);
  ///@}

protected:
  vtkCADSurfaceReader();
  ~vtkCADSurfaceReader() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int Read(vtkInformationVector* outputVector);

  char* FileName = nullptr;
  int LengthUnit = MILLIMETRE;
  bool JoinBodies = true;
  double TimeLimit = 0.0;
  int Resolution = 16;

private:
  vtkCADSurfaceReader(const vtkCADSurfaceReader&) = delete;
  void operator=(const vtkCADSurfaceReader&) = delete;
};

#endif
