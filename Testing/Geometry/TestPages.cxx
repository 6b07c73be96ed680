/**
 * @file TestPages.cxx
 * @brief Memory of long arrays: zero where that is asked for, also where an earlier run had it, and
 * kept no longer than somebody has a use for it.
 */
#include "Check.h"

#include "PagePool.h"
#include "PageVector.h"

#include <algorithm>
#include <cstring>
#include <thread>
#include <vector>

using namespace nurbs;

namespace
{
constexpr std::size_t Large = std::size_t(20) << 20;

bool IsZero(const void* memory, std::size_t bytes)
{
  const auto* const first = static_cast<const char*>(memory);
  return std::all_of(first, first + bytes, [](char byte) { return byte == 0; });
}

/// What was written to and freed.
void* Used(std::size_t bytes)
{
  void* const memory = TakePages(bytes);
  std::memset(memory, 7, bytes);
  GivePages(memory, bytes);
  return memory;
}

void TestReuse()
{
  const PageUser user;
  void* const before = Used(Large);
  void* const again = TakeZeroPages(Large);
  check::That(again == before, "what was freed is not used again");
  check::That(IsZero(again, Large), "what is used again is not zero");
  // What is nearly as large becomes it; the rest of a larger one is given back.
  GivePages(again, Large);
  const std::size_t less = Large - (std::size_t(3) << 20);
  void* const smaller = TakeZeroPages(less);
  check::That(smaller == before && IsZero(smaller, less), "a little less");
  GivePages(smaller, less);
  void* const larger = TakeZeroPages(Large);
  check::That(IsZero(larger, Large), "a little more");
  GivePages(larger, Large);
  void* const other = TakeZeroPages(4 * Large);
  check::That(other != larger && IsZero(other, 4 * Large), "four times as much");
  GivePages(other, 4 * Large);
}

void TestSparse()
{
  const PageUser user;
  void* const before = Used(Large);
  void* const sparse = AllocateZeros(Large, PageSize::Small);
  check::That(sparse != before, "what is written to here and there takes pages in use");
  FreeZeros(sparse, Large);
  void* const next = TakeZeroPages(Large);
  check::That(next == before, "it is kept for what is written to throughout");
  GivePages(next, Large);
}

/// Whether memory that was freed is still there for the next.
bool IsKept(void* memory, std::size_t bytes)
{
  void* const kept = PagePool::Get().Take(bytes);
  check::That(!kept || kept == memory, "something else is kept");
  return kept && PagePool::Get().Keep(kept, bytes);
}

void TestEnd()
{
  constexpr std::size_t size = std::size_t(6) << 20; // of whole large pages
  check::That(!IsKept(Used(size), size), "kept for nobody");
  {
    const PageUser user;
    void* const memory = Used(size);
    check::That(IsKept(memory, size), "not kept");
    PagePool::Get().Empty();
    check::That(!IsKept(memory, size), "kept though emptied");
    Used(size);
  }
  {
    const PageUser user;
    check::That(!IsKept(nullptr, size), "kept for the next user");
    void* const memory = Used(size);
    user.EndRun();
    user.EndRun();
    void* const used = PagePool::Get().Take(size);
    check::That(used == memory, "not kept for the next run but one");
    check::That(PagePool::Get().Keep(used, size), "not kept once more");
    for (int run = 0; run < 3; ++run)
    {
      user.EndRun();
    }
    check::That(!PagePool::Get().Take(size), "kept for good");
  }
}

void TestThreads()
{
  const PageUser user;
  std::vector<std::thread> threads;
  std::vector<char> good(4, 1);
  for (std::size_t t = 0; t < good.size(); ++t)
  {
    threads.emplace_back(
      [t, &good]
      {
        for (int i = 0; i < 50; ++i)
        {
          const std::size_t bytes = (std::size_t(1) << 20) + 100000 * ((t + i) % 7);
          void* const memory = TakeZeroPages(bytes);
          good[t] &= IsZero(memory, bytes);
          std::memset(memory, static_cast<int>(t + 1), bytes);
          const auto* const first = static_cast<const char*>(memory);
          good[t] &= std::all_of(
            first, first + bytes, [t](char byte) { return byte == static_cast<char>(t + 1); });
          GivePages(memory, bytes);
        }
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  check::That(std::count(good.begin(), good.end(), 1) == 4, "threads share memory");
}
}

int main()
{
  TestReuse();
  TestSparse();
  TestEnd();
  TestThreads();
  return check::Result();
}
