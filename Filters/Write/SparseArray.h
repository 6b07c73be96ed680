/**
 * @file SparseArray.h
 * @brief Arrays of an output that are zero but near the cut: only there they are written and looked
 * at, also for their ranges.
 */
#ifndef SparseArray_h
#define SparseArray_h

#include "ArrayRanges.h"
#include "FreshArray.h"
#include "Team.h"

#include <vtkDataSetAttributes.h>

#include <vector>

namespace trim
{

/// Adds an array that is zero but at some places.
/// @param places each once; where they ascend, threads need not wait for each other's pages.
/// @param write write(i, tuple) sets the tuple at places[i]; called by all threads.
template <typename Array, typename Write>
void AddSparseArray(const char* name, Id tuples, int components, const std::vector<Id>& places,
  const Write& write, vtkDataSetAttributes* data)
{
  using Value = typename Array::ValueType;
  constexpr Id grain = 1000;
  const auto array = MakeZeros<Array>(name, tuples, components,
    nurbs::PagesForPlaces(tuples * components * sizeof(Value), places.size()));
  Value* values = array->GetPointer(0);
  ParallelFor(0, static_cast<Id>(places.size()), grain,
    [&](Id begin, Id end)
    {
      for (Id i = begin; i < end; ++i)
      {
        write(i, values + components * places[i]);
      }
    });
  TellRanges(array, places);
  data->AddArray(array);
}

}

#endif
