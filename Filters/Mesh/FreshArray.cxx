#include "FreshArray.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <unordered_map>

namespace trim
{

void PreferLargePages(void* memory, std::size_t bytes)
{
#if defined(__linux__) && defined(MADV_HUGEPAGE)
  constexpr std::uintptr_t page = std::uintptr_t(1) << 21;
  const auto first = (reinterpret_cast<std::uintptr_t>(memory) + page - 1) / page * page;
  const auto end = (reinterpret_cast<std::uintptr_t>(memory) + bytes) / page * page;
  if (end > first)
  {
    madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
  }
#else
  (void)memory;
  (void)bytes;
#endif
}

namespace
{

/// Memory of arrays that std::free cannot free, with its sizes.
struct InUse
{
  std::mutex Lock;
  std::unordered_map<void*, std::size_t> Sizes;

  /// Never destroyed: arrays may outlive what is static.
  static InUse& Get()
  {
    static auto* const inUse = new InUse;
    return *inUse;
  }
};

/// VTK keeps this function for the memory that it allocates itself when such an array was emptied.
void FreeOfArray(void* memory)
{
  auto& inUse = InUse::Get();
  std::size_t size = 0;
  {
    const std::lock_guard<std::mutex> locked(inUse.Lock);
    const auto found = inUse.Sizes.find(memory);
    if (found != inUse.Sizes.end())
    {
      size = found->second;
      inUse.Sizes.erase(found);
    }
  }
  if (size > 0)
  {
    nurbs::FreeZeros(memory, size);
  }
  else
  {
    std::free(memory);
  }
}

}

Zeros AllocateZerosForArray(std::size_t bytes, nurbs::PageSize pages)
{
  void* const memory = nurbs::AllocateZeros(bytes, pages);
  if (!nurbs::IsMapped(bytes))
  {
    return { memory, &std::free };
  }
  auto& inUse = InUse::Get();
  const std::lock_guard<std::mutex> locked(inUse.Lock);
  inUse.Sizes.emplace(memory, bytes);
  return { memory, &FreeOfArray };
}

}
