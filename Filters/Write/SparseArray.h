/**
 * @file SparseArray.h
 * @brief An array of an output that is zero but near the cut: only there it is written and looked
 * at, also for its ranges.
 */
#ifndef SparseArray_h
#define SparseArray_h

#include "ArrayRanges.h"
#include "FreshArray.h"

#include <vtkDataSetAttributes.h>

#include <vector>

namespace trim
{

template <typename Array>
class SparseArray
{
public:
  using Value = typename Array::ValueType;

  /// @param written about how many tuples will be.
  SparseArray(const char* name, Id tuples, int components, std::size_t written)
    : Zeros(MakeZeros<Array>(name, tuples, components,
        nurbs::PagesForPlaces(tuples * components * sizeof(Value), written)))
    , Values(Zeros->GetPointer(0))
    , Components(components)
  {
  }

  /// The tuple at a place, to be written.
  Value* At(Id place)
  {
    this->Places.push_back(place);
    return this->Values + this->Components * place;
  }

  /// Call this when all is written.
  void AddTo(vtkDataSetAttributes* data) const
  {
    TellRanges(this->Zeros, this->Places);
    data->AddArray(this->Zeros);
  }

private:
  vtkSmartPointer<Array> Zeros;
  Value* Values;
  int Components;
  std::vector<Id> Places;
};

}

#endif
