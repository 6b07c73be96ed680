/**
 * @file IdList.h
 * @brief Ids of the input that an output holds, in the very array that the output carries.
 */
#ifndef IdList_h
#define IdList_h

#include "FreshArray.h"

#include <vtkIdTypeArray.h>

namespace trim
{

class IdList
{
public:
  explicit IdList(const char* name)
    : Name(name)
  {
    this->Resize(0);
  }
  void Resize(Id count)
  {
    this->Ids = MakeArray<vtkIdTypeArray>(this->Name, count);
    this->First = this->Ids->GetPointer(0);
    this->Count = count;
  }

  vtkIdTypeArray* Array() const { return this->Ids; }
  Id size() const { return this->Count; }
  bool empty() const { return this->Count == 0; }
  Id* data() { return this->First; }
  const Id* data() const { return this->First; }
  const Id* begin() const { return this->First; }
  const Id* end() const { return this->First + this->Count; }
  Id operator[](Id i) const { return this->First[i]; }

private:
  const char* Name;
  vtkSmartPointer<vtkIdTypeArray> Ids;
  Id* First = nullptr;
  Id Count = 0;
};

}

#endif
