#include "vtkTrimHexahedralGrid.h"

#include "ArrayRanges.h"
#include "ControllerRanks.h"
#include "GhostCells.h"
#include "InputScale.h"
#include "InputTimes.h"
#include "NameClashes.h"
#include "NodeOrdering.h"
#include "OffcutGrid.h"
#include "PagePool.h"
#include "Team.h"
#include "ThreadScope.h"
#include "TrimInputs.h"
#include "TrimPipeline.h"
#include "TrimmedGrid.h"

#include "vtkCellArray.h"
#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPoints.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <array>
#include <functional>
#include <new>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

namespace
{

/// Of ports 0 to 2.
using Outputs = std::array<vtkUnstructuredGrid*, 3>;

Outputs OutputsOf(vtkInformationVector* outputVector)
{
  Outputs outputs;
  for (std::size_t port = 0; port < outputs.size(); ++port)
  {
    outputs[port] = vtkUnstructuredGrid::GetData(outputVector, static_cast<int>(port));
  }
  return outputs;
}

/// Without these arrays a grid is empty, too, but ParaView's writers of XML files crash on it.
void AddEmptyArrays(vtkUnstructuredGrid* output)
{
  output->SetPoints(vtkNew<vtkPoints>());
  output->SetCells(vtkNew<vtkUnsignedCharArray>(), vtkNew<vtkCellArray>());
}

void Clear(const Outputs& outputs)
{
  for (vtkUnstructuredGrid* output : outputs)
  {
    output->Initialize();
    AddEmptyArrays(output);
  }
}

/// What is wrong with the options of this rank; empty: nothing.
std::string FindOwnOptionDefect(
  int correctionType, int optimization, const trim::TrimOptions& options)
{
  struct Number
  {
    const char* Name;
    double Value, Least, Most;
    const char* Advice;
  };
  const auto& ladder = options.OfBand.Ladder;
  const char* const share = "a number from 0 to 1";
  const Number numbers[] = {
    { "CorrectionType", static_cast<double>(correctionType), 1, 3, "1, 2 or 3" },
    { "Optimization", static_cast<double>(optimization), 0, 2, "0, 1 or 2" },
    { "EliminationFraction", ladder.EliminationFraction, 0, 1, share },
    { "MinimumScaledJacobian", ladder.QualityFloor, 0, 1, share },
    { "Tolerance", options.Tolerance, 0, 1, share },
  };
  for (const Number& number : numbers)
  {
    if (!(number.Value >= number.Least && number.Value <= number.Most))
    {
      std::ostringstream text;
      text << number.Name << " is " << number.Value << ": give " << number.Advice << ".";
      return text.str();
    }
  }
  const bool near = options.KeepPoint.cwiseAbs().maxCoeff() < trim::LargestCoordinate;
  return options.UseKeepPoint && !(options.KeepPoint.allFinite() && near)
    ? "KeepPoint has a coordinate that is not finite or too large: give a point in the part of the "
      "grid that is to stay."
    : "";
}

/// An option's value, as a number.
struct OptionValue
{
  const char* Name;
  double Value;
};

/// Scripts may give each rank its own: with several values each would trim in another way, or wait
/// for the others for ever.
/// @return what is wrong; empty: nothing. Collective.
std::string FindOptionsApart(const std::vector<OptionValue>& own, const trim::Ranks& ranks)
{
  std::vector<double> values;
  for (const OptionValue& option : own)
  {
    values.push_back(option.Value);
  }
  const std::vector<double> all = ranks.Gather(values);
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    if (all[i] != all[i % own.size()])
    {
      return std::string("The ranks have different values of ") + own[i % own.size()].Name +
        ": give all of them the same options.";
    }
  }
  return "";
}

/// The result of work(), which takes time. In its loops the caller looks what others want; not when
/// the outputs are written, as these may look at them.
template <typename Work>
trim::TrimResult WhileLooking(const std::function<void()>& look, const Work& work)
{
  trim::Team* const team = trim::Team::Current();
  if (!team)
  {
    return work();
  }
  team->SetLook(look);
  trim::TrimResult result = work();
  team->SetLook({});
  return result;
}

/// Whether so many elements of this rank can be renumbered. Collective.
/// @param[in,out] warnings get another one where a rank has too many.
bool CanRenumber(trim::Id cells, const trim::Ranks& ranks, std::vector<std::string>& warnings)
{
  const bool can = trim::CanOrderNodes(cells);
  const std::string lack =
    ranks.FirstText(can ? ""
                        : "The nodes keep their order, as " + std::to_string(cells) +
          " elements are too many to renumber at once: distribute the grid over several ranks.");
  if (!lack.empty())
  {
    warnings.push_back(lack);
  }
  return can;
}

/// @param[in,out] result gets another warning where arrays of the input had to be renamed.
void WriteOutputs(const trim::TrimInputs& inputs, trim::TrimResult& result,
  const trim::Ranks& ranks, const trim::WriteOptions& options, bool offcut,
  const trim::Progress& progress, const Outputs& outputs)
{
  std::string renamed;
  const auto own = trim::ResolveNameClashes(inputs.Own().Grid, renamed);
  renamed = ranks.FirstText(renamed);
  if (!renamed.empty())
  {
    result.Warnings.push_back(renamed);
  }
  const trim::WriteInput from{ own, inputs.Mesh(), inputs.Blocks(), ranks, result, options,
    progress };
  trim::WriteTrimmedGrid(from, inputs.Surface(), outputs[0]);
  trim::RestoreOriginalIds(inputs.Own(), outputs[0]);
  trim::WriteStatusGrid(own, result, outputs[1]);
  if (offcut)
  {
    trim::WriteOffcutGrid(from, outputs[2]);
    trim::RestoreOriginalIds(inputs.Own(), outputs[2]);
  }
}

}

vtkStandardNewMacro(vtkTrimHexahedralGrid);

//------------------------------------------------------------------------------
vtkTrimHexahedralGrid::vtkTrimHexahedralGrid()
  : Inputs(new trim::TrimInputs)
  , Pages(new nurbs::PageUser)
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(3);
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

//------------------------------------------------------------------------------
vtkTrimHexahedralGrid::~vtkTrimHexahedralGrid()
{
  this->SetController(nullptr);
}

//------------------------------------------------------------------------------
void vtkTrimHexahedralGrid::SetController(vtkMultiProcessController* controller)
{
  if (this->Controller != controller)
  {
    this->Inputs->ForgetOtherRanks();
  }
  vtkSetObjectBodyMacro(Controller, vtkMultiProcessController, controller);
}

//------------------------------------------------------------------------------
int vtkTrimHexahedralGrid::FillInputPortInformation(int port, vtkInformation* info)
{
  // Optional, so that a missing one is reported by RequestData, with the remedy.
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  // This order: without composites the executive would loop over the blocks of one.
  info->Set(
    vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkUnstructuredGrid" : "vtkDataSet");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkCompositeDataSet");
  // Anything, as RequestData refuses it once, with the remedy, and the executive at each request.
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  return 1;
}

//------------------------------------------------------------------------------
int vtkTrimHexahedralGrid::Refuse(const trim::Ranks& ranks, const std::string& error)
{
  if (ranks.Rank() == 0)
  {
    vtkErrorMacro(<< error);
  }
  return 1;
}

//------------------------------------------------------------------------------
trim::TrimOptions vtkTrimHexahedralGrid::Options() const
{
  trim::TrimOptions options;
  options.OfBand.Ladder.CorrectionType = static_cast<trim::Correction>(this->CorrectionType);
  options.OfBand.Ladder.Treatment = static_cast<trim::Optimization>(this->Optimization);
  options.OfBand.Ladder.EliminationFraction = this->EliminationFraction;
  options.OfBand.Ladder.QualityFloor = this->MinimumScaledJacobian;
  options.InvertSide = this->InvertSide;
  options.UseKeepPoint = this->UseKeepPoint;
  options.KeepPoint = trim::Vec3(this->KeepPoint[0], this->KeepPoint[1], this->KeepPoint[2]);
  options.Tolerance = this->Tolerance;
  options.OfBand.ProduceOffcut = this->ProduceOffcut;
  options.OfBand.InsertLayer = this->InsertLayer;
  return options;
}

//------------------------------------------------------------------------------
std::string vtkTrimHexahedralGrid::FindOptionDefect(
  const trim::TrimOptions& options, const trim::Ranks& ranks) const
{
  const std::string defect =
    ranks.FirstText(FindOwnOptionDefect(this->CorrectionType, this->Optimization, options));
  if (!defect.empty() || ranks.Alone())
  {
    return defect;
  }
  const auto flag = [](bool value) { return value ? 1.0 : 0.0; };
  const auto keepPoint = [this](int k) { return this->UseKeepPoint ? this->KeepPoint[k] : 0.0; };
  return FindOptionsApart(
    { { "CorrectionType", static_cast<double>(this->CorrectionType) },
      { "Optimization", static_cast<double>(this->Optimization) },
      { "InvertSide", flag(this->InvertSide) }, { "UseKeepPoint", flag(this->UseKeepPoint) },
      { "KeepPoint", keepPoint(0) }, { "KeepPoint", keepPoint(1) }, { "KeepPoint", keepPoint(2) },
      { "EliminationFraction", this->EliminationFraction },
      { "MinimumScaledJacobian", this->MinimumScaledJacobian }, { "Tolerance", this->Tolerance },
      { "RenumberNodes", flag(this->RenumberNodes) },
      { "QualityOfAllElements", flag(this->QualityOfAllElements) },
      { "MapValues", flag(this->MapValues) }, { "ProduceOffcut", flag(this->ProduceOffcut) },
      { "InsertLayer", flag(this->InsertLayer) } },
    ranks);
}

//------------------------------------------------------------------------------
int vtkTrimHexahedralGrid::RequestInformation(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (!this->Superclass::RequestInformation(request, inputVector, outputVector))
  {
    return 0;
  }
  // VTK passes on the times of the grid alone.
  trim::TellTimes(
    inputVector[0]->GetInformationObject(0), inputVector[1]->GetInformationObject(0), outputVector);
  return 1;
}

//------------------------------------------------------------------------------
int vtkTrimHexahedralGrid::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  if (!this->Superclass::RequestUpdateExtent(request, inputVector, outputVector))
  {
    return 0;
  }
  if (vtkInformation* grid = inputVector[0]->GetInformationObject(0))
  {
    grid->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkTrimHexahedralGrid::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const trim::ControllerRanks ranks(this->Controller);
  int success = 1;
  try
  {
    trim::WithThreads(
      ranks.Alone(), [&]() { success = this->Trim(inputVector, outputVector, ranks); });
    this->Pages->EndRun();
  }
  catch (const std::bad_alloc&) // of any thread, but those of OpenMP: there it ends the process
  {
    if (!ranks.Alone())
    {
      throw; // the other ranks would wait for this one
    }
    return this->GiveUp(outputVector, ranks,
      "The trim needs more memory than there is: close other data, or distribute the grid over "
      "several ranks.");
  }
  catch (const trim::TooMuchToGather&)
  {
    return this->GiveUp(outputVector, ranks,
      "There are more elements near the cut than the ranks can tell each other of: trim on one "
      "rank, or coarsen the grid there.");
  }
  return success;
}

//------------------------------------------------------------------------------
int vtkTrimHexahedralGrid::GiveUp(
  vtkInformationVector* outputVector, const trim::Ranks& ranks, const std::string& error)
{
  this->Inputs = std::make_unique<trim::TrimInputs>();
  Clear(OutputsOf(outputVector));
  nurbs::PagePool::Get().Empty();
  return this->Refuse(ranks, error);
}

//------------------------------------------------------------------------------
int vtkTrimHexahedralGrid::Trim(
  vtkInformationVector** inputVector, vtkInformationVector* outputVector, const trim::Ranks& ranks)
{
  vtkDataObject* const grid = vtkDataObject::GetData(inputVector[0]);
  vtkDataObject* const surface = vtkDataObject::GetData(inputVector[1]);
  const Outputs outputs = OutputsOf(outputVector);
  for (vtkUnstructuredGrid* output : outputs)
  {
    // VTK has passed on the field data of the input already.
    trim::Summary::RemoveFrom(output->GetFieldData());
    AddEmptyArrays(output);
  }
  if (this->IsStopped(ranks, this->CheckAbort())) // of the trim before this one, say
  {
    return 1;
  }
  const trim::TrimOptions options = this->Options();
  std::string error = this->FindOptionDefect(options, ranks);
  if (!error.empty() || !this->Inputs->Take(grid, surface, ranks, error))
  {
    return this->Refuse(ranks, error);
  }

  const trim::Progress progress = this->TellProgress();
  if (this->IsStopped(ranks, progress(0.05)))
  {
    return 1;
  }
  const trim::TrimInputs& inputs = *this->Inputs;
  trim::TrimResult result = WhileLooking([this] { this->LookForAbort(); },
    [&]
    {
      return trim::Trim(inputs.Mesh(), inputs.Blocks(),
        { ranks, inputs.Shared(), inputs.Own().Cells, inputs.GlobalIds() }, inputs.Surface(),
        options, progress);
    });
  if (!result.Error.empty())
  {
    return this->Refuse(ranks, result.Error);
  }
  if (this->IsStopped(ranks, result.Aborted))
  {
    return 1;
  }
  if (!this->Write(result, ranks, progress, outputs))
  {
    return 1;
  }
  for (vtkUnstructuredGrid* output : outputs)
  {
    trim::TellRanges(output);
    trim::TellTime(grid, surface, output);
  }
  this->Warn(ranks, result.Warnings);
  return 1;
}

//------------------------------------------------------------------------------
void vtkTrimHexahedralGrid::LookForAbort()
{
  this->InvokeEvent(vtkCommand::AbortCheckEvent);
  this->SawAbort = this->CheckAbort() || this->GetAbortOutput();
}

//------------------------------------------------------------------------------
bool vtkTrimHexahedralGrid::IsStopped(const trim::Ranks& ranks, bool mine)
{
  const bool stopped = ranks.Any(mine);
  if (stopped)
  {
    this->SetAbortOutput(true);
  }
  return stopped;
}

//------------------------------------------------------------------------------
trim::Progress vtkTrimHexahedralGrid::TellProgress()
{
  this->SawAbort = false;
  // Asked from every thread, but only the caller's looks; negative: no news of the progress.
  return [this, caller = std::this_thread::get_id()](double done)
  {
    if (std::this_thread::get_id() == caller)
    {
      if (done >= 0.0)
      {
        this->UpdateProgress(done);
      }
      this->LookForAbort();
    }
    return this->SawAbort || this->GetAbortExecute();
  };
}

//------------------------------------------------------------------------------
bool vtkTrimHexahedralGrid::Write(trim::TrimResult& result, const trim::Ranks& ranks,
  const trim::Progress& progress, const Outputs& outputs)
{
  const trim::TrimInputs& inputs = *this->Inputs;
  const std::vector<std::string> remarks = inputs.Remarks();
  result.Warnings.insert(result.Warnings.begin(), remarks.begin(), remarks.end());
  const bool renumber =
    this->RenumberNodes && CanRenumber(inputs.Mesh().NumberOfCells, ranks, result.Warnings);
  WriteOutputs(inputs, result, ranks,
    { renumber, this->QualityOfAllElements, this->MapValues, this->InsertLayer },
    this->ProduceOffcut, progress, outputs);
  if (this->IsStopped(ranks, progress(1.0)))
  {
    Clear(outputs);
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkTrimHexahedralGrid::Warn(const trim::Ranks& ranks, const std::vector<std::string>& warnings)
{
  for (std::size_t i = 0; ranks.Rank() == 0 && i < warnings.size(); ++i)
  {
    vtkWarningMacro(<< warnings[i]);
  }
}

//------------------------------------------------------------------------------
void vtkTrimHexahedralGrid::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "CorrectionType: " << this->CorrectionType << endl;
  os << indent << "Optimization: " << this->Optimization << endl;
  os << indent << "InvertSide: " << this->InvertSide << endl;
  os << indent << "UseKeepPoint: " << this->UseKeepPoint << endl;
  os << indent << "KeepPoint: " << this->KeepPoint[0] << " " << this->KeepPoint[1] << " "
     << this->KeepPoint[2] << endl;
  os << indent << "EliminationFraction: " << this->EliminationFraction << endl;
  os << indent << "MinimumScaledJacobian: " << this->MinimumScaledJacobian << endl;
  os << indent << "RenumberNodes: " << this->RenumberNodes << endl;
  os << indent << "QualityOfAllElements: " << this->QualityOfAllElements << endl;
  os << indent << "MapValues: " << this->MapValues << endl;
  os << indent << "Tolerance: " << this->Tolerance << endl;
  os << indent << "ProduceOffcut: " << this->ProduceOffcut << endl;
  os << indent << "InsertLayer: " << this->InsertLayer << endl;
  os << indent << "Controller: " << this->Controller << endl;
}
