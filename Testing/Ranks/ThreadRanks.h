/**
 * @file ThreadRanks.h
 * @brief Ranks as threads of one process: VTK's collective operations without MPI.
 */
#ifndef ThreadRanks_h
#define ThreadRanks_h

#include <vtkMultiProcessController.h>
#include <vtkSmartPointer.h>

#include <functional>
#include <vector>

namespace judge
{
/// Controllers that send to each other through memory, one a rank.
std::vector<vtkSmartPointer<vtkMultiProcessController>> MakeThreadRanks(int count);

/// Runs work(rank) for every rank at once, and waits for all; rank 0 is the calling thread.
void RunRanks(int count, const std::function<void(int)>& work);
}

#endif
