#include "LineTesting.h"

#include "NURBSFieldData.h"
#include "ReadTesting.h"
#include "vtkTrimLineSource.h"

#include "vtkExecutive.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cmath>

using nurbs::NurbsSurface;
using nurbs::Vec3;

//------------------------------------------------------------------------------
LineResult ReadLines(const std::string& path, const Adjust& adjust)
{
  vtkNew<vtkTrimLineSource> source;
  vtkNew<ErrorCapture> capture;
  capture->Watch(source);
  capture->Watch(source->GetExecutive());
  source->SetFileName(path.c_str());
  source->SetDirection(0, 0, 1);
  source->SetLength(3.0);
  if (adjust)
  {
    adjust(source);
  }
  source->Update();
  LineResult result{ source->GetOutputDataObject(0), {}, capture->Errors, capture->Warnings };
  std::string error;
  if (result.Errors.empty())
  {
    CHECK(nurbs::ReadTrimmingSurface(result.Output, result.Surfaces, error), path << ": " << error);
  }
  return result;
}

//------------------------------------------------------------------------------
LineResult ReadGood(const std::string& path, size_t lines, const Adjust& adjust)
{
  const LineResult result = ReadLines(path, adjust);
  CHECK(result.Errors.empty(), path << ": " << result.Errors[0]);
  CHECK(result.Warnings.empty(), path << ": " << result.Warnings[0]);
  CHECK(result.Surfaces.size() == lines, path << ": " << result.Surfaces.size() << " lines");
  CHECK((vtkPolyData::SafeDownCast(result.Output) != nullptr) == (lines == 1), path << ": type");
  return result;
}

//------------------------------------------------------------------------------
std::vector<Vec3> Places(const NurbsSurface& surface, int count)
{
  std::vector<Vec3> places;
  for (int i = 0; i <= count; ++i)
  {
    const double u = surface.FirstU() + (surface.LastU() - surface.FirstU()) * i / count;
    places.push_back(nurbs::Evaluate(surface, u, 0.0));
  }
  return places;
}

//------------------------------------------------------------------------------
double LargestResidual(const NurbsSurface& surface, const std::function<double(const Vec3&)>& form)
{
  double largest = 0.0;
  for (const Vec3& place : Places(surface))
  {
    largest = std::max(largest, std::abs(form(place)));
  }
  return largest;
}
