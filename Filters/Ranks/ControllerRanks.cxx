#include "ControllerRanks.h"

#include <vtkMultiProcessController.h>
#include <vtkType.h>

#include <limits>

namespace trim
{

ControllerRanks::ControllerRanks(vtkMultiProcessController* controller)
  : Controller(controller)
{
}

int ControllerRanks::Count() const
{
  return this->Controller ? this->Controller->GetNumberOfProcesses() : 1;
}

int ControllerRanks::Rank() const
{
  return this->Controller ? this->Controller->GetLocalProcessId() : 0;
}

std::vector<char> ControllerRanks::GatherBytes(
  const std::vector<char>& mine, std::vector<std::size_t>& ends) const
{
  if (this->Alone())
  {
    return this->Ranks::GatherBytes(mine, ends);
  }
  const int count = this->Count();
  const vtkIdType size = static_cast<vtkIdType>(mine.size());
  std::vector<vtkIdType> sizes(count);
  this->Controller->AllGather(&size, sizes.data(), 1);
  std::vector<vtkIdType> offsets(count, 0);
  ends.resize(count);
  vtkIdType total = 0;
  for (int i = 0; i < count; ++i)
  {
    offsets[i] = total;
    total += sizes[i];
    ends[i] = static_cast<std::size_t>(total);
  }
  // VTK hands MPI its numbers as ints, and else leaves what it is to fill as it is.
  if (total > std::numeric_limits<int>::max())
  {
    throw TooMuchToGather("more than 2 GiB in one message");
  }
  std::vector<char> all(static_cast<std::size_t>(total));
  if (total > 0)
  {
    this->Controller->AllGatherV(mine.data(), all.data(), size, sizes.data(), offsets.data());
  }
  return all;
}

}
