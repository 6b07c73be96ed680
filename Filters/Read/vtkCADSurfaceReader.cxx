#include "vtkCADSurfaceReader.h"

#include "CADChildProcess.h"
#include "CADFormat.h"
#include "FirstRank.h"
#include "NURBSTessellation.h"
#include "OutOfMemory.h"
#include "PropertyLimits.h"

#include "vtkCommand.h"
#include "vtkCompositeDataSet.h"
#include "vtkInformation.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <string>
#include <vector>

vtkStandardNewMacro(vtkCADSurfaceReader);

namespace
{
/// Share of the progress that reading takes; the rest is the tessellation.
constexpr double ReadShare = 0.8;
}

//------------------------------------------------------------------------------
vtkCADSurfaceReader::vtkCADSurfaceReader()
{
  this->SetNumberOfInputPorts(0);
}

//------------------------------------------------------------------------------
vtkCADSurfaceReader::~vtkCADSurfaceReader()
{
  this->SetFileName(nullptr);
}

//------------------------------------------------------------------------------
double vtkCADSurfaceReader::InMillimetres(int lengthUnit)
{
  switch (lengthUnit)
  {
    case CENTIMETRE:
      return 10.0;
    case METRE:
      return 1000.0;
    case INCH:
      return 25.4;
    case FOOT:
      return 304.8;
    case MICROMETRE:
      return 1e-3;
    default:
      return 1.0;
  }
}

//------------------------------------------------------------------------------
int vtkCADSurfaceReader::CanReadFile(const char* fileName)
{
  // By its name alone, too: else ParaView would ask for a reader, and nobody told what is wrong
  // with the file.
  return fileName &&
      (nurbs::IsCalledCADFile(fileName) ||
        nurbs::RecognizeCADFile(fileName) != nurbs::CADFormat::None)
    ? 1
    : 0;
}

//------------------------------------------------------------------------------
int vtkCADSurfaceReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  return nurbs::WithinMemory(this, outputVector, "The CAD file takes",
    "choose a smaller Resolution", [&] { return this->Read(outputVector); });
}

//------------------------------------------------------------------------------
int vtkCADSurfaceReader::Read(vtkInformationVector* outputVector)
{
  vtkMultiBlockDataSet* output = vtkMultiBlockDataSet::GetData(outputVector);
  auto goOn = [this](double share)
  {
    this->UpdateProgress(ReadShare * share);
    this->InvokeEvent(vtkCommand::AbortCheckEvent);
    return !this->CheckAbort();
  };
  std::vector<nurbs::NamedSurface> surfaces;
  std::string message = nurbs::FindChoiceDefect("LengthUnit", this->LengthUnit, MICROMETRE);
  // All ranks read the file, and one tells of it.
  const bool first = nurbs::IsFirstRank(vtkMultiProcessController::GetGlobalController());
  if (!message.empty() ||
    !nurbs::ReadCADFileInChild(this->FileName ? this->FileName : "",
      InMillimetres(this->LengthUnit), this->JoinBodies, surfaces, message, this->TimeLimit, goOn))
  {
    if (!message.empty() && first)
    {
      vtkErrorMacro(<< message << ".");
    }
    // Not 0: the executive would add an error of its own, at every update again.
    return 1;
  }
  if (!message.empty() && first)
  {
    vtkWarningMacro(<< message << ".");
  }

  vtkNew<vtkMultiBlockDataSet> blocks;
  for (size_t i = 0; i < surfaces.size(); ++i)
  {
    this->UpdateProgress(ReadShare +
      (1.0 - ReadShare) * static_cast<double>(i) / static_cast<double>(surfaces.size()));
    if (this->CheckAbort())
    {
      return 1;
    }
    vtkNew<vtkPolyData> face;
    nurbs::TessellateNURBS(surfaces[i].Surface, this->Resolution, face);
    const unsigned int block = static_cast<unsigned int>(i);
    blocks->SetBlock(block, face);
    blocks->GetMetaData(block)->Set(vtkCompositeDataSet::NAME(), surfaces[i].Name.c_str());
  }
  output->ShallowCopy(blocks);
  return 1;
}

//------------------------------------------------------------------------------
void vtkCADSurfaceReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "LengthUnit: " << this->LengthUnit << "\n";
  os << indent << "JoinBodies: " << this->JoinBodies << "\n";
  os << indent << "TimeLimit: " << this->TimeLimit << "\n";
  os << indent << "Resolution: " << this->Resolution << "\n";
}
