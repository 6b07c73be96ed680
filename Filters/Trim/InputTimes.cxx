#include "InputTimes.h"

#include "SortUnique.h"

#include <vtkDataObject.h>
#include <vtkInformation.h>
#include <vtkInformationDoubleKey.h>
#include <vtkInformationVector.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace trim
{

void TellTimes(vtkInformation* grid, vtkInformation* surface, vtkInformationVector* outputs)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  std::vector<double> steps;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::array<double, 2> range{ infinity, -infinity };
  for (vtkInformation* input : { grid, surface })
  {
    if (input && input->Has(Pipeline::TIME_STEPS()))
    {
      const double* own = input->Get(Pipeline::TIME_STEPS());
      steps.insert(steps.end(), own, own + input->Length(Pipeline::TIME_STEPS()));
    }
    if (input && input->Has(Pipeline::TIME_RANGE()))
    {
      const double* own = input->Get(Pipeline::TIME_RANGE());
      range = { std::min(range[0], own[0]), std::max(range[1], own[1]) };
    }
  }
  SortUnique(steps);
  for (int port = 0; port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    vtkInformation* output = outputs->GetInformationObject(port);
    if (!steps.empty())
    {
      output->Set(Pipeline::TIME_STEPS(), steps.data(), static_cast<int>(steps.size()));
    }
    if (range[0] <= range[1])
    {
      output->Set(Pipeline::TIME_RANGE(), range.data(), 2);
    }
  }
}

void TellTime(vtkDataObject* grid, vtkDataObject* surface, vtkDataObject* output)
{
  const auto key = vtkDataObject::DATA_TIME_STEP();
  constexpr double none = -std::numeric_limits<double>::infinity();
  double time = none;
  for (vtkDataObject* input : { grid, surface })
  {
    vtkInformation* own = input->GetInformation();
    time = own->Has(key) ? std::max(time, own->Get(key)) : time;
  }
  if (time != none)
  {
    output->GetInformation()->Set(key, time);
  }
}

}
