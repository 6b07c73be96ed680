/**
 * @file ControllerRanks.h
 * @brief The ranks of a vtkMultiProcessController.
 */
#ifndef ControllerRanks_h
#define ControllerRanks_h

#include "Ranks.h"

class vtkMultiProcessController;

namespace trim
{

class ControllerRanks : public Ranks
{
public:
  /// @param controller null: one rank alone. It must outlive this object.
  explicit ControllerRanks(vtkMultiProcessController* controller);

  int Count() const override;
  int Rank() const override;

protected:
  std::vector<char> GatherBytes(
    const std::vector<char>& mine, std::vector<std::size_t>& ends) const override;

private:
  vtkMultiProcessController* Controller;
};

}

#endif
