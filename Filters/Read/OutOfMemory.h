/**
 * @file OutOfMemory.h
 * @brief Where memory runs out the user gets one error, and ParaView goes on.
 */
#ifndef OutOfMemory_h
#define OutOfMemory_h

#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkInformationVector.h"

#include <new>

namespace nurbs
{

/**
 * The result of work(), which makes the output of a source.
 *
 * @param what needs the memory, with its verb.
 * @param remedy what else to do than to close other data.
 */
template <typename Work>
int WithinMemory(vtkAlgorithm* source, vtkInformationVector* output, const char* what,
  const char* remedy, const Work& work)
{
  try
  {
    return work();
  }
  catch (const std::bad_alloc&)
  {
    if (vtkDataObject* made = vtkDataObject::GetData(output))
    {
      made->Initialize();
    }
    vtkErrorWithObjectMacro(
      source, << what << " more memory than there is: close other data, or " << remedy << ".");
    // Not 0: the executive would add an error of its own.
    return 1;
  }
}

}

#endif
