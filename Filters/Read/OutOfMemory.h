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
#include <string>

namespace nurbs
{

/// The error: what needs the memory, with its verb, and what else to do than to close other data.
inline std::string MemoryText(const std::string& what, const std::string& remedy)
{
  return what + " more memory than there is: close other data, or " + remedy;
}

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
    vtkErrorWithObjectMacro(source, << MemoryText(what, remedy) << ".");
    // Not 0: the executive would add an error of its own.
    return 1;
  }
}

}

#endif
