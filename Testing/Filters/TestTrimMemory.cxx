/**
 * @file TestTrimMemory.cxx
 * @brief Memory that is not to be had, at one allocation after the other: one error that says so,
 * empty outputs, and the filter works afterwards.
 *
 * TestTrimMemory refusals|limits: by operator new, or by the size of the process, which sanitizers
 * do not stand.
 */
#include "Expect.h"
#include "RunTrim.h"
#include "Shortage.h"

#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkSMPTools.h>
#include <vtkTrimHexahedralGrid.h>

#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <fstream>

using namespace judge;

namespace
{
/// VTK's own field data do not survive that they miss a few bytes.
constexpr std::size_t Few = 4096;

/// The trim alone runs short of memory, not the pipeline round it.
class ShortFilter : public vtkTrimHexahedralGrid
{
public:
  static ShortFilter* New();
  vtkTypeMacro(ShortFilter, vtkTrimHexahedralGrid);

protected:
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override
  {
    const Shortage shortage;
    return this->Superclass::RequestData(request, inputVector, outputVector);
  }
};
vtkStandardNewMacro(ShortFilter);

struct Case
{
  std::string Name;
  const Mesh& TheMesh;
  const Surface& TheSurface;
  TrimOptions Options;
};

class ShortTrim
{
public:
  explicit ShortTrim(const Case& trial)
  {
    this->Filter->SetInputDataObject(0, trial.TheMesh.Grid);
    this->Filter->SetInputDataObject(1, trial.TheSurface.Data);
    SetOptions(this->Filter, trial.Options);
  }

  /// @return how many allocations there were that could have been refused.
  long Run(const Shortage::Refusal& refusal)
  {
    Shortage::Plan(refusal);
    this->Filter->Modified();
    this->Filter->Update();
    return Shortage::Seen();
  }

  vtkUnstructuredGrid* Output(int port) const
  {
    return vtkUnstructuredGrid::SafeDownCast(this->Filter->GetOutputDataObject(port));
  }

private:
  vtkNew<ShortFilter> Filter;
};

constexpr Shortage::Refusal NoRefusal{ -1, false, Few };

bool AreSame(vtkUnstructuredGrid* a, vtkUnstructuredGrid* b)
{
  const vtkIdType points = a->GetNumberOfPoints();
  if (points != b->GetNumberOfPoints() || a->GetNumberOfCells() != b->GetNumberOfCells())
  {
    return false;
  }
  return points == 0 ||
    std::memcmp(a->GetPoints()->GetVoidPointer(0), b->GetPoints()->GetVoidPointer(0),
      3 * points * a->GetPoints()->GetData()->GetDataTypeSize()) == 0;
}

/// The trim that there is with memory enough.
struct Whole
{
  std::array<vtkSmartPointer<vtkUnstructuredGrid>, 3> Output;
  long Allocations;
};

/// Its filter goes: memory that is kept for that would serve those that are to miss some.
Whole RunWhole(const Case& trial)
{
  Whole whole;
  ShortTrim trim(trial);
  Listener listener;
  whole.Allocations = trim.Run(NoRefusal);
  for (int port = 0; port < 3; ++port)
  {
    whole.Output[port] = trim.Output(port);
  }
  Expect(listener.Errors().empty() && whole.Output[0]->GetNumberOfCells() > 0,
    trial.Name + ": no trim to begin with");
  return whole;
}

/// One error that says so, and nothing in the outputs, which can be saved: ParaView's writers want
/// arrays of a grid without cells, too.
void CheckShort(
  const std::string& name, const std::vector<std::string>& errors, const ShortTrim& trim)
{
  Expect(errors.size() < 2, name + ": " + std::to_string(errors.size()) + " errors");
  for (const std::string& error : errors)
  {
    Expect(error.find("needs more memory than there is") != std::string::npos, name + ": " + error);
  }
  for (int port = 0; port < 3 && !errors.empty(); ++port)
  {
    Expect(
      trim.Output(port)->GetNumberOfCells() == 0 && trim.Output(port)->GetNumberOfPoints() == 0,
      name + ": output " + std::to_string(port) + " is not empty");
    Expect(trim.Output(port)->GetPoints() && trim.Output(port)->GetCells() &&
        trim.Output(port)->GetCellTypesArray(),
      name + ": output " + std::to_string(port) + " has no arrays to be saved");
  }
}

/// The same filter with memory enough.
void CheckAfter(const std::string& name, const Whole& whole, ShortTrim& trim)
{
  Listener listener;
  trim.Run(NoRefusal);
  Expect(listener.Errors().empty(), name + ": an error with memory enough");
  for (int port = 0; port < 3; ++port)
  {
    Expect(AreSame(trim.Output(port), whole.Output[port]),
      name + ": another output " + std::to_string(port) + " afterwards");
  }
}

/// @return whether memory was missed.
bool RunShort(const Case& trial, const Whole& whole, const Shortage::Refusal& refusal)
{
  const std::string name =
    trial.Name + ", allocation " + std::to_string(refusal.First) + (refusal.Lasts ? " and on" : "");
  ShortTrim trim(trial);
  std::vector<std::string> errors;
  {
    Listener listener;
    trim.Run(refusal);
    errors = listener.Errors();
  }
  CheckShort(name, errors, trim);
  CheckAfter(name, whole, trim);
  return !errors.empty();
}

void TestRefusals(const Case& trial)
{
  const Whole whole = RunWhole(trial);
  constexpr int places = 20;
  int missed = 0;
  for (int i = 0; i < places; ++i)
  {
    const long number = whole.Allocations * i / places;
    missed += RunShort(trial, whole, { number, false, Few });
    missed += RunShort(trial, whole, { number, true, Few });
  }
  Expect(missed > places, trial.Name + ": only " + std::to_string(missed) + " trims missed memory");
}

/// No more address space than there is in use, and so much.
class Limit
{
public:
  explicit Limit(std::size_t more)
  {
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    getrlimit(RLIMIT_AS, &this->Before);
    rlimit limit = this->Before;
    limit.rlim_cur = pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) + more;
    setrlimit(RLIMIT_AS, &limit);
  }
  ~Limit() { setrlimit(RLIMIT_AS, &this->Before); }
  Limit(const Limit&) = delete;
  void operator=(const Limit&) = delete;

private:
  rlimit Before;
};

/// The same for all memory of the process, the pages of long arrays among it.
void TestLimits(const Case& trial)
{
  const Whole whole = RunWhole(trial);
  int missed = 0;
  constexpr int places = 40;
  for (int i = 0; i < places; ++i)
  {
    const std::string name = trial.Name + ", limit " + std::to_string(i);
    ShortTrim trim(trial);
    std::vector<std::string> errors;
    {
      Listener listener;
      const Limit limit(static_cast<std::size_t>(i) << 22);
      trim.Run(NoRefusal);
      errors = listener.Errors();
    }
    missed += !errors.empty();
    CheckShort(name, errors, trim);
    CheckAfter(name, whole, trim);
  }
  Expect(
    missed > 5 && missed < places, trial.Name + ": " + std::to_string(missed) + " limits missed");
}
}

int main(int argc, char* argv[])
{
  const bool limits = argc > 1 && std::string(argv[1]) == "limits";
  TrimOptions offcut, layer;
  offcut.ProduceOffcut = true;
  offcut.MapValues = true;
  layer.InsertLayer = true;
  const Mesh sheet = MakeMesh("sheet2"), block = MakeMesh("block");
  const Surface roundrect = MakeSurface("roundrect", sheet.Box, Placement());
  Placement aslant;
  aslant.Lean = 0.6;
  aslant.Angle = 1.1;
  const Surface plane = MakeSurface("plane", block.Box, aslant);
  const Mesh large = Sheet(250, 200, 2, Vec3(1, 1, 0.4));
  const Surface wavy = MakeSurface("wavy", large.Box, Placement());
  for (const int threads : { 1, 3 })
  {
    vtkSMPTools::Initialize(threads);
    const std::string with = ", threads: " + std::to_string(threads);
    if (limits)
    {
      TestLimits({ "large sheet" + with, large, wavy, offcut });
    }
    else
    {
      TestRefusals({ "sheet with its offcut" + with, sheet, roundrect, offcut });
      TestRefusals({ "block with a layer" + with, block, plane, layer });
    }
  }
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
