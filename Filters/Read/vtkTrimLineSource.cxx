#include "vtkTrimLineSource.h"

#include "NURBSTessellation.h"
#include "TrimLineCurve.h"
#include "TrimLineFile.h"

#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <string>

vtkStandardNewMacro(vtkTrimLineSource);

//------------------------------------------------------------------------------
vtkTrimLineSource::vtkTrimLineSource()
{
  this->SetNumberOfInputPorts(0);
  this->Points = { -0.5, 0.0, 0.0, -0.25, 0.1, 0.0, 0.0, 0.0, 0.0, 0.25, -0.1, 0.0, 0.5, 0.0, 0.0 };
}

//------------------------------------------------------------------------------
vtkTrimLineSource::~vtkTrimLineSource()
{
  this->SetFileName(nullptr);
}

//------------------------------------------------------------------------------
void vtkTrimLineSource::SetNumberOfPoints(int count)
{
  const size_t size = 3 * static_cast<size_t>(std::max(0, count));
  if (this->Points.size() != size)
  {
    this->Points.resize(size, 0.0);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkTrimLineSource::GetNumberOfPoints()
{
  return static_cast<int>(this->Points.size() / 3);
}

//------------------------------------------------------------------------------
void vtkTrimLineSource::SetPoint(int index, double x, double y, double z)
{
  if (index < 0)
  {
    vtkErrorMacro(<< "Index " << index << " is negative; the first point is 0.");
    return;
  }
  if (index >= this->GetNumberOfPoints())
  {
    this->SetNumberOfPoints(index + 1);
  }
  const double point[3] = { x, y, z };
  const auto place = this->Points.begin() + 3 * static_cast<size_t>(index);
  if (!std::equal(point, point + 3, place))
  {
    std::copy(point, point + 3, place);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkTrimLineSource::GetPoint(int index, double point[3])
{
  const bool inside = index >= 0 && index < this->GetNumberOfPoints();
  for (int i = 0; i < 3; ++i)
  {
    point[i] = inside ? this->Points[3 * static_cast<size_t>(index) + i] : 0.0;
  }
}

//------------------------------------------------------------------------------
int vtkTrimLineSource::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  nurbs::TrimLine line;
  line.Closed = this->Closed != 0;
  line.Direction = nurbs::Vec3(this->Direction);
  line.Length = this->Length;
  if (this->FileName && *this->FileName)
  {
    std::string error;
    if (!nurbs::ReadTrimLineFile(this->FileName, line.Points, error))
    {
      vtkErrorMacro(<< error);
      // Not 0: the executive would add an error of its own, at every update again.
      return 1;
    }
    // Contours in files often end where they began.
    if (line.Closed && line.Points.size() > 1 && line.Points.front() == line.Points.back())
    {
      line.Points.pop_back();
    }
  }
  else
  {
    for (size_t i = 0; i + 2 < this->Points.size(); i += 3)
    {
      line.Points.emplace_back(this->Points.data() + i);
    }
  }
  const std::string defect = nurbs::FindDefect(line);
  if (!defect.empty())
  {
    vtkErrorMacro(<< "The trim line is not valid: " << defect << ".");
    return 1;
  }
  nurbs::TessellateNURBS(
    nurbs::SweepTrimLine(line), this->Resolution, vtkPolyData::GetData(outputVector));
  return 1;
}

//------------------------------------------------------------------------------
void vtkTrimLineSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfPoints: " << this->GetNumberOfPoints() << "\n";
  os << indent << "Closed: " << this->Closed << "\n";
  os << indent << "Direction: " << this->Direction[0] << " " << this->Direction[1] << " "
     << this->Direction[2] << "\n";
  os << indent << "Length: " << this->Length << "\n";
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Resolution: " << this->Resolution << "\n";
}
