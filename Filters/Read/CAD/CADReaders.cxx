#include "CADReaders.h"

//------------------------------------------------------------------------------
const nurbs::CADReaders* nurbs::NURBSTrimGetCADReaders()
{
  static const CADReaders readers{ ReadCADFile, ReadCADCurves };
  return &readers;
}
