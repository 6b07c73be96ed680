/**
 * @file TestArrayMemory.cxx
 * @brief The arrays of the outputs can be used as any other: they grow, shrink, are copied, emptied
 * and filled anew, whatever memory they came in.
 */
#include "Expect.h"
#include "RunTrim.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cstdio>
#include <functional>

using namespace judge;

namespace
{
using Values = std::vector<double>;

/// The first `count` tuples; NaN as a number, so that it equals itself.
Values First(vtkDataArray* array, vtkIdType count)
{
  Values values;
  for (vtkIdType i = 0; i < count; ++i)
  {
    for (int c = 0; c < array->GetNumberOfComponents(); ++c)
    {
      const double value = array->GetComponent(i, c);
      values.push_back(value == value ? value : -123456.0);
    }
  }
  return values;
}

vtkSmartPointer<vtkDataArray> NewLike(vtkDataArray* array)
{
  return vtkSmartPointer<vtkDataArray>::Take(array->NewInstance());
}

/// What other filters do to an array of theirs; each gets one of its own from a fresh trim.
struct Use
{
  const char* Name;
  std::function<void(vtkDataArray* array, const std::string& what)> Run;
};

void Append(vtkDataArray* array, const std::string& what)
{
  const vtkIdType count = array->GetNumberOfTuples();
  const Values before = First(array, count);
  const Values tuple(array->GetNumberOfComponents(), 7.0);
  for (int i = 0; i < 1000; ++i)
  {
    array->InsertNextTuple(tuple.data());
  }
  Expect(array->GetNumberOfTuples() == count + 1000, what + ": number of tuples");
  Expect(First(array, count) == before, what + ": values before");
  Expect(array->GetComponent(count + 999, 0) == 7.0, what + ": value appended");
  array->Squeeze();
  Expect(First(array, count) == before, what + ": values when squeezed");
}

void Shrink(vtkDataArray* array, const std::string& what)
{
  const vtkIdType half = array->GetNumberOfTuples() / 2;
  const Values before = First(array, half);
  array->SetNumberOfTuples(half);
  array->Squeeze();
  Expect(array->GetNumberOfTuples() == half && First(array, half) == before, what);
  array->Resize(4 * half + 10);
  Expect(First(array, half) == before, what + ", then enlarged");
  array->Resize(half / 2);
  Expect(First(array, half / 2) ==
      Values(before.begin(), before.begin() + half / 2 * array->GetNumberOfComponents()),
    what + ", then resized");
}

void Copy(vtkDataArray* array, const std::string& what)
{
  const vtkIdType count = array->GetNumberOfTuples();
  const Values before = First(array, count);
  const auto copy = NewLike(array);
  copy->DeepCopy(array);
  const auto shallow = NewLike(array);
  shallow->ShallowCopy(array);
  array->FillComponent(0, 5.0);
  array->Initialize();
  Expect(First(copy, count) == before, what + ": the copy");
  Expect(shallow->GetNumberOfTuples() == count, what + ": the shallow copy");
  array->DeepCopy(copy);
  Expect(First(array, count) == before, what + ": the array, copied back");
}

void CopyOver(vtkDataArray* array, const std::string& what)
{
  const auto other = NewLike(array);
  other->SetNumberOfComponents(array->GetNumberOfComponents());
  other->SetNumberOfTuples(3 * array->GetNumberOfTuples());
  other->Fill(3.0);
  array->DeepCopy(other);
  Expect(
    First(array, array->GetNumberOfTuples()) == First(other, other->GetNumberOfTuples()), what);
}

void Empty(vtkDataArray* array, const std::string& what)
{
  array->Initialize();
  array->Squeeze();
  array->SetNumberOfTuples(100);
  array->Fill(2.0);
  Expect(First(array, 100) == Values(100 * array->GetNumberOfComponents(), 2.0), what);
  array->Reset();
  array->Squeeze();
  array->Allocate(10);
  array->InsertTuple(50, Values(array->GetNumberOfComponents(), 1.0).data());
  Expect(array->GetComponent(50, 0) == 1.0, what + ", then allocated");
}

const std::vector<Use> Uses = { { "appended to", Append }, { "shrunk", Shrink }, { "copied", Copy },
  { "copied over", CopyOver }, { "emptied", Empty } };

std::vector<vtkSmartPointer<vtkDataArray>> ArraysOf(vtkUnstructuredGrid* grid)
{
  std::vector<vtkSmartPointer<vtkDataArray>> arrays = { grid->GetPoints()->GetData(),
    grid->GetCells()->GetOffsetsArray(), grid->GetCells()->GetConnectivityArray(),
    grid->GetCellTypesArray() };
  for (vtkDataSetAttributes* data : { static_cast<vtkDataSetAttributes*>(grid->GetPointData()),
         static_cast<vtkDataSetAttributes*>(grid->GetCellData()) })
  {
    for (int i = 0; i < data->GetNumberOfArrays(); ++i)
    {
      if (vtkDataArray* array = data->GetArray(i))
      {
        arrays.emplace_back(array);
      }
    }
  }
  return arrays;
}

void TestUse(const Use& use, const Mesh& mesh, const Surface& surface)
{
  TrimOptions options;
  options.ProduceOffcut = true;
  const Outcome outcome = RunTrim(mesh, surface, options);
  const std::string name = mesh.Name + " " + use.Name;
  Expect(outcome.Clean(), name + ": the trim");
  const auto ofInput = ArraysOf(mesh.Grid);
  int used = 0;
  for (vtkUnstructuredGrid* grid :
    { outcome.Case.Trimmed.Get(), outcome.Offcut.Get(), outcome.Case.Whole.Get() })
  {
    if (!grid->GetPoints())
    {
      continue;
    }
    for (const auto& array : ArraysOf(grid))
    {
      // The second output shares the input's arrays.
      if (std::find(ofInput.begin(), ofInput.end(), array) == ofInput.end())
      {
        use.Run(array, name + " " + (array->GetName() ? array->GetName() : "geometry"));
        ++used;
      }
    }
  }
  Expect(used >= 30, name + ": only " + std::to_string(used) + " arrays");
}
}

int main()
{
  // Arrays of a few pages, and of many: memory may come from different places.
  for (const Mesh& mesh : { MakeMesh("sheet2"), Sheet(160, 100, 2, Vec3(1, 1, 0.4)) })
  {
    const Surface surface = MakeSurface("wavy", mesh.Box, Placement());
    for (const Use& use : Uses)
    {
      TestUse(use, mesh, surface);
    }
  }
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
