/**
 * @file FreshArray.h
 * @brief Makes the arrays of the outputs, in memory of their own: see PageVector.h.
 */
#ifndef FreshArray_h
#define FreshArray_h

#include "HexMesh.h"
#include "PageVector.h"

#include <vtkSmartPointer.h>

#include <cstddef>

namespace trim
{

/// Asks for large pages where the memory is not yet in use; a hint.
void PreferLargePages(void* memory, std::size_t bytes);

/// Memory for an array, zero and not in use before it is written to, and what frees it.
struct Zeros
{
  void* Memory;
  void (*Free)(void*);
};
/// Throws if there is none.
Zeros AllocateZerosForArray(std::size_t bytes, nurbs::PageSize pages);

/// An array of zeros. They cost no time, and no memory where they are not written to.
template <typename Array>
vtkSmartPointer<Array> MakeZeros(
  const char* name, Id tuples, int components = 1, nurbs::PageSize pages = nurbs::PageSize::Small)
{
  using Value = typename Array::ValueType;
  const Id count = tuples * components;
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  const Zeros zeros = AllocateZerosForArray(static_cast<std::size_t>(count) * sizeof(Value), pages);
  array->SetArray(static_cast<Value*>(zeros.Memory), count, 0, Array::VTK_DATA_ARRAY_USER_DEFINED);
  array->SetArrayFreeFunction(zeros.Free);
  return array;
}

/// An array that is filled throughout by whoever asks for it.
template <typename Array>
vtkSmartPointer<Array> MakeArray(const char* name, Id tuples, int components = 1)
{
  return MakeZeros<Array>(name, tuples, components, nurbs::PageSize::Large);
}

}

#endif
