/**
 * @file Team.h
 * @brief Threads that stay for a whole trim, and the loops that they share with the caller.
 *
 * VTK's backend STDThread starts new threads for each loop, while the one that asks for it sleeps:
 * a trim of a million elements has 80 loops, half of which take less time than that. Other backends
 * keep their threads, and loops are theirs.
 */
#ifndef Team_h
#define Team_h

#include "Types.h"

#include <vtkSMPTools.h>

#include <functional>
#include <memory>
#include <thread>
#include <utility>

namespace trim
{

class Team
{
public:
  /// The calling thread with others, as many as the system gives of those asked for, for as long as
  /// the object is there; several threads may have a team each. With less than two threads there is
  /// none.
  explicit Team(int threads);
  ~Team();
  Team(const Team&) = delete;
  void operator=(const Team&) = delete;

  /// As many as VTK's backend has threads, where that would start them for each loop; not within
  /// such a loop.
  static int SizeForBackend();

  /// That of the calling thread, or whose loop it is in; null: it has none.
  static Team* Current();

  /// Called by the thread whose team it is, at each of its loops, between pieces of one, and now
  /// and then while it waits for the others; must not throw. An empty one ends that.
  void SetLook(std::function<void()> look) { this->Look = std::move(look); }

  using Action = std::function<void(Id, Id)>;
  /// As vtkSMPTools::For, but for exceptions: the first one in any thread ends the loop and comes
  /// to the caller. A loop within a loop is run by the thread that asks for it.
  void For(Id first, Id last, Id grain, const Action& action);

private:
  friend int ThreadsForLoops();
  struct Loop;
  class Member;
  class Others;
  std::unique_ptr<Others> Pool;
  std::function<void()> Look;
  std::thread::id Caller = std::this_thread::get_id();
  int Size;
};

/// How many threads share a loop that is asked for here.
int ThreadsForLoops();

/// Calls action(begin, end) for pieces of the range, `grain` long, by all threads; 0: VTK decides.
template <typename Action>
void ParallelFor(Id first, Id last, Id grain, const Action& action)
{
  if (Team* const team = Team::Current())
  {
    team->For(first, last, grain, std::cref(action));
    return;
  }
  vtkSMPTools::For(first, last, grain, action);
}

}

#endif
