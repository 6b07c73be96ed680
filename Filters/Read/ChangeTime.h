/**
 * @file ChangeTime.h
 * @brief When a data object changed last.
 */
#ifndef ChangeTime_h
#define ChangeTime_h

#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkSmartPointer.h"

#include <algorithm>

namespace nurbs
{

/// The latest time of the object and, if it is a composite, which does not ask them, of its blocks.
inline vtkMTimeType ChangeTime(vtkDataObject* data)
{
  vtkMTimeType time = data->GetMTime();
  if (auto* composite = vtkCompositeDataSet::SafeDownCast(data))
  {
    auto it = vtkSmartPointer<vtkCompositeDataIterator>::Take(composite->NewIterator());
    for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem())
    {
      time = std::max(time, it->GetCurrentDataObject()->GetMTime());
    }
  }
  return time;
}

}

#endif
