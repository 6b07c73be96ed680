/**
 * @file ArrayRanges.h
 * @brief Tells the arrays of an output their ranges, before ParaView asks for them.
 *
 * After each Apply ParaView asks every array of every output for its ranges, and VTK looks through
 * the array for each answer, on one thread and, as Debian builds it, without optimisation: a third
 * of the time that a trim took in the window. An array keeps its ranges until it says that it has
 * changed.
 */
#ifndef ArrayRanges_h
#define ArrayRanges_h

#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <vector>

class vtkDataArray;
class vtkDataSet;
class vtkIdTypeArray;
class vtkPoints;

namespace trim
{

/// The ranges that vtkDataArray::GetRange and GetFiniteRange would find, of all point and cell
/// arrays and of the coordinates. Arrays that know theirs are left alone.
void TellRanges(vtkDataSet* data);

/// The same for one array.
void TellRanges(vtkDataArray* array);

/// The same for an array that is zero but at these places; nothing else of it is looked at.
void TellRanges(vtkDataArray* array, const std::vector<vtkIdType>& places);

/// The same for one component of values that ascend.
void TellRangeOfAscending(vtkIdTypeArray* array);

/// Points at the places that an array tells, three components each, whose bounds are the ranges of
/// these. Others look through all places for them, which ParaView asks for after each Apply.
vtkSmartPointer<vtkPoints> MakePoints(vtkDataArray* places);

}

#endif
