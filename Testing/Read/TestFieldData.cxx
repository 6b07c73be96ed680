/**
 * The definition of a surface in field data: there and back through memory and through a .vtp
 * file, in any numeric type; each array that is missing or malformed is named.
 */
#include "NURBSFieldData.h"
#include "NURBSTessellation.h"
#include "ReadTesting.h"

#include "vtkCompositeDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkIntArray.h"
#include "vtkLongLongArray.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <functional>
#include <limits>

using nurbs::NurbsSurface;
using nurbs::Vec2;
using nurbs::Vec4;

namespace
{
NurbsSurface Sample(bool trimmed)
{
  NurbsSurface surface;
  surface.DegreeU = 2;
  surface.DegreeV = 1;
  surface.CountU = 4;
  surface.CountV = 3;
  surface.KnotsU = { 0, 0, 0, 0.1, 1, 1, 1 };
  surface.KnotsV = { -1, 0, 1.0 / 3.0, 1, 2 };
  for (int k = 0; k < 12; ++k)
  {
    surface.ControlPoints.emplace_back(k % 4 + 1e-7, k / 4, 0.1 * k * k, 1.0 + k / 3.0);
  }
  if (trimmed)
  {
    surface.TrimLoops = { { Vec2(0.1, 0.1), Vec2(0.9, 0.1), Vec2(0.9, 0.9), Vec2(0.1, 0.8) },
      { Vec2(0.3, 0.3), Vec2(0.3, 0.5), Vec2(0.5, 0.4) } };
    surface.Tolerance = 0.003;
  }
  return surface;
}

bool Equal(const NurbsSurface& a, const NurbsSurface& b)
{
  return a.DegreeU == b.DegreeU && a.DegreeV == b.DegreeV && a.CountU == b.CountU &&
    a.CountV == b.CountV && a.KnotsU == b.KnotsU && a.KnotsV == b.KnotsV &&
    a.ControlPoints == b.ControlPoints && a.TrimLoops == b.TrimLoops && a.Tolerance == b.Tolerance;
}

void TestRoundTrip()
{
  for (bool trimmed : { true, false })
  {
    const NurbsSurface given = Sample(trimmed);
    vtkNew<vtkPolyData> data;
    // Writing again over a trimmed surface must not leave its loops behind.
    nurbs::TessellateNURBS(given, 4, data);
    nurbs::WriteNURBSFieldData(Sample(true), data->GetFieldData());
    nurbs::WriteNURBSFieldData(given, data->GetFieldData());
    CHECK(data->GetFieldData()->HasArray("NURBSTrimLoops") == trimmed, "loops");
    NurbsSurface read;
    std::string error;
    CHECK(nurbs::ReadNURBSFieldData(data->GetFieldData(), read, error), error);
    CHECK(Equal(given, read), "differs after memory");

    // Appended raw data cannot be read back with Debian 12's libexpat.
    vtkNew<vtkXMLPolyDataWriter> writer;
    writer->SetFileName(OutputPath("surface.vtp").c_str());
    writer->SetDataModeToBinary();
    writer->SetInputData(data);
    CHECK(writer->Write() == 1, "writing");
    vtkNew<vtkXMLPolyDataReader> reader;
    reader->SetFileName(OutputPath("surface.vtp").c_str());
    reader->Update();
    CHECK(nurbs::ReadNURBSFieldData(reader->GetOutput()->GetFieldData(), read, error), error);
    CHECK(Equal(given, read), "differs after the file");
  }
}

/// Replaces an array by one of another type with the same values.
template <typename Array>
void Retype(vtkFieldData* fieldData, const char* name)
{
  vtkNew<Array> array;
  array->DeepCopy(fieldData->GetArray(name));
  array->SetName(name);
  fieldData->AddArray(array);
}

void TestTypes()
{
  vtkNew<vtkFieldData> fieldData;
  nurbs::WriteNURBSFieldData(Sample(true), fieldData);
  Retype<vtkDoubleArray>(fieldData, "NURBSDegrees");
  Retype<vtkLongLongArray>(fieldData, "NURBSControlNetSize");
  Retype<vtkFloatArray>(fieldData, "NURBSControlPoints");
  Retype<vtkFloatArray>(fieldData, "NURBSKnotsV");
  Retype<vtkLongLongArray>(fieldData, "NURBSTrimLoopOffsets");
  NurbsSurface read;
  std::string error;
  CHECK(nurbs::ReadNURBSFieldData(fieldData, read, error), error);
  CHECK(read.ControlPoints.size() == 12 && read.TrimLoops.size() == 2, "sizes");
}

/// Spoils the definition and expects an error with that name in it.
void CheckDefect(const std::string& name, const std::function<void(vtkFieldData*)>& spoil)
{
  vtkNew<vtkFieldData> fieldData;
  nurbs::WriteNURBSFieldData(Sample(true), fieldData);
  spoil(fieldData);
  NurbsSurface read;
  std::string error;
  CHECK(!nurbs::ReadNURBSFieldData(fieldData, read, error), name << " is accepted");
  CHECK(error.find(name) != std::string::npos, "no \"" << name << "\" in \"" << error << "\"");
  CHECK(error.find('\n') == std::string::npos, error);
}

void TestDefects()
{
  const char* const names[] = { "NURBSDegrees", "NURBSControlNetSize", "NURBSControlPoints",
    "NURBSKnotsU", "NURBSKnotsV", "NURBSTrimLoops", "NURBSTrimLoopOffsets" };
  for (const char* name : names)
  {
    CheckDefect(name, [name](vtkFieldData* data) { data->RemoveArray(name); });
    CheckDefect(name, [name](vtkFieldData* data) { data->GetArray(name)->SetNumberOfTuples(0); });
    CheckDefect(name,
      [name](vtkFieldData* data)
      {
        vtkNew<vtkStringArray> text;
        text->SetName(name);
        text->InsertNextValue("1");
        data->AddArray(text);
      });
    CheckDefect(name,
      [name](vtkFieldData* data)
      {
        vtkNew<vtkDoubleArray> array;
        array->SetName(name);
        array->SetNumberOfComponents(7);
        array->SetNumberOfTuples(2);
        array->Fill(1.0);
        data->AddArray(array);
      });
  }
  auto set = [](const char* name, int tuple, int component, double value)
  {
    return [=](vtkFieldData* data)
    {
      vtkNew<vtkDoubleArray> array;
      array->DeepCopy(data->GetArray(name));
      array->SetName(name);
      array->SetComponent(tuple, component, value);
      data->AddArray(array);
    };
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double huge = 1e300;
  for (double value : { nan, huge, -huge, 0.5, -1.0, 0.0, 26.0 })
  {
    CheckDefect("NURBSDegrees", set("NURBSDegrees", 0, 0, value));
  }
  for (double value : { nan, huge, 0.5, -4.0, 0.0, 2.0 })
  {
    CheckDefect("NURBSControlNetSize", set("NURBSControlNetSize", 0, 0, value));
  }
  CheckDefect("NURBSDegrees", set("NURBSDegrees", 0, 0, Sample(true).DegreeU + 0.5));
  CheckDefect("NURBSControlPoints", set("NURBSControlNetSize", 0, 0, 2147483647.0));
  CheckDefect("NURBSTrimLoopOffsets", set("NURBSTrimLoopOffsets", 1, 0, 8.0));
  CheckDefect("NURBSTrimLoopOffsets", set("NURBSTrimLoopOffsets", 0, 0, 1.0));
  CheckDefect("NURBSTrimLoopOffsets", set("NURBSTrimLoopOffsets", 2, 0, 6.0));
  CheckDefect("NURBSTrimLoopOffsets", set("NURBSTrimLoopOffsets", 1, 0, nan));
  CheckDefect("NURBSTrimLoopOffsets",
    [](vtkFieldData* data)
    {
      vtkNew<vtkDoubleArray> falling;
      falling->SetName("NURBSTrimLoopOffsets");
      for (const double offset : { 0.0, 4.0, 3.0, 7.0 })
      {
        falling->InsertNextValue(offset);
      }
      data->AddArray(falling);
    });
  for (const double value : { nan, -1e-9, std::numeric_limits<double>::infinity() })
  {
    CheckDefect("tolerance", set("NURBSTolerance", 0, 0, value));
  }
  CheckDefect("trim loop 0", set("NURBSTrimLoopOffsets", 1, 0, 2.0));
  CheckDefect("point 1 of trim loop 1", set("NURBSTrimLoops", 5, 0, nan));
  CheckDefect("point 1 of trim loop 1", set("NURBSTrimLoops", 5, 1, 1.5));
  // What the kernel's own check finds.
  CheckDefect("knot", set("NURBSKnotsU", 3, 0, -1.0));
  CheckDefect("knot", set("NURBSKnotsV", 3, 0, nan));
  CheckDefect("weight", set("NURBSControlPoints", 3, 3, 0.0));
  CheckDefect("weight", set("NURBSControlPoints", 3, 3, -2.0));
  CheckDefect("finite", set("NURBSControlPoints", 3, 1, std::numeric_limits<double>::infinity()));
}

vtkSmartPointer<vtkPolyData> Face(bool trimmed)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  nurbs::WriteNURBSFieldData(Sample(trimmed), data->GetFieldData());
  return data;
}

void CheckSurfaces(vtkDataObject* data, size_t count)
{
  std::vector<NurbsSurface> surfaces(3);
  std::string error;
  CHECK(nurbs::ReadTrimmingSurface(data, surfaces, error), error);
  CHECK(surfaces.size() == count, surfaces.size() << " surfaces");
}

void CheckNoSurface(vtkDataObject* data, const std::vector<std::string>& parts)
{
  std::vector<NurbsSurface> surfaces(3);
  std::string error;
  CHECK(!nurbs::ReadTrimmingSurface(data, surfaces, error), "accepted");
  CHECK(surfaces.empty(), surfaces.size() << " surfaces with an error");
  for (const std::string& part : parts)
  {
    CHECK(error.find(part) != std::string::npos, "no \"" << part << "\" in \"" << error << "\"");
  }
}

void TestComposites()
{
  CheckSurfaces(Face(false), 1);
  CheckNoSurface(nullptr, { "there is no surface" });
  CheckNoSurface(vtkNew<vtkPolyData>(), { "no NURBS definition" });
  CheckNoSurface(vtkNew<vtkMultiBlockDataSet>(), { "there is no surface" });
  CheckNoSurface(vtkNew<vtkPartitionedDataSetCollection>(), { "there is no surface" });
  CheckNoSurface(vtkNew<vtkImageData>(), { "vtkImageData", "poly data" });

  vtkNew<vtkMultiBlockDataSet> inner;
  inner->SetBlock(0, Face(false));
  inner->SetBlock(2, Face(true)); // block 1 stays null
  vtkNew<vtkMultiBlockDataSet> outer;
  outer->SetBlock(0, inner);
  outer->SetBlock(1, Face(true));
  CheckSurfaces(outer, 3);

  vtkNew<vtkPartitionedDataSet> parts;
  parts->SetPartition(0, Face(false));
  parts->SetPartition(1, Face(true));
  CheckSurfaces(parts, 2);
  vtkNew<vtkPartitionedDataSetCollection> collection;
  collection->SetPartitionedDataSet(0, parts);
  collection->SetPartition(1, 0, Face(true));
  CheckSurfaces(collection, 3);

  inner->GetMetaData(1u)->Set(vtkCompositeDataSet::NAME(), "Corner");
  outer->GetMetaData(0u)->Set(vtkCompositeDataSet::NAME(), "Door");
  inner->SetBlock(1, vtkNew<vtkPolyData>());
  CheckNoSurface(outer, { "block 1 \"Corner\" of block 0 \"Door\"", "no NURBS definition" });
  inner->SetBlock(1, vtkNew<vtkImageData>());
  CheckNoSurface(outer, { "Corner", "vtkImageData" });
  vtkSmartPointer<vtkPolyData> bad = Face(false);
  bad->GetFieldData()->RemoveArray("NURBSKnotsV");
  inner->SetBlock(1, bad);
  CheckNoSurface(outer, { "Corner", "NURBSKnotsV" });
  collection->SetPartition(1, 0, bad);
  collection->GetMetaData(1u)->Set(vtkCompositeDataSet::NAME(), "Arch");
  CheckNoSurface(collection, { "block 1 \"Arch\"", "NURBSKnotsV" });
}
}

int main()
{
  TestRoundTrip();
  TestTypes();
  TestDefects();
  TestComposites();
  return Failures != 0;
}
