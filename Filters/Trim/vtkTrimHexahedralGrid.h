// Skeleton: properties and ports only; the lead replaces it.
#ifndef vtkTrimHexahedralGrid_h
#define vtkTrimHexahedralGrid_h

#include "NURBSTrimFilterModule.h" // for export macro
#include "vtkUnstructuredGridAlgorithm.h"

class NURBSTRIMFILTER_EXPORT vtkTrimHexahedralGrid : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkTrimHexahedralGrid* New();
  vtkTypeMacro(vtkTrimHexahedralGrid, vtkUnstructuredGridAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  vtkSetClampMacro(CorrectionType, int, 1, 3);
  vtkGetMacro(CorrectionType, int);
  vtkSetClampMacro(Optimization, int, 0, 2);
  vtkGetMacro(Optimization, int);
  vtkSetMacro(InvertSide, bool);
  vtkGetMacro(InvertSide, bool);
  vtkBooleanMacro(InvertSide, bool);
  vtkSetMacro(UseKeepPoint, bool);
  vtkGetMacro(UseKeepPoint, bool);
  vtkBooleanMacro(UseKeepPoint, bool);
  vtkSetVector3Macro(KeepPoint, double);
  vtkGetVector3Macro(KeepPoint, double);
  vtkSetClampMacro(EliminationFraction, double, 0, 1);
  vtkGetMacro(EliminationFraction, double);
  vtkSetMacro(RenumberNodes, bool);
  vtkGetMacro(RenumberNodes, bool);
  vtkBooleanMacro(RenumberNodes, bool);
  vtkSetMacro(QualityOfAllElements, bool);
  vtkGetMacro(QualityOfAllElements, bool);
  vtkBooleanMacro(QualityOfAllElements, bool);
  vtkSetClampMacro(Tolerance, double, 0, 1);
  vtkGetMacro(Tolerance, double);

protected:
  vtkTrimHexahedralGrid();
  ~vtkTrimHexahedralGrid() override;
  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkTrimHexahedralGrid(const vtkTrimHexahedralGrid&) = delete;
  void operator=(const vtkTrimHexahedralGrid&) = delete;

  int CorrectionType = 2;
  int Optimization = 2;
  bool InvertSide = false;
  bool UseKeepPoint = false;
  double KeepPoint[3] = { 0, 0, 0 };
  double EliminationFraction = 0.5;
  bool RenumberNodes = true;
  bool QualityOfAllElements = false;
  double Tolerance = 1e-9;
};

#endif
