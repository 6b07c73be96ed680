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
void* Used(std::size_t bytes, PageUse use = PageUse::Output)
{
  void* const memory = TakePages(bytes);
  std::memset(memory, 7, bytes);
  GivePages(memory, bytes, use);
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
  GivePages(again, Large, PageUse::Output);
  const std::size_t less = Large - (std::size_t(3) << 20);
  void* const smaller = TakeZeroPages(less);
  check::That(smaller == before && IsZero(smaller, less), "a little less");
  GivePages(smaller, less, PageUse::Output);
  void* const larger = TakeZeroPages(Large);
  check::That(IsZero(larger, Large), "a little more");
  GivePages(larger, Large, PageUse::Output);
  void* const other = TakeZeroPages(4 * Large);
  check::That(other != larger && IsZero(other, 4 * Large), "four times as much");
  GivePages(other, 4 * Large, PageUse::Output);
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
  GivePages(next, Large, PageUse::Output);
}

void TestVectors()
{
  const PageUser user;
  void* before;
  {
    PageVector<char> vector(Large);
    before = vector.data();
    std::fill(vector.begin(), vector.end(), char(7));
  }
  const PageVector<char> next(Large);
  check::That(next.data() == before, "what a vector had is not used again");
  check::That(IsZero(next.data(), Large), "what a vector has from another one is not zero");
  constexpr std::size_t much = std::size_t(130) << 20; // of whole large pages
  PageVector<char>{}.resize(much);
  check::That(!PagePool::Get().Take(much), "a vector is kept that is more than may be");
}

/// Whether memory that was freed is still there for the next.
bool IsKept(void* memory, std::size_t bytes)
{
  void* const kept = PagePool::Get().Take(bytes);
  check::That(!kept || kept == memory, "something else is kept");
  return kept && PagePool::Get().Keep(kept, bytes, PageUse::Output);
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
    check::That(PagePool::Get().Keep(used, size, PageUse::Output), "not kept once more");
    for (int run = 0; run < 3; ++run)
    {
      user.EndRun();
    }
    check::That(!PagePool::Get().Take(size), "kept for good");
  }
}

/// Of memory at work no more is kept than a sheet of some million elements takes.
void TestMostOfWork()
{
  constexpr std::size_t size = std::size_t(60) << 20;
  const PageUser user;
  const std::vector<std::size_t> sizes{ size, 2 * size, size / 2, size / 4 };
  std::vector<void*> work;
  void* const output = Used(4 * size);
  for (const std::size_t each : sizes)
  {
    work.push_back(Used(each, PageUse::Work));
  }
  check::That(IsKept(output, 4 * size), "an output is not kept beside much work");
  check::That(IsKept(work[3], sizes[3]), "the last one at work is not kept");
  check::That(IsKept(work[2], sizes[2]), "the last but one at work is not kept");
  check::That(!IsKept(work[1], sizes[1]), "more of work is kept than may be");
  check::That(!IsKept(work[0], sizes[0]), "what was at work first is kept");
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
          GivePages(memory, bytes, PageUse::Output);
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
  TestVectors();
  TestMostOfWork();
  TestEnd();
  TestThreads();
  return check::Result();
}
