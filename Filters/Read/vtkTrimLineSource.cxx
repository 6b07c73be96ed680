#include "vtkTrimLineSource.h"

#include "CADChildProcess.h"
#include "CADFormat.h"
#include "CurveChain.h"
#include "FirstRank.h"
#include "GridState.h"
#include "NURBSTessellation.h"
#include "OutOfMemory.h"
#include "PlaceText.h"
#include "PropertyLimits.h"
#include "SheetSkin.h"
#include "TrimLineFile.h"
#include "TrimLineSweep.h"
#include "vtkCADSurfaceReader.h"

#include "vtkCompositeDataSet.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkWeakPointer.h"

#include <algorithm>
#include <filesystem>
#include <new>
#include <string>
#include <system_error>
#include <tuple>

namespace
{
/// What a file may have changed by.
using FileStamp = std::tuple<std::string, std::filesystem::file_time_type, std::uintmax_t, int>;

FileStamp StampOf(const std::string& path, int lengthUnit)
{
  std::error_code unread;
  return { path, std::filesystem::last_write_time(path, unread),
    std::filesystem::file_size(path, unread), lengthUnit };
}

/// What the user has to know of a direction that nobody gave; empty: somebody did, or what is wrong
/// is the length.
std::string DescribeFound(const nurbs::Sweep& wanted, const nurbs::Sweep& used, bool onSheet)
{
  if (!wanted.Direction.isZero(0.0) || !(used.Length > 0.0))
  {
    return {};
  }
  const std::string direction =
    "; Direction was not given and found to be " + nurbs::PlaceText(used.Direction);
  return onSheet ? direction +
      ", as the skin of Sheet faces near the line: a line round a wall, where the skin "
      "turns, goes along no one direction; give one, or cut by a plane"
                 : direction;
}

/// The sweep as it was used, for those who want to know.
void WriteSweep(const nurbs::Sweep& sweep, vtkPolyData* output)
{
  vtkNew<vtkDoubleArray> direction;
  direction->SetName("Direction");
  direction->SetNumberOfComponents(3);
  direction->InsertNextTuple(sweep.Direction.data());
  output->GetFieldData()->AddArray(direction);
  vtkNew<vtkDoubleArray> length;
  length->SetName("Length");
  length->InsertNextValue(sweep.Length);
  output->GetFieldData()->AddArray(length);
}

/// The surface of the line, or those of several as named blocks.
void WriteSurfaces(const std::vector<nurbs::TrimLine>& lines, const nurbs::Sweep& sweep,
  int resolution, vtkInformationVector* outputVector)
{
  const std::vector<nurbs::NurbsSurface> surfaces = nurbs::SweepLines(lines, sweep);
  if (vtkPolyData* output = vtkPolyData::GetData(outputVector))
  {
    nurbs::TessellateNURBS(surfaces[0], resolution, output);
    WriteSweep(sweep, output);
    return;
  }
  vtkMultiBlockDataSet* blocks = vtkMultiBlockDataSet::GetData(outputVector);
  for (unsigned int i = 0; i < surfaces.size(); ++i)
  {
    vtkNew<vtkPolyData> block;
    nurbs::TessellateNURBS(surfaces[i], resolution, block);
    WriteSweep(sweep, block);
    blocks->SetBlock(i, block);
    const std::string& name = lines[i].Name;
    blocks->GetMetaData(i)->Set(
      vtkCompositeDataSet::NAME(), name.empty() ? "Line " + std::to_string(i + 1) : name);
  }
}
}

/// What was made of the inputs is kept until they change.
struct vtkTrimLineSource::Cache
{
  std::vector<nurbs::TrimLine> Lines;
  std::string Error;   ///< not empty: there are no lines
  std::string Warning; ///< of reading them
  vtkMTimeType LinesTime = 0;

  FileStamp Stamp;
  bool HasFile = false;    ///< Curves are those of the file
  std::string FileMessage; ///< error or warning of reading it
  std::vector<nurbs::FileCurve> Curves;

  vtkWeakPointer<vtkDataObject> Sheet;
  std::vector<nurbs::GridState> SheetStates;
  nurbs::SheetSkin Skin;
  std::string SheetError; ///< not empty: there is no skin

  void TakeSheet(vtkDataObject* sheet, vtkMultiProcessController* ranks)
  {
    auto states = sheet ? nurbs::StatesOf(sheet) : std::vector<nurbs::GridState>();
    if (this->Sheet != sheet || !(this->SheetStates == states) || !sheet)
    {
      this->Skin = nurbs::SheetSkin();
      this->SheetError.clear();
      this->Sheet = sheet;
      this->SheetStates = std::move(states);
      this->BuildSkin(sheet);
    }
    this->Skin.Ranks = sheet ? ranks : nullptr;
  }

  /// Where memory runs out that is told with the other errors, as other ranks wait to hear of it;
  /// the next update tries again.
  void BuildSkin(vtkDataObject* sheet)
  {
    try
    {
      if (sheet)
      {
        nurbs::BuildSheetSkin(sheet, this->Skin, this->SheetError);
      }
    }
    catch (const std::bad_alloc&)
    {
      this->Skin = nurbs::SheetSkin();
      this->SheetStates.clear();
      this->SheetError = nurbs::MemoryText(
        "The skin of Sheet takes", "take the sheet out and give Direction and Length instead");
    }
  }

  /// Curves from a file, read anew only if it has changed.
  void TakeCurves(const std::string& path, int lengthUnit, const nurbs::ReadProgress& progress)
  {
    const FileStamp stamp = StampOf(path, lengthUnit);
    if (!this->HasFile || stamp != this->Stamp)
    {
      const double unit = vtkCADSurfaceReader::InMillimetres(lengthUnit);
      this->HasFile =
        nurbs::ReadCADCurvesInChild(path, unit, this->Curves, this->FileMessage, progress);
      this->Stamp = stamp;
    }
    if (!this->HasFile)
    {
      this->Error = this->FileMessage;
      // Without an error it was stopped: the next update tries again.
      this->LinesTime = this->Error.empty() ? 0 : this->LinesTime;
      return;
    }
    this->Warning = this->FileMessage;
    std::string message;
    if (!nurbs::JoinCurves(this->Curves, this->Lines, message))
    {
      this->Error = "CAD file \"" + path + "\": " + message;
    }
    else if (!message.empty())
    {
      nurbs::AddRemark(path, message, this->Warning);
    }
  }

  void TakePoints(std::vector<nurbs::Vec3> points, bool closed, int lineType)
  {
    const std::string defect = nurbs::FindPointDefect(points, closed);
    if (!defect.empty())
    {
      this->Error = "The trim line is not valid: " + defect;
      return;
    }
    this->Lines = { lineType == POLYLINE ? nurbs::MakePolyline(points, closed)
                                         : nurbs::MakeSpline(points, closed) };
  }
};

vtkStandardNewMacro(vtkTrimLineSource);
vtkCxxSetObjectMacro(vtkTrimLineSource, Controller, vtkMultiProcessController);

//------------------------------------------------------------------------------
vtkTrimLineSource::vtkTrimLineSource()
  : Kept(new Cache)
{
  this->SetNumberOfInputPorts(1);
  this->SetController(vtkMultiProcessController::GetGlobalController());
  this->Points = { -0.5, 0.0, 0.0, -0.25, 0.1, 0.0, 0.0, 0.0, 0.0, 0.25, -0.1, 0.0, 0.5, 0.0, 0.0 };
}

//------------------------------------------------------------------------------
vtkTrimLineSource::~vtkTrimLineSource()
{
  this->SetController(nullptr);
  this->SetFileName(nullptr);
}

//------------------------------------------------------------------------------
void vtkTrimLineSource::SetSheetConnection(int, vtkAlgorithmOutput* mesh)
{
  this->SetInputConnection(0, mesh);
}

//------------------------------------------------------------------------------
void vtkTrimLineSource::SetNumberOfPoints(int count)
{
  if (count > nurbs::MostValues)
  {
    vtkErrorMacro(<< "A number of " << count << " is more than the " << nurbs::MostValues
                  << " points that a line may have.");
    return;
  }
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
  if (index >= nurbs::MostValues)
  {
    vtkErrorMacro(<< "Index " << index << " is too large; the last point may be "
                  << nurbs::MostValues - 1 << ".");
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
int vtkTrimLineSource::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  // This order: with the grid alone the executive would loop over the blocks of a composite.
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkUnstructuredGrid");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  return 1;
}

//------------------------------------------------------------------------------
int vtkTrimLineSource::FillOutputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), "vtkDataObject");
  return 1;
}

//------------------------------------------------------------------------------
vtkTypeBool vtkTrimLineSource::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()))
  {
    return this->RequestDataObject(request, inputVector, outputVector);
  }
  return this->Superclass::ProcessRequest(request, inputVector, outputVector);
}

//------------------------------------------------------------------------------
const vtkTrimLineSource::Cache& vtkTrimLineSource::TakeLines()
{
  Cache& kept = *this->Kept;
  if (kept.LinesTime == this->GetMTime() && kept.LinesTime != 0)
  {
    return kept;
  }
  kept.LinesTime = this->GetMTime();
  try
  {
    this->MakeLines();
  }
  catch (const std::bad_alloc&)
  {
    kept.Lines.clear();
    kept.HasFile = false;
    kept.Error = nurbs::MemoryText("The trim line takes", "give a line of fewer points");
    kept.LinesTime = 0; // the next update tries again
  }
  return kept;
}

//------------------------------------------------------------------------------
void vtkTrimLineSource::MakeLines()
{
  Cache& kept = *this->Kept;
  kept.Lines.clear();
  kept.Warning.clear();
  kept.Error = nurbs::FindChoiceDefect("LineType", this->LineType, POLYLINE);
  if (kept.Error.empty())
  {
    kept.Error =
      nurbs::FindChoiceDefect("LengthUnit", this->LengthUnit, vtkCADSurfaceReader::MICROMETRE);
  }
  if (!kept.Error.empty())
  {
    return;
  }
  const std::string path = this->FileName ? this->FileName : "";
  if (!path.empty() && nurbs::RecognizeCADFile(path) != nurbs::CADFormat::None)
  {
    auto goOn = [this](double share)
    {
      this->UpdateProgress(share);
      return !this->CheckAbort();
    };
    kept.TakeCurves(path, this->LengthUnit, goOn);
    return;
  }
  std::vector<nurbs::Vec3> points;
  bool closed = this->Closed != 0;
  if (path.empty())
  {
    for (size_t i = 0; i + 2 < this->Points.size(); i += 3)
    {
      points.emplace_back(this->Points.data() + i);
    }
  }
  else
  {
    if (!nurbs::ReadTrimLineFile(path, points, kept.Error))
    {
      return;
    }
    // Contours in files end where they began, but for the digits that were written.
    if (points.size() > 3 && nurbs::EndsWhereItBegins(points))
    {
      closed = true;
      points.pop_back();
    }
  }
  kept.TakePoints(std::move(points), closed, this->LineType);
}

//------------------------------------------------------------------------------
int vtkTrimLineSource::RequestDataObject(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  // Only the file tells how many lines there are.
  const bool several = this->TakeLines().Lines.size() > 1;
  vtkInformation* info = outputVector->GetInformationObject(0);
  vtkDataObject* output = info->Get(vtkDataObject::DATA_OBJECT());
  if (several && !vtkMultiBlockDataSet::SafeDownCast(output))
  {
    info->Set(vtkDataObject::DATA_OBJECT(), vtkNew<vtkMultiBlockDataSet>());
  }
  else if (!several && !vtkPolyData::SafeDownCast(output))
  {
    info->Set(vtkDataObject::DATA_OBJECT(), vtkNew<vtkPolyData>());
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkTrimLineSource::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const Cache& kept = this->TakeLines();
  vtkDataObject* sheet = vtkDataObject::GetData(inputVector[0]);
  this->Kept->TakeSheet(sheet, this->Controller);
  // What follows asks all ranks for their pieces of the sheet, if there is one.
  const std::string error = kept.Skin.FirstText(kept.Error);
  const std::string sheetError = kept.Skin.FirstText(kept.SheetError);
  const bool ready = kept.Skin.AllAgree(!kept.Lines.empty()) && error.empty() && sheetError.empty();
  const bool first = nurbs::IsFirstRank(this->Controller); // one tells for all
  for (const std::string& text : { sheetError, error })
  {
    if (!text.empty() && first)
    {
      vtkErrorMacro(<< text << ".");
    }
  }
  if (!ready)
  {
    // Not 0: the executive would add an error of its own, at every update again.
    return 1;
  }
  if (!kept.Warning.empty() && first)
  {
    vtkWarningMacro(<< kept.Warning << ".");
  }
  const nurbs::Sweep wanted{ nurbs::Vec3(this->Direction), this->Length };
  const bool asksSheet = wanted.Direction.isZero(0.0) || wanted.Length == 0.0;
  if (sheet && asksSheet && kept.Skin.IsEmpty() && first)
  {
    vtkWarningMacro(<< "The sheet has no hexahedra or wedges, so Direction and Length are found as "
                       "without one; choose the mesh to be trimmed as Sheet.");
  }
  const auto within = [this, outputVector](const auto& work)
  {
    return nurbs::WithinMemory(this, outputVector, "The surface of the trim line takes",
      "choose a smaller Resolution", work);
  };
  nurbs::Sweep sweep;
  bool valid = false;
  const auto complete = [&]
  {
    sweep = nurbs::CompleteSweep(wanted, kept.Lines, &kept.Skin);
    const std::string defect = nurbs::FindDefect(kept.Lines, sweep);
    valid = defect.empty();
    if (!valid && first)
    {
      vtkErrorMacro(<< "The trim line is not valid: " << defect
                    << DescribeFound(wanted, sweep, sheet != nullptr) << ".");
    }
    return 1;
  };
  // Of several ranks the others would wait for ever for one that gives up meanwhile.
  const bool alone = !this->Controller || this->Controller->GetNumberOfProcesses() < 2;
  alone ? within(complete) : complete();
  if (!valid)
  {
    return 1;
  }
  return within(
    [&]
    {
      WriteSurfaces(kept.Lines, sweep, this->Resolution, outputVector);
      return 1;
    });
}

//------------------------------------------------------------------------------
void vtkTrimLineSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfPoints: " << this->GetNumberOfPoints() << "\n";
  os << indent << "Closed: " << this->Closed << "\n";
  os << indent << "LineType: " << this->LineType << "\n";
  os << indent << "Direction: " << this->Direction[0] << " " << this->Direction[1] << " "
     << this->Direction[2] << "\n";
  os << indent << "Length: " << this->Length << "\n";
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "LengthUnit: " << this->LengthUnit << "\n";
  os << indent << "Resolution: " << this->Resolution << "\n";
  os << indent << "Controller: " << this->Controller << "\n";
}
