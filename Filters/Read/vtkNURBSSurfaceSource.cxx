#include "vtkNURBSSurfaceSource.h"

#include "FirstRank.h"
#include "NURBSTessellation.h"
#include "NurbsSurface.h"
#include "OutOfMemory.h"
#include "PropertyLimits.h"

#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <string>

vtkStandardNewMacro(vtkNURBSSurfaceSource);

//------------------------------------------------------------------------------
vtkNURBSSurfaceSource::vtkNURBSSurfaceSource()
{
  this->SetNumberOfInputPorts(0);
  // u along y, v along z: S_u x S_v points to positive x. One wave along y.
  const double x[7] = { 0.0, 0.12, 0.24, 0.0, -0.24, -0.12, 0.0 };
  const double y[7] = { -1.0, -0.8, -0.4, 0.0, 0.4, 0.8, 1.0 };
  const double lean[4] = { -0.03, -0.01, 0.01, 0.03 };
  const double z[4] = { -0.5, -0.2, 0.2, 0.5 };
  for (int j = 0; j < 4; ++j)
  {
    for (int i = 0; i < 7; ++i)
    {
      this->ControlPoints.insert(this->ControlPoints.end(), { x[i] + lean[j], y[i], z[j], 1.0 });
    }
  }
  this->KnotsU = { 0, 0, 0, 0, 1, 2, 3, 4, 4, 4, 4 };
  this->KnotsV = { 0, 0, 0, 0, 1, 1, 1, 1 };
}

//------------------------------------------------------------------------------
vtkNURBSSurfaceSource::~vtkNURBSSurfaceSource() = default;

//------------------------------------------------------------------------------
void vtkNURBSSurfaceSource::Resize(std::vector<double>& values, int count, int components)
{
  if (count > nurbs::MostValues)
  {
    vtkErrorMacro(<< "A number of " << count << " is more than the " << nurbs::MostValues
                  << " points or knots that a surface may have.");
    return;
  }
  const size_t size = static_cast<size_t>(std::max(0, count)) * components;
  if (values.size() != size)
  {
    values.resize(size, components == 4 ? 1.0 : 0.0);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkNURBSSurfaceSource::SetValues(
  std::vector<double>& values, int index, const double* given, int components)
{
  if (index < 0)
  {
    vtkErrorMacro(<< "Index " << index << " is negative; the first one is 0.");
    return;
  }
  if (index >= nurbs::MostValues)
  {
    vtkErrorMacro(<< "Index " << index << " is too large; the last one may be "
                  << nurbs::MostValues - 1 << ".");
    return;
  }
  // Grows by itself, so that points and knots can be given in order without a number before.
  const size_t end = (static_cast<size_t>(index) + 1) * components;
  if (values.size() < end)
  {
    this->Resize(values, index + 1, components);
  }
  if (!std::equal(given, given + components, values.begin() + (end - components)))
  {
    std::copy(given, given + components, values.begin() + (end - components));
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkNURBSSurfaceSource::SetNumberOfControlPoints(int count)
{
  this->Resize(this->ControlPoints, count, 4);
}

//------------------------------------------------------------------------------
int vtkNURBSSurfaceSource::GetNumberOfControlPoints()
{
  return static_cast<int>(this->ControlPoints.size() / 4);
}

//------------------------------------------------------------------------------
void vtkNURBSSurfaceSource::SetControlPoint(int index, double x, double y, double z, double w)
{
  const double point[4] = { x, y, z, w };
  this->SetValues(this->ControlPoints, index, point, 4);
}

//------------------------------------------------------------------------------
void vtkNURBSSurfaceSource::GetControlPoint(int index, double point[4])
{
  for (int i = 0; i < 4; ++i)
  {
    const bool inside = index >= 0 && index < this->GetNumberOfControlPoints();
    point[i] = inside ? this->ControlPoints[4 * static_cast<size_t>(index) + i] : 0.0;
  }
}

//------------------------------------------------------------------------------
void vtkNURBSSurfaceSource::SetNumberOfKnotsU(int count)
{
  this->Resize(this->KnotsU, count, 1);
}

//------------------------------------------------------------------------------
int vtkNURBSSurfaceSource::GetNumberOfKnotsU()
{
  return static_cast<int>(this->KnotsU.size());
}

//------------------------------------------------------------------------------
void vtkNURBSSurfaceSource::SetKnotU(int index, double knot)
{
  this->SetValues(this->KnotsU, index, &knot, 1);
}

//------------------------------------------------------------------------------
double vtkNURBSSurfaceSource::GetKnotU(int index)
{
  return index >= 0 && index < this->GetNumberOfKnotsU() ? this->KnotsU[index] : 0.0;
}

//------------------------------------------------------------------------------
void vtkNURBSSurfaceSource::SetNumberOfKnotsV(int count)
{
  this->Resize(this->KnotsV, count, 1);
}

//------------------------------------------------------------------------------
int vtkNURBSSurfaceSource::GetNumberOfKnotsV()
{
  return static_cast<int>(this->KnotsV.size());
}

//------------------------------------------------------------------------------
void vtkNURBSSurfaceSource::SetKnotV(int index, double knot)
{
  this->SetValues(this->KnotsV, index, &knot, 1);
}

//------------------------------------------------------------------------------
double vtkNURBSSurfaceSource::GetKnotV(int index)
{
  return index >= 0 && index < this->GetNumberOfKnotsV() ? this->KnotsV[index] : 0.0;
}

//------------------------------------------------------------------------------
int vtkNURBSSurfaceSource::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  nurbs::NurbsSurface surface;
  surface.DegreeU = this->Degrees[0];
  surface.DegreeV = this->Degrees[1];
  surface.CountU = this->ControlNetSize[0];
  surface.CountV = this->ControlNetSize[1];
  surface.KnotsU = this->KnotsU;
  surface.KnotsV = this->KnotsV;
  for (size_t i = 0; i + 3 < this->ControlPoints.size(); i += 4)
  {
    surface.ControlPoints.emplace_back(this->ControlPoints[i], this->ControlPoints[i + 1],
      this->ControlPoints[i + 2], this->ControlPoints[i + 3]);
  }
  const std::string defect = nurbs::FindDefect(surface);
  if (!defect.empty())
  {
    if (nurbs::IsFirstRank(vtkMultiProcessController::GetGlobalController()))
    {
      vtkErrorMacro(<< "The NURBS surface is not valid: " << defect << ".");
    }
    // Not 0: the executive would add an error of its own, at every update again.
    return 1;
  }
  return nurbs::WithinMemory(this, outputVector, "The NURBS surface takes",
    "choose a smaller Resolution",
    [&]
    {
      nurbs::TessellateNURBS(surface, this->Resolution, vtkPolyData::GetData(outputVector));
      return 1;
    });
}

//------------------------------------------------------------------------------
void vtkNURBSSurfaceSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Degrees: " << this->Degrees[0] << " " << this->Degrees[1] << "\n";
  os << indent << "ControlNetSize: " << this->ControlNetSize[0] << " " << this->ControlNetSize[1]
     << "\n";
  os << indent << "NumberOfControlPoints: " << this->GetNumberOfControlPoints() << "\n";
  os << indent << "NumberOfKnotsU: " << this->GetNumberOfKnotsU() << "\n";
  os << indent << "NumberOfKnotsV: " << this->GetNumberOfKnotsV() << "\n";
  os << indent << "Resolution: " << this->Resolution << "\n";
}
