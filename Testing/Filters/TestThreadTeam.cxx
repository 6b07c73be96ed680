/**
 * @file TestThreadTeam.cxx
 * @brief What the stages share work by: tasks in turn, threads that stay, what all threads
 * remember.
 */
#include "Band.h"
#include "Expect.h"
#include "PagePool.h"
#include "Remembered.h"
#include "RememberedLast.h"
#include "Team.h"
#include "Wavefront.h"

#include <vtkSMPTools.h>

#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <memory>
#include <mutex>
#include <new>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <thread>

using namespace judge;
using namespace trim;

namespace
{

// Each task adds up what those that it meets have, and would have something else in another order.
void CheckWavefront()
{
  constexpr int count = 2000;
  const Band::Lists met = BuildLists(count,
    [&](auto&& add)
    {
      std::mt19937 same(5);
      for (int task = 1; task < count; ++task)
      {
        for (int k = 0; k < 4; ++k)
        {
          add(task, std::max(0, task - 1 - static_cast<int>(same() % 60)));
        }
      }
    });
  const auto add = [&met](std::vector<double>& sums, int task)
  {
    sums[task] = 1.0 + 1e-3 * task;
    for (const int* other = met.begin(task); other != met.end(task); ++other)
    {
      sums[task] += 0.3 * sums[*other];
    }
  };
  std::vector<double> expected(count, 0.0);
  for (int task = 0; task < count; ++task)
  {
    add(expected, task);
  }
  const Wavefront wavefront(met);
  for (const char* backend : { "Sequential", "STDThread" })
  {
    vtkSMPTools::SetBackend(backend);
    for (const int threads : { 1, 2, 5 })
    {
      vtkSMPTools::Initialize(threads);
      std::vector<double> sums(count, 0.0);
      wavefront.Run([&](int task) { add(sums, task); });
      const std::string name = std::string(backend) + ", " + std::to_string(threads) + " threads";
      Expect(sums == expected, "tasks in turn: " + name);
      const Team team(Team::SizeForBackend());
      std::fill(sums.begin(), sums.end(), 0.0);
      wavefront.Run([&](int task) { add(sums, task); });
      Expect(sums == expected, "tasks in turn by a team: " + name);
    }
  }
  vtkSMPTools::SetBackend("Sequential");
}

/// So many runs that a thread was held up before matters no more.
void TakeTurnsAgain()
{
  const Wavefront one(BuildLists(1, [](auto&&) {}));
  for (int run = 0; run < 100; ++run)
  {
    one.Run([](int) {});
  }
}

/// Whether another thread than the caller's takes tasks that wait for no other, if it can.
bool TakesTwoThreads()
{
  const Wavefront apart(BuildLists(64, [](auto&&) {}));
  const auto caller = std::this_thread::get_id();
  std::atomic<bool> came{ false };
  std::atomic<int> waited{ 0 }; // milliseconds
  apart.Run(
    [&](int)
    {
      came = came || std::this_thread::get_id() != caller;
      while (!came && waited++ < 500)
      {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
    });
  return came;
}

// Where a thread was kept within a task for long, the next runs are the caller's alone.
void CheckHeldUp()
{
  vtkSMPTools::SetBackend("STDThread");
  vtkSMPTools::Initialize(2);
  {
    const Team team(Team::SizeForBackend());
    const Wavefront chain(BuildLists(64,
      [](auto&& add)
      {
        for (int task = 1; task < 64; ++task)
        {
          add(task, task - 1);
        }
      }));
    // On a busy machine the runs themselves may be held up.
    bool before = false, alone = false, after = false;
    for (int attempt = 0; attempt < 20 && !(before && alone && after); ++attempt)
    {
      TakeTurnsAgain();
      before = TakesTwoThreads();
      chain.Run(
        [](int task)
        {
          if (task == 3)
          {
            std::this_thread::sleep_for(std::chrono::milliseconds(200));
          }
        });
      alone = !TakesTwoThreads();
      TakeTurnsAgain();
      after = TakesTwoThreads();
    }
    Expect(before, "two threads take tasks in turn");
    Expect(alone, "one thread after one was held up");
    Expect(after, "two threads again, later");
  }
  vtkSMPTools::SetBackend("Sequential");
}

// A task that throws ends the others, also those that wait for what its thread had before it.
void CheckFailureInTurn()
{
  constexpr int count = 64;
  const Band::Lists met = BuildLists(count, [](auto&& add) { add(count - 1, 1); });
  const Wavefront wavefront(met);
  vtkSMPTools::SetBackend("STDThread");
  vtkSMPTools::Initialize(2);
  const Team team(2);
  TakeTurnsAgain();
  std::atomic<bool> waits{ false };
  bool caught = false;
  try
  {
    wavefront.Run(
      [&](int task)
      {
        waits = waits || task == count - 2;
        while (task == 0 && !waits)
        {
          std::this_thread::yield();
        }
        if (task == 0)
        {
          throw std::bad_alloc();
        }
      });
  }
  catch (const std::bad_alloc&)
  {
    caught = true;
  }
  Expect(caught, "tasks in turn: a failure is lost");
  vtkSMPTools::SetBackend("Sequential");
}

// Each item once, whatever the pieces, and the caller does not sleep.
void CheckLoopsOfTeam()
{
  const Team team(3);
  constexpr Id count = 1003;
  for (const Id grain : { 0, 1, 10, 1002, 1003, 5000 })
  {
    std::vector<std::atomic<int>> visits(count);
    ParallelFor(3, count, grain,
      [&](Id begin, Id end)
      { std::for_each(&visits[begin], &visits[0] + end, [](auto& n) { ++n; }); });
    bool once = true;
    for (Id i = 0; i < count; ++i)
    {
      once &= visits[i] == (i < 3 ? 0 : 1);
    }
    Expect(once, "team: an item is left out or comes twice, grain " + std::to_string(grain));
  }
  ParallelFor(5, 5, 1, [](Id, Id) { Expect(false, "team: an empty range is not"); });

  const auto caller = std::this_thread::get_id();
  std::mutex lock;
  std::set<std::thread::id> seen;
  bool apart = false;
  for (int loop = 0; loop < 50; ++loop)
  {
    ParallelFor(0, 300, 1,
      [&](Id, Id)
      {
        const auto own = std::this_thread::get_id();
        const std::lock_guard<std::mutex> locked(lock);
        seen.insert(own);
        ParallelFor(0, 300, 1, [&](Id, Id) { apart |= own != std::this_thread::get_id(); });
      });
  }
  Expect(seen.count(caller) == 1, "team: the caller has no part in its loops");
  Expect(seen.size() <= 3, "team: its threads do not stay");
  Expect(!apart, "team: a loop within a loop is given to other threads");
}

// The caller looks now and then, also within a piece of a loop and while it waits for the others.
void CheckLookOfTeam()
{
  const auto caller = std::this_thread::get_id();
  Team team(2);
  std::atomic<int> looks{ 0 };
  bool apart = false;
  team.SetLook(
    [&]
    {
      ++looks;
      apart |= caller != std::this_thread::get_id();
    });
  // The other thread ends when the caller has looked once more than it does for the loop itself.
  const auto waitFor = [](const std::atomic<int>& number, int count)
  {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (number < count && std::chrono::steady_clock::now() < end)
    {
      std::this_thread::yield();
    }
    return number >= count;
  };
  std::atomic<bool> waited{ true };
  std::atomic<int> inside{ 0 };
  ParallelFor(0, 2, 1,
    [&](Id, Id)
    {
      ++inside;
      waitFor(inside, 2);
      if (std::this_thread::get_id() == caller)
      {
        ParallelFor(0, 10, 1, [](Id, Id) {});
        return;
      }
      waited =
        waitFor(looks, 5); // the loop, its piece, the loop within it, and twice while it waits
    });
  Expect(waited, "team: the caller does not look while it waits");
  Expect(!apart, "team: another thread than the caller looks");
  team.SetLook({});
  const int before = looks;
  ParallelFor(0, 100, 1, [](Id, Id) {});
  Expect(looks == before, "team: the caller still looks");
}

// What one of the others throws comes to the caller; VTK's threads would end the process.
void CheckFailureInTeam()
{
  const auto caller = std::this_thread::get_id();
  const Team team(3);
  for (int loop = 0; loop < 20; ++loop)
  {
    std::atomic<bool> thrown{ false };
    bool caught = false;
    try
    {
      ParallelFor(0, 3, 1,
        [&](Id, Id)
        {
          if (std::this_thread::get_id() != caller)
          {
            thrown = true;
            throw std::bad_alloc();
          }
          const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
          while (!thrown && std::chrono::steady_clock::now() < end)
          {
            std::this_thread::yield();
          }
        });
    }
    catch (const std::bad_alloc&)
    {
      caught = true;
    }
    Expect(caught, "team: what one of its threads throws does not come to the caller");
  }
}

// Memory that was in use comes back as zeros, whoever fills them in.
void CheckZerosOfTeam()
{
  constexpr std::size_t count = (std::size_t(5) << 20) + 3;
  const nurbs::PageUser user;
  for (const int threads : { 1, 3 })
  {
    const Team team(threads);
    {
      UnsetVector<char> used(count);
      std::fill(used.begin(), used.end(), 1);
    }
    const PageVector<char> zeros(count);
    Expect(std::find_if(zeros.begin(), zeros.end(), [](char x) { return x != 0; }) == zeros.end(),
      "a long array from memory that was in use is not zero");
  }
}

// The system may have no threads left, here as none has a stack so large: the caller does the work.
void CheckTeamWithoutThreads()
{
  pthread_attr_t usual, huge;
  pthread_getattr_default_np(&usual);
  pthread_attr_init(&huge);
  pthread_attr_setstacksize(&huge, std::size_t{ 1 } << 47);
  pthread_setattr_default_np(&huge);
  try
  {
    const Team team(3);
    std::atomic<Id> sum{ 0 };
    ParallelFor(0, 100, 1, [&sum](Id begin, Id) { sum += begin; });
    Expect(sum == 4950, "team: without threads some of the work is not done");
  }
  catch (const std::exception& failure)
  {
    Expect(false, std::string("team: not made without threads: ") + failure.what());
  }
  pthread_setattr_default_np(&usual);
  pthread_attr_destroy(&huge);
  pthread_attr_destroy(&usual);
}

// Where VTK would start threads for each loop, and only there.
void CheckSizeOfTeam()
{
  vtkSMPTools::SetBackend("Sequential");
  Expect(Team::SizeForBackend() == 1 && !Team::Current(), "team: against the sequential backend");
  vtkSMPTools::SetBackend("STDThread");
  vtkSMPTools::Initialize(2);
  const int size = Team::SizeForBackend();
  Expect(size == vtkSMPTools::GetEstimatedNumberOfThreads(), "team: not VTK's number of threads");
  std::atomic<int> within{ 1 };
  vtkSMPTools::For(
    0, 2, 1, [&within](Id, Id) { within = std::max<int>(within, Team::SizeForBackend()); });
  Expect(within == 1, "team: within a loop of VTK's");
  {
    const Team team(2);
    Expect(Team::Current() == &team, "team: it is not that of its thread");
  }
  Expect(!Team::Current(), "team: it is still there");
  vtkSMPTools::SetBackend("Sequential");
}

// Each value is worked out once, and all that ask get the same.
void CheckRemembered()
{
  const int count = 1000;
  const Remembered<std::vector<int>> squares(count);
  std::vector<std::atomic<int>> found(count);
  std::vector<std::atomic<int>> wrong(count);
  for (int pass = 0; pass < 2; ++pass)
  {
    for (int i = 0; i < count; ++i)
    {
      const std::vector<int>& square = squares.At(i,
        [&]
        {
          ++found[i];
          return std::vector<int>{ i * i };
        });
      wrong[i] += square.front() != i * i;
    }
  }
  Expect(std::all_of(found.begin(), found.end(), [](const auto& n) { return n == 1; }),
    "what is remembered is worked out once");
  vtkSMPTools::SetBackend("STDThread");
  vtkSMPTools::Initialize(5);
  const Remembered<int> doubles(1);
  vtkSMPTools::For(0, count, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        wrong[i] += doubles.At(0, [] { return 2; }) != 2;
      }
    });
  vtkSMPTools::SetBackend("Sequential");
  Expect(std::all_of(wrong.begin(), wrong.end(), [](const auto& n) { return n == 0; }),
    "what is remembered is the same for all");
}

// Of the last key the value is known, of another one it is worked out; for all threads.
void CheckRememberedLast()
{
  const RememberedLast<int, int> products(3);
  int found = 0;
  const auto product = [&](int item, int key)
  {
    return products.At(item, key,
      [&]
      {
        ++found;
        return item * key;
      });
  };
  Expect(product(2, 5) == 10 && product(2, 5) == 10 && found == 1, "the last key is not known");
  Expect(product(1, 5) == 5 && found == 2, "the key of another item is taken");
  Expect(product(2, 7) == 14 && product(2, 5) == 10 && found == 4, "another key is taken");
  vtkSMPTools::SetBackend("STDThread");
  vtkSMPTools::Initialize(5);
  std::atomic<int> wrong{ 0 };
  vtkSMPTools::For(0, 1000, 1,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        const int key = static_cast<int>(i % 2);
        wrong += products.At(0, key, [key] { return 3 + key; }) != 3 + key;
      }
    });
  vtkSMPTools::SetBackend("Sequential");
  Expect(wrong == 0, "what is remembered of a key is that of another one");
}

}

int main()
{
  CheckWavefront();
  CheckHeldUp();
  CheckFailureInTurn();
  CheckLoopsOfTeam();
  CheckLookOfTeam();
  CheckFailureInTeam();
  CheckZerosOfTeam();
  CheckTeamWithoutThreads();
  CheckSizeOfTeam();
  CheckRemembered();
  CheckRememberedLast();
  std::printf("%d wrong\n", Wrong);
  return Wrong > 0;
}
