/**
 * @file FreshArray.h
 * @brief Makes the arrays of the outputs: most of a trim's time far from the cut is the kernel's,
 * to hand over memory that was never touched before.
 */
#ifndef FreshArray_h
#define FreshArray_h

#include "HexMesh.h"

#include <vtkSmartPointer.h>

#include <cstddef>

namespace trim
{

/// Asks for large pages where the memory is not yet in use; a hint.
void PreferLargePages(void* memory, std::size_t bytes);

/// An array that is filled throughout by whoever asks for it.
template <typename Array>
vtkSmartPointer<Array> MakeArray(const char* name, Id tuples, int components = 1)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  PreferLargePages(array->GetPointer(0),
    static_cast<std::size_t>(tuples * components) * sizeof(typename Array::ValueType));
  return array;
}

/// Memory that is zero, and not in use before it is written to, and what frees it.
struct Zeros
{
  void* Memory;
  void (*Free)(void*);
};
/// Throws if there is none.
Zeros AllocateZeros(std::size_t bytes);

/// An array of zeros. They cost no time, and no memory where they are not written to.
template <typename Array>
vtkSmartPointer<Array> MakeZeros(const char* name, Id tuples, int components = 1)
{
  using Value = typename Array::ValueType;
  const Id count = tuples * components;
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  const Zeros zeros = AllocateZeros(static_cast<std::size_t>(count) * sizeof(Value));
  array->SetArray(static_cast<Value*>(zeros.Memory), count, 0, Array::VTK_DATA_ARRAY_USER_DEFINED);
  array->SetArrayFreeFunction(zeros.Free);
  return array;
}

}

#endif
