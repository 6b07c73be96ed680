/**
 * @file FreshArray.h
 * @brief Makes the arrays of the outputs, in memory of their own: see PageVector.h.
 */
#ifndef FreshArray_h
#define FreshArray_h

#include "PageVector.h"
#include "Types.h"

#include <vtkSmartPointer.h>

#include <cstddef>

namespace trim
{

/// Memory for an array, and what frees it.
struct ArrayMemory
{
  void* Memory;
  void (*Free)(void*);
};
/// Zeros. Throws if there is no memory.
ArrayMemory AllocateZerosForArray(std::size_t bytes, nurbs::PageSize pages);
/// Memory that holds anything, in large pages. Throws if there is none.
ArrayMemory AllocatePagesForArray(std::size_t bytes);

/// @param allocate allocate(bytes) gives ArrayMemory.
template <typename Array, typename Allocate>
vtkSmartPointer<Array> MakeArrayIn(
  const Allocate& allocate, const char* name, Id tuples, int components)
{
  using Value = typename Array::ValueType;
  const Id count = tuples * components;
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  const ArrayMemory own = allocate(static_cast<std::size_t>(count) * sizeof(Value));
  array->SetArray(static_cast<Value*>(own.Memory), count, 0, Array::VTK_DATA_ARRAY_USER_DEFINED);
  array->SetArrayFreeFunction(own.Free);
  return array;
}

/// An array of zeros. They cost no time, and no memory where they are not written to.
template <typename Array>
vtkSmartPointer<Array> MakeZeros(
  const char* name, Id tuples, int components = 1, nurbs::PageSize pages = nurbs::PageSize::Small)
{
  return MakeArrayIn<Array>([pages](std::size_t bytes)
    { return AllocateZerosForArray(bytes, pages); },
    name, tuples, components);
}

/// An array that is filled throughout by whoever asks for it.
template <typename Array>
vtkSmartPointer<Array> MakeArray(const char* name, Id tuples, int components = 1)
{
  return MakeArrayIn<Array>(&AllocatePagesForArray, name, tuples, components);
}

}

#endif
