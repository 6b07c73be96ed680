/**
 * @file FirstRank.h
 * @brief Which of several ranks tells of what all of them find alike.
 */
#ifndef FirstRank_h
#define FirstRank_h

#include "vtkMultiProcessController.h"

namespace nurbs
{

/// @param controller null: one rank alone.
inline bool IsFirstRank(vtkMultiProcessController* controller)
{
  return !controller || controller->GetLocalProcessId() == 0;
}

}

#endif
