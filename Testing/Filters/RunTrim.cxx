#include "RunTrim.h"

#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>
#include <vtkPointData.h>
#include <vtkTrimHexahedralGrid.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>

namespace judge
{
namespace
{
class ListeningWindow : public vtkOutputWindow
{
public:
  static ListeningWindow* New();
  vtkTypeMacro(ListeningWindow, vtkOutputWindow);
  void DisplayErrorText(const char* text) override { this->Errors.emplace_back(text); }
  void DisplayWarningText(const char* text) override { this->Warnings.emplace_back(text); }
  void DisplayGenericWarningText(const char* text) override { this->Warnings.emplace_back(text); }
  std::vector<std::string> Errors, Warnings;
};
vtkStandardNewMacro(ListeningWindow);
}

struct Listener::Window
{
  vtkNew<ListeningWindow> Ears;
  vtkSmartPointer<vtkOutputWindow> Before;
};

Listener::Listener()
  : Own(new Window)
{
  this->Own->Before = vtkOutputWindow::GetInstance();
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  vtkOutputWindow::SetInstance(this->Own->Ears);
}

Listener::~Listener()
{
  vtkOutputWindow::SetInstance(this->Own->Before);
  delete this->Own;
}

std::vector<std::string> Listener::Errors() const
{
  return this->Own->Ears->Errors;
}

std::vector<std::string> Listener::Warnings() const
{
  return this->Own->Ears->Warnings;
}

void SetOptions(vtkTrimHexahedralGrid* filter, const TrimOptions& options)
{
  filter->SetCorrectionType(options.CorrectionType);
  filter->SetOptimization(options.Optimization);
  filter->SetInvertSide(options.InvertSide);
  filter->SetUseKeepPoint(options.UseKeepPoint);
  filter->SetKeepPoint(options.KeepPoint[0], options.KeepPoint[1], options.KeepPoint[2]);
  filter->SetEliminationFraction(options.EliminationFraction);
  filter->SetRenumberNodes(options.RenumberNodes);
  filter->SetTolerance(options.Tolerance);
  filter->SetProduceOffcut(options.ProduceOffcut);
  filter->SetMinimumScaledJacobian(options.MinimumScaledJacobian);
  filter->SetMapValues(options.MapValues);
  filter->SetInsertLayer(options.InsertLayer);
}

Outcome RunTrim(const Mesh& mesh, const Surface& surface, const TrimOptions& options)
{
  Outcome outcome;
  outcome.Case.Input = &mesh;
  outcome.Case.Cut = &surface;
  outcome.Case.Options = options;
  const Listener listener;
  vtkNew<vtkTrimHexahedralGrid> filter;
  SetOptions(filter, options);
  filter->SetInputDataObject(0, mesh.Grid);
  filter->SetInputDataObject(1, surface.Data);
  filter->Update();
  outcome.Case.Trimmed = vtkSmartPointer<vtkUnstructuredGrid>::New();
  outcome.Case.Trimmed->ShallowCopy(filter->GetOutputDataObject(0));
  outcome.Case.Whole = vtkSmartPointer<vtkUnstructuredGrid>::New();
  outcome.Case.Whole->ShallowCopy(filter->GetOutputDataObject(1));
  outcome.Offcut = vtkSmartPointer<vtkUnstructuredGrid>::New();
  outcome.Offcut->ShallowCopy(filter->GetOutputDataObject(2));
  outcome.Errors = listener.Errors();
  outcome.Warnings = listener.Warnings();
  return outcome;
}

double Number(vtkUnstructuredGrid* grid, const char* name)
{
  return grid->GetFieldData()->GetArray(name)->GetComponent(0, 0);
}

int CountWarned(const Outcome& outcome, const std::string& phrase)
{
  for (const std::string& warning : outcome.Warnings)
  {
    const std::size_t start = warning.find("): ");
    if (warning.find(phrase) != std::string::npos && start != std::string::npos)
    {
      return std::atoi(warning.c_str() + start + 3);
    }
  }
  return 0;
}

int CountLeft(vtkUnstructuredGrid* trimmed)
{
  vtkDataArray* left = trimmed->GetPointData()->GetArray("DistanceLeft");
  int count = 0;
  for (vtkIdType i = 0; i < left->GetNumberOfTuples(); ++i)
  {
    count += left->GetComponent(i, 0) > 0;
  }
  return count;
}

std::string Rescues(vtkUnstructuredGrid* trimmed)
{
  std::string text;
  vtkFieldData* data = trimmed->GetFieldData();
  for (int i = 0; i < data->GetNumberOfArrays(); ++i)
  {
    vtkDataArray* array = data->GetArray(i);
    if (array && array->GetName() && std::strncmp(array->GetName(), "Rescued", 7) == 0 &&
      array->GetNumberOfValues() == 1 && array->GetComponent(0, 0) > 0)
    {
      text += (text.empty() ? "" : " ") + std::string(array->GetName()) + "=" +
        std::to_string(static_cast<long>(array->GetComponent(0, 0)));
    }
  }
  return text;
}

// Of the cut elements; none to be checked where there is a warning of what is lost or stays.
double ShareOfChords(const Outcome& outcome)
{
  // In 500 trims of the campaign without a warning it was 0.12 at most.
  double share = 0.15;
  for (const std::string& warning : outcome.Warnings)
  {
    const auto says = [&warning](const char* phrase)
    { return warning.find(phrase) != std::string::npos; };
    if (!says("bends with a radius") && !says("less than 45 degrees"))
    {
      return std::numeric_limits<double>::infinity();
    }
    share = 0.25;
  }
  return share;
}

Outcome RunAndJudge(
  const Mesh& mesh, const Surface& surface, const TrimOptions& options, Report& report)
{
  Outcome outcome = RunTrim(mesh, surface, options);
  for (const std::string& error : outcome.Errors)
  {
    report.Fail("error", error);
  }
  if (outcome.Clean())
  {
    const Evidence evidence(outcome.Case, report);
    JudgeAll(evidence, report);
    const bool onSurface =
      options.CorrectionType != 1 && std::abs(options.EliminationFraction - 0.5) < 1e-9;
    if (evidence.Usable && onSurface)
    {
      CheckNothingKept(evidence, report);
      CheckKeptVolume(evidence, ShareOfChords(outcome), report);
    }
  }
  return outcome;
}

double JudgeBothSides(const Mesh& mesh, const Surface& surface, TrimOptions options, Report& report)
{
  const Outcome kept = RunTrim(mesh, surface, options);
  options.InvertSide = !options.InvertSide;
  const Outcome offcut = RunTrim(mesh, surface, options);
  for (const Outcome* outcome : { &kept, &offcut })
  {
    for (const std::string& error : outcome->Errors)
    {
      report.Fail("error", error);
    }
  }
  if (!kept.Clean() || !offcut.Clean())
  {
    return std::nan("");
  }
  const Evidence a(kept.Case, report), b(offcut.Case, report);
  for (const Evidence* e : { &a, &b })
  {
    JudgeAll(*e, report);
    if (e->Usable && surface.HasPlane && mesh.Flat && !e->HasOrphans() &&
      options.CorrectionType != 1)
    {
      const double side = e->Signed(surface.PlanePoint + surface.PlaneNormal) > 0 ? 1 : -1;
      CheckPlaneVolume(*e, surface.PlanePoint, side * surface.PlaneNormal, report);
    }
  }
  if (a.Usable && b.Usable)
  {
    CheckPair(a, b, report);
  }
  return std::fmin(a.Number("MinimumScaledJacobian"), b.Number("MinimumScaledJacobian"));
}

}
