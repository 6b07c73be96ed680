/**
 * @file TestArrayRanges.cxx
 * @brief The ranges that the filter tells its arrays, against those that VTK finds by itself.
 */
#include "ArrayRanges.h"
#include "Expect.h"
#include "RunTrim.h"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkInformationInformationVectorKey.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkShortArray.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

using namespace judge;

namespace
{
bool Same(double a, double b)
{
  return a == b || (std::isnan(a) && std::isnan(b));
}

std::string Text(const double* range)
{
  char text[120];
  std::snprintf(
    text, sizeof(text), "%g .. %g, finite %g .. %g", range[0], range[1], range[2], range[3]);
  return text;
}

/// The array has been told its ranges, and says what VTK finds in a copy that forgot them.
void CheckTold(vtkDataArray* array, const std::string& what)
{
  Expect(array->GetInformation()->Has(vtkAbstractArray::PER_COMPONENT()) &&
      array->GetInformation()->Has(vtkAbstractArray::PER_FINITE_COMPONENT()),
    what + ": was not told its ranges");
  vtkSmartPointer<vtkDataArray> copy;
  copy.TakeReference(array->NewInstance());
  copy->DeepCopy(array);
  copy->Modified();
  for (int c = -1; c < array->GetNumberOfComponents(); ++c)
  {
    double told[4];
    double found[4];
    array->GetRange(told, c);
    array->GetFiniteRange(told + 2, c);
    copy->GetRange(found, c);
    copy->GetFiniteRange(found + 2, c);
    Expect(std::equal(told, told + 4, found, Same),
      what + ", component " + std::to_string(c) + ": told " + Text(told) + "; VTK finds " +
        Text(found));
  }
}

/// As of points that look for their bounds; also when one was moved.
void CheckBounds(vtkPoints* points)
{
  for (const double move : { 0.0, 1e3 })
  {
    double place[3];
    points->GetPoint(0, place);
    points->SetPoint(0, place[0] + move, place[1], place[2] - move);
    if (move != 0.0)
    {
      points->Modified();
    }
    vtkNew<vtkPoints> others;
    others->SetDataType(points->GetDataType());
    others->DeepCopy(points);
    Expect(std::equal(points->GetBounds(), points->GetBounds() + 6, others->GetBounds()),
      "bounds of points: not what VTK finds");
  }
}

void CheckNoBounds(vtkPoints* points)
{
  vtkNew<vtkPoints> others;
  Expect(std::equal(points->GetBounds(), points->GetBounds() + 6, others->GetBounds()),
    "bounds of no points: not what VTK finds");
}

/// Longer than what a thread takes at a time, so that the extremes lie in different pieces.
template <typename Array>
vtkNew<Array> MakeArray(int components)
{
  vtkNew<Array> array;
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(120001);
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
  {
    array->SetValue(i, static_cast<typename Array::ValueType>((i * 7919) % 199 - 50));
  }
  return array;
}

template <typename Array>
void TestPlain(const std::string& what)
{
  for (const int components : { 1, 3, 11 })
  {
    auto array = MakeArray<Array>(components);
    trim::TellRanges(array);
    CheckTold(array, what + " of " + std::to_string(components));
  }
}

template <typename Array>
void TestSpecial(const std::string& what)
{
  using Limits = std::numeric_limits<typename Array::ValueType>;
  for (const int components : { 1, 3 })
  {
    for (const auto special : { Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity() })
    {
      const std::string which = what + " with " + std::to_string(special);
      auto some = MakeArray<Array>(components);
      some->SetValue(100000, special);
      trim::TellRanges(some);
      CheckTold(some, which);
      auto all = MakeArray<Array>(components);
      all->Fill(special);
      trim::TellRanges(all);
      CheckTold(all, which + " only");
    }
  }
}

void TestAscending()
{
  vtkNew<vtkIdTypeArray> ids;
  trim::TellRangeOfAscending(ids);
  Expect(ids->GetRange()[0] > ids->GetRange()[1], "an empty list has a range");
  vtkNew<vtkIdTypeArray> some;
  for (const vtkIdType id : { 3, 3, 5, 80 })
  {
    some->InsertNextValue(id);
  }
  trim::TellRangeOfAscending(some);
  CheckTold(some, "ascending ids");
}

/// All arrays of all outputs.
void CheckOutputs(const Outcome& outcome)
{
  for (vtkUnstructuredGrid* grid :
    { outcome.Case.Trimmed.Get(), outcome.Case.Whole.Get(), outcome.Offcut.Get() })
  {
    for (vtkDataSetAttributes* data : { static_cast<vtkDataSetAttributes*>(grid->GetPointData()),
           static_cast<vtkDataSetAttributes*>(grid->GetCellData()) })
    {
      for (int i = 0; i < data->GetNumberOfArrays(); ++i)
      {
        if (vtkDataArray* array = data->GetArray(i))
        {
          CheckTold(array, array->GetName());
        }
      }
    }
    CheckTold(grid->GetPoints()->GetData(), "coordinates");
    CheckBounds(grid->GetPoints());
  }
}

/// Arrays of the input, whose ranges were asked for, do not pass on theirs.
void TestOutputs()
{
  const Mesh mesh = MakeMesh("sheet2");
  auto carried = MakeArray<vtkDoubleArray>(3);
  carried->SetName("Carried");
  carried->SetNumberOfTuples(mesh.Grid->GetNumberOfPoints());
  carried->SetTuple3(0, 1e9, 0.0, 0.0);
  carried->SetTuple3(mesh.Grid->GetNumberOfPoints() - 1, 1e9, 0.0, 0.0);
  double range[2];
  carried->GetRange(range, -1);
  carried->GetFiniteRange(range, -1);
  mesh.Grid->GetPointData()->AddArray(carried);
  for (const bool invert : { false, true })
  {
    TrimOptions options;
    options.InvertSide = invert;
    options.RenumberNodes = invert;
    options.ProduceOffcut = true;
    CheckOutputs(RunTrim(mesh, MakeSurface("scurve", mesh.Box, Placement()), options));
  }
}

/// The ids in the input are others than those among the cells that are not left out.
void TestLeftOut()
{
  Mesh mesh = Sheet(12, 10, 1, Vec3(1, 1, 0.4));
  vtkNew<vtkUnsignedCharArray> flags;
  flags->SetName(vtkDataSetAttributes::GhostArrayName());
  flags->SetNumberOfValues(mesh.Grid->GetNumberOfCells());
  flags->Fill(0);
  std::fill_n(flags->GetPointer(0), 20, vtkDataSetAttributes::HIDDENCELL);
  mesh.Grid->GetCellData()->AddArray(flags);
  TrimOptions options;
  options.ProduceOffcut = true;
  CheckOutputs(RunTrim(mesh, MakeSurface("scurve", mesh.Box, Placement()), options));
}
}

int main()
{
  TestPlain<vtkUnsignedCharArray>("unsigned char");
  TestPlain<vtkShortArray>("short");
  TestPlain<vtkIntArray>("int");
  TestPlain<vtkIdTypeArray>("ids");
  TestPlain<vtkFloatArray>("float");
  TestPlain<vtkDoubleArray>("double");
  TestSpecial<vtkFloatArray>("float");
  TestSpecial<vtkDoubleArray>("double");
  TestAscending();
  vtkNew<vtkFloatArray> empty;
  trim::TellRanges(empty);
  Expect(empty->GetRange()[0] > empty->GetRange()[1], "an empty array has a range");
  TestOutputs();
  TestLeftOut();
  vtkNew<vtkDoubleArray> nowhere;
  nowhere->SetNumberOfComponents(3);
  CheckNoBounds(trim::MakePoints(nowhere));
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
