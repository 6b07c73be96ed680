#include "ReadTesting.h"

#include "NURBSFieldData.h"
#include "vtkCADSurfaceReader.h"

#include "vtkCompositeDataSet.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkPolyData.h"
#include "vtkPolyDataAlgorithm.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <fstream>
#include <sstream>

int Failures = 0;

using nurbs::NurbsSurface;
using nurbs::Vec2;
using nurbs::Vec3;

//------------------------------------------------------------------------------
void ErrorCapture::Watch(vtkObject* object)
{
  object->AddObserver(vtkCommand::ErrorEvent, this);
  object->AddObserver(vtkCommand::WarningEvent, this);
}

//------------------------------------------------------------------------------
void ErrorCapture::Execute(vtkObject*, unsigned long event, void* data)
{
  (event == vtkCommand::ErrorEvent ? this->Errors : this->Warnings)
    .emplace_back(static_cast<const char*>(data));
}

//------------------------------------------------------------------------------
void CheckRefusal(
  vtkPolyDataAlgorithm* source, const std::string& part, const std::function<void()>& spoil)
{
  source->Update();
  CHECK(source->GetOutput()->GetNumberOfPoints() > 0, part << ": not valid at first");
  vtkNew<ErrorCapture> capture;
  capture->Watch(source);
  capture->Watch(source->GetExecutive());
  spoil();
  source->Update();
  CHECK(capture->Errors.size() == 1, part << ": " << capture->Errors.size() << " errors");
  CHECK(source->GetOutput()->GetNumberOfPoints() == 0, part << ": points");
  CHECK(!nurbs::HasNURBSFieldData(source->GetOutput()->GetFieldData()), part << ": field data");
  CHECK(capture->Errors.empty() || capture->Errors[0].find(part) != std::string::npos,
    "no \"" << part << "\" in " << capture->Errors[0]);
  CHECK(capture->Errors.empty() || capture->Errors[0].find("..") == std::string::npos,
    "two full stops: " << capture->Errors[0]);
}

//------------------------------------------------------------------------------
ReadResult ReadFile(const std::string& path, int lengthUnit, double timeLimit)
{
  vtkNew<vtkCADSurfaceReader> reader;
  vtkNew<ErrorCapture> capture;
  capture->Watch(reader);
  capture->Watch(reader->GetExecutive());
  reader->SetFileName(path.c_str());
  reader->SetLengthUnit(lengthUnit);
  reader->SetTimeLimit(timeLimit);
  reader->Update();

  ReadResult result;
  result.Output = reader->GetOutput();
  result.Errors = capture->Errors;
  result.Warnings = capture->Warnings;
  std::string error;
  if (result.Output->GetNumberOfBlocks() > 0)
  {
    CHECK(nurbs::ReadTrimmingSurface(result.Output, result.Surfaces, error), path << ": " << error);
  }
  for (unsigned int i = 0; i < result.Output->GetNumberOfBlocks(); ++i)
  {
    const char* name = result.Output->GetMetaData(i)->Get(vtkCompositeDataSet::NAME());
    result.Names.emplace_back(name ? name : "");
  }
  return result;
}

//------------------------------------------------------------------------------
ReadResult ReadFaces(const std::string& path, size_t faces, int lengthUnit)
{
  ReadResult result = ReadFile(path, lengthUnit);
  CHECK(result.Errors.empty(), path << ": " << result.Errors[0]);
  CHECK(result.Warnings.empty(), path << ": " << result.Warnings[0]);
  CHECK(result.Surfaces.size() == faces, path << ": " << result.Surfaces.size() << " faces");
  return result;
}

//------------------------------------------------------------------------------
namespace
{
/// The parameters u at which the trim loops cross the row v, in order.
std::vector<double> CrossingsOfRow(const NurbsSurface& surface, double v)
{
  std::vector<double> crossings;
  for (const std::vector<Vec2>& loop : surface.TrimLoops)
  {
    for (size_t i = 0; i < loop.size(); ++i)
    {
      const Vec2& a = loop[i];
      const Vec2& b = loop[(i + 1) % loop.size()];
      if ((a.y() > v) != (b.y() > v))
      {
        crossings.push_back(a.x() + (v - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
      }
    }
  }
  std::sort(crossings.begin(), crossings.end());
  return crossings;
}

bool IsInside(const NurbsSurface& surface, const std::vector<double>& crossings, double u)
{
  const auto beyond = crossings.end() - std::upper_bound(crossings.begin(), crossings.end(), u);
  return surface.TrimLoops.empty() || beyond % 2 == 1;
}
}

//------------------------------------------------------------------------------
bool IsInside(const NurbsSurface& surface, double u, double v)
{
  return IsInside(surface, CrossingsOfRow(surface, v), u);
}

//------------------------------------------------------------------------------
Vec3 UnitNormal(const NurbsSurface& surface, double u, double v)
{
  const nurbs::SurfaceJet jet = nurbs::EvaluateJet(surface, u, v);
  return jet.Su.cross(jet.Sv).normalized();
}

//------------------------------------------------------------------------------
double Area(const NurbsSurface& surface, int n)
{
  const double du = (surface.LastU() - surface.FirstU()) / n;
  const double dv = (surface.LastV() - surface.FirstV()) / n;
  double area = 0.0;
  for (int j = 0; j < n; ++j)
  {
    const double v = surface.FirstV() + (j + 0.5) * dv;
    const std::vector<double> crossings = CrossingsOfRow(surface, v);
    for (int i = 0; i < n; ++i)
    {
      const double u = surface.FirstU() + (i + 0.5) * du;
      if (IsInside(surface, crossings, u))
      {
        const nurbs::SurfaceJet jet = nurbs::EvaluateJet(surface, u, v);
        area += jet.Su.cross(jet.Sv).norm() * du * dv;
      }
    }
  }
  return area;
}

//------------------------------------------------------------------------------
std::string OutputPath(const std::string& name)
{
  return std::string(READ_TEST_OUTPUT) + "/" + name;
}

//------------------------------------------------------------------------------
void WriteText(const std::string& path, const std::string& text)
{
  std::ofstream(path, std::ios::binary) << text;
}

//------------------------------------------------------------------------------
std::string ReadText(const std::string& path)
{
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}
