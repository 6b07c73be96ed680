/**
 * @file InputTimes.h
 * @brief When the result changes in time: whenever the grid or the surface does.
 */
#ifndef InputTimes_h
#define InputTimes_h

class vtkDataObject;
class vtkInformation;
class vtkInformationVector;

namespace trim
{

/// Tells all outputs the time steps of both inputs, each once and ascending, and the range that
/// holds both. Inputs may be null, or have no times.
void TellTimes(vtkInformation* grid, vtkInformation* surface, vtkInformationVector* outputs);

/// Tells an output the time that it is of: the later one of what the inputs are of.
void TellTime(vtkDataObject* grid, vtkDataObject* surface, vtkDataObject* output);

}

#endif
