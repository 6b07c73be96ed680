/**
 * @file Wavefront.h
 * @brief Tasks that have to run as if one after the other, run by all threads.
 *
 * Level scheduling, as for sparse triangular systems (E. Anderson, Y. Saad, Solving Sparse
 * Triangular Linear Systems on Parallel Computers, 1989): a task waits for those before it that it
 * meets, and for no others, so that the outcome is that of the order itself.
 *
 * Where other programs want the processors too, a thread may have to give its own up within a task
 * for longer than all tasks take, and then the next one waits for it: one thread is the fastest.
 */
#ifndef Wavefront_h
#define Wavefront_h

#include "Band.h"
#include "Team.h"

#include <algorithm>
#include <atomic>
#include <vector>

namespace trim
{

class Wavefront
{
public:
  /// @param met by task: the tasks before it that touch what it touches.
  explicit Wavefront(Band::Lists met);

  /// Calls work(task) for all tasks, or until one throws: then none begins any more. The calling
  /// thread does so alone, if threads were held up lately.
  template <typename Work>
  void Run(const Work& work) const
  {
    if (TakesTurnAlone())
    {
      std::for_each(this->Order.begin(), this->Order.end(), work);
      return;
    }
    const int count = static_cast<int>(this->Order.size());
    std::vector<std::atomic<char>> done(count);
    std::atomic<int> next{ 0 };
    std::atomic<bool> failed{ false };
    // Whoever runs begins where the last one did: also if one thread has to do all of it. Nobody
    // waits for a task that nobody has begun, as those that it waits for come before it.
    ParallelFor(0, ThreadsForLoops(), 1,
      [&](Id, Id)
      {
        for (int begin; (begin = next.fetch_add(AtOnce)) < count;)
        {
          for (int i = begin; i < std::min(count, begin + AtOnce); ++i)
          {
            const int task = this->Order[i];
            if (!this->WaitForMet(task, done, failed))
            {
              return;
            }
            try
            {
              work(task);
            }
            catch (...)
            {
              failed.store(true); // what this thread had before it will never be done
              throw;
            }
            done[task].store(1, std::memory_order_release);
          }
        }
      });
  }

private:
  /// Tasks that a thread takes at once.
  static constexpr int AtOnce = 8;
  /// How often a thread asks for another's task before it yields: that may be for long.
  static constexpr int Patience = 100000;

  /// False if a task has thrown: those that wait for it would wait for ever.
  bool WaitForMet(
    int task, const std::vector<std::atomic<char>>& done, const std::atomic<bool>& failed) const
  {
    for (const int* other = this->Met.begin(task); other != this->Met.end(task); ++other)
    {
      if (!IsSoonDone(done[*other]))
      {
        Await(done[*other], failed);
      }
    }
    return !failed.load();
  }

  static bool IsSoonDone(const std::atomic<char>& done)
  {
    int asked = 0;
    while (!done.load(std::memory_order_acquire) && ++asked < Patience)
    {
    }
    return asked < Patience;
  }

  /// Waits for a task, or until one has failed, and learns whether other programs hold threads up.
  static void Await(const std::atomic<char>& done, const std::atomic<bool>& failed);

  /// Of all wavefronts: whether one of the runs after a thread was held up is due.
  static bool TakesTurnAlone();

  Band::Lists Met;
  std::vector<int> Order; ///< tasks that wait for nobody first, then those that wait for these
};

}

#endif
