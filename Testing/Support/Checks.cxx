#include "Checks.h"

namespace judge
{

void JudgeAll(const Evidence& evidence, Report& report)
{
  CheckArrays(evidence.Case, report);
  if (!evidence.Usable)
  {
    return;
  }
  CheckStatuses(evidence, report);
  CheckRescues(evidence, report);
  CheckFractions(evidence, report);
  CheckMoves(evidence, report);
  CheckBoundary(evidence, report);
  CheckElements(evidence, report);
  CheckFloor(evidence, report);
  CheckShortfalls(evidence, report);
  CheckNewBoundary(evidence, report);
  CheckCarriedArrays(evidence, report);
  CheckSummary(evidence, report);
  CheckNumbering(evidence, report);
}

}
