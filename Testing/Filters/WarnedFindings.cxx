#include "WarnedFindings.h"

#include "Expect.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkPointData.h>

#include <algorithm>
#include <cstdlib>

namespace judge
{
namespace
{

// A phrase of each warning, by value.
const char* const FeasibilityPhrases[] = { "", "bends with a radius", "less than 45 degrees",
  "narrower than three", "crosses more than once", "not opened", "without common nodes" };

// Port 0 says of each cell and point what port 1 says of it.
void ExpectSameOnBothPorts(const std::string& name, const Outcome& outcome)
{
  vtkUnstructuredGrid* grids[2] = { outcome.Case.Trimmed, outcome.Case.Whole };
  const auto compare =
    [&](vtkDataSetAttributes* kept, vtkDataSetAttributes* whole, const char* ids, const char* array)
  {
    vtkDataArray* a = kept->GetArray(array);
    vtkDataArray* b = whole->GetArray(array);
    vtkDataArray* id = kept->GetArray(ids);
    Expect(a && b && id, name + ": no " + array);
    for (vtkIdType i = 0; a && b && id && i < a->GetNumberOfTuples(); ++i)
    {
      if (a->GetComponent(i, 0) !=
        b->GetComponent(static_cast<vtkIdType>(id->GetComponent(i, 0)), 0))
      {
        Expect(false, name + ": " + array + " differs between the ports");
        return;
      }
    }
  };
  compare(grids[0]->GetCellData(), grids[1]->GetCellData(), "vtkOriginalCellIds", "Feasibility");
  compare(grids[0]->GetCellData(), grids[1]->GetCellData(), "vtkOriginalCellIds", "Shortfall");
  for (const char* array : { "DistanceLeft", "CornerLost" })
  {
    compare(grids[0]->GetPointData(), grids[1]->GetPointData(), "vtkOriginalPointIds", array);
  }
}

}

std::map<int, int> CountValues(vtkDataArray* array)
{
  std::map<int, int> counts;
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
  {
    ++counts[static_cast<int>(array->GetComponent(i, 0))];
  }
  counts.erase(0);
  return counts;
}

std::map<int, int> ExpectWarned(const std::string& name, const Outcome& outcome)
{
  Expect(outcome.Clean(), name + ": an error");
  ExpectSameOnBothPorts(name, outcome);
  vtkCellData* cells = outcome.Case.Whole->GetCellData();
  auto feasibility = CountValues(cells->GetArray("Feasibility"));
  auto shortfall = CountValues(cells->GetArray("Shortfall"));
  for (int value = 1; value <= 6; ++value)
  {
    const int warned = CountWarned(outcome, FeasibilityPhrases[value]);
    Expect(warned == feasibility[value],
      name + ": Feasibility " + std::to_string(value) + " in " +
        std::to_string(feasibility[value]) + " elements, warned of " + std::to_string(warned));
  }
  for (const int value : { 1, 3, 4, 5, 6 })
  {
    Expect(CountWarned(outcome, ShortfallPhrases[value]) ==
        shortfall[value] + CountBesideGraver(outcome, ShortfallPhrases[value]),
      name + ": Shortfall " + std::to_string(value));
  }
  int left = 0, leftOfBoundary = 0;
  vtkPointData* points = outcome.Case.Whole->GetPointData();
  for (vtkIdType i = 0; i < outcome.Case.Whole->GetNumberOfPoints(); ++i)
  {
    const bool isLeft = points->GetArray("DistanceLeft")->GetComponent(i, 0) > 0;
    left += isLeft;
    leftOfBoundary += isLeft && points->GetArray("NewBoundary")->GetComponent(i, 0) > 0;
  }
  Expect(CountWarned(outcome, LeftPhrase) == left, name + ": nodes left");
  const int told = leftOfBoundary == left
    ? CountWarned(
        outcome, left == 1 ? "node of the new boundary was" : "nodes of the new boundary were")
    : NumberAfter(std::to_string(left) + (left == 1 ? " node, " : " nodes, "), outcome);
  Expect(told == leftOfBoundary, name + ": nodes of the new boundary left");
  // Any other value comes before it.
  Expect(left > 0 || shortfall[2] == 0, name + ": elements with nodes left");
  auto corners = CountValues(outcome.Case.Whole->GetPointData()->GetArray("CornerLost"));
  Expect(CountWarned(outcome, CornerPhrase) == corners[1], name + ": corners lost");
  for (int value = 1; value <= 6; ++value)
  {
    if (feasibility[value] == 0)
    {
      feasibility.erase(value);
    }
  }
  return feasibility;
}

void ExpectNothing(
  const std::string& name, const Mesh& mesh, const Surface& surface, TrimOptions options)
{
  for (const bool invert : { false, true })
  {
    options.InvertSide = invert;
    const Outcome outcome = RunTrim(mesh, surface, options);
    Expect(ExpectWarned(name, outcome).empty(), name + ": something is found");
    Expect(outcome.Warnings.empty(),
      name + ": " + (outcome.Warnings.empty() ? "" : outcome.Warnings.front()));
  }
}

int CountBesideGraver(const Outcome& outcome, const std::string& phrase)
{
  const std::string words = "what is graver for ";
  for (const std::string& warning : outcome.Warnings)
  {
    const std::size_t start = warning.find(words);
    if (start != std::string::npos && warning.find(phrase) != std::string::npos)
    {
      return std::atoi(&warning[start + words.size()]);
    }
  }
  return 0;
}

int NumberAfter(const std::string& words, const Outcome& outcome)
{
  for (const std::string& warning : outcome.Warnings)
  {
    const std::size_t start = warning.find(words);
    if (start != std::string::npos)
    {
      return std::atoi(&warning[start + words.size()]);
    }
  }
  return 0;
}

double MeasureMissing(const Mesh& mesh, const Outcome& outcome)
{
  const Model model(mesh.Grid);
  vtkDataArray* const status = outcome.Case.Whole->GetCellData()->GetArray("ElementStatus");
  double cut = 0;
  int count = 0;
  for (Id c = 0; c < static_cast<Id>(model.Elements.size()); ++c)
  {
    if (status->GetComponent(c, 0) == 2)
    {
      cut += VolumeOf(model.Corners(c), model.Elements[c].Size);
      ++count;
    }
  }
  const double missing =
    VolumeOf(model) - VolumeOf(Model(outcome.Case.Trimmed)) - VolumeOf(Model(outcome.Offcut));
  return count > 0 ? missing / cut * count : 0;
}

double ToldMissing(const Outcome& outcome)
{
  for (const std::string& warning : outcome.Warnings)
  {
    const std::string phrase = "both have the volume of ";
    const auto at = warning.find(phrase);
    if (at != std::string::npos)
    {
      const std::string text = warning.substr(at + phrase.size());
      return std::atof(text.c_str()) * (text.find("more") < text.find("less") ? -1 : 1);
    }
  }
  return 0;
}

bool IsTold(const Outcome& outcome, const std::string& words)
{
  return std::any_of(outcome.Warnings.begin(), outcome.Warnings.end(),
    [&words](const std::string& warning) { return warning.find(words) != std::string::npos; });
}

void ExpectOnly(const std::string& name, const Mesh& mesh, const Surface& surface, int value,
  int atLeast, const TrimOptions& options)
{
  const Outcome outcome = RunTrim(mesh, surface, options);
  auto found = ExpectWarned(name, outcome);
  Expect(!IsTold(outcome, "misses the grid"), name + ": the surface is said to miss the grid");
  Expect(found[value] >= atLeast,
    name + ": in " + std::to_string(found[value]) + " elements, not " + std::to_string(atLeast));
  found.erase(value);
  for (const auto& other : found)
  {
    Expect(false, name + ": another value, too: " + std::to_string(other.first));
  }
}

}
