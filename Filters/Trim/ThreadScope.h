/**
 * @file ThreadScope.h
 * @brief Lets the filter use all cores where VTK would use one by default.
 *
 * Debian's VTK has threads compiled in, but its default backend is the sequential one.
 */
#ifndef ThreadScope_h
#define ThreadScope_h

#include "Team.h"

#include <vtkSMP.h>
#include <vtkSMPTools.h>

#include <cstdlib>
#include <string>
#include <utility>

namespace trim
{

/// The threaded backend of this build, empty if it has none.
inline std::string ThreadedBackend()
{
#if VTK_SMP_ENABLE_TBB
  return "TBB";
#elif VTK_SMP_ENABLE_STDTHREAD
  return "STDThread";
#elif VTK_SMP_ENABLE_OPENMP
  return "OpenMP";
#else
  return "";
#endif
}

/// Runs work() with a team, where the active backend would start threads for each loop.
template <typename Work>
void WithTeam(Work&& work)
{
  const Team team(Team::SizeForBackend());
  work();
}

/**
 * Runs work() with a threaded backend, which is active for this call only. It is left as it is
 * where somebody has chosen: the environment variable VTK_SMP_BACKEND_IN_USE is set, a backend
 * other than the sequential one is active, or vtkSMPTools::Initialize allows one thread.
 *
 * @param alone false if other ranks work at the same time: they share the cores already.
 */
template <typename Work>
void WithThreads(bool alone, Work&& work)
{
  const std::string backend = ThreadedBackend();
  const char* chosen = std::getenv("VTK_SMP_BACKEND_IN_USE");
  const int limit =
    vtk::detail::smp::vtkSMPToolsAPI::GetInstance().GetInternalDesiredNumberOfThread();
  const std::string active = vtkSMPTools::GetBackend();
  if (!alone || backend.empty() || (chosen && *chosen) || active != "Sequential" || limit == 1 ||
    vtkSMPTools::IsParallelScope())
  {
    WithTeam(std::forward<Work>(work));
    return;
  }
  vtkSMPTools::LocalScope(vtkSMPTools::Config(limit, backend, vtkSMPTools::GetNestedParallelism()),
    [&work]() { WithTeam(std::forward<Work>(work)); });
}

}

#endif
