#include "FreshArray.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <new>
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

#ifdef __linux__
namespace
{

/// The kernel's memory that is in use, with its sizes.
struct Mapped
{
  std::mutex Lock;
  std::unordered_map<void*, std::size_t> Sizes;

  /// Never destroyed: arrays may outlive what is static.
  static Mapped& Get()
  {
    static auto* const mapped = new Mapped;
    return *mapped;
  }
};

/// VTK keeps this function for the memory that it allocates itself when such an array was emptied.
void FreeMapped(void* memory)
{
  auto& mapped = Mapped::Get();
  std::size_t size = 0;
  {
    const std::lock_guard<std::mutex> locked(mapped.Lock);
    const auto found = mapped.Sizes.find(memory);
    if (found != mapped.Sizes.end())
    {
      size = found->second;
      mapped.Sizes.erase(found);
    }
  }
  if (size > 0)
  {
    munmap(memory, size);
  }
  else
  {
    std::free(memory);
  }
}

}
#endif

Zeros AllocateZeros(std::size_t bytes)
{
#ifdef __linux__
  // Not from calloc: memory that was in use before it has to fill with zeros. Only large pieces, as
  // the kernel does not keep many.
  constexpr std::size_t large = std::size_t(1) << 18;
  if (bytes >= large)
  {
    void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory != MAP_FAILED)
    {
      auto& mapped = Mapped::Get();
      const std::lock_guard<std::mutex> locked(mapped.Lock);
      mapped.Sizes.emplace(memory, bytes);
      return { memory, &FreeMapped };
    }
  }
#endif
  void* memory = std::calloc(std::max<std::size_t>(bytes, 1), 1);
  if (!memory)
  {
    throw std::bad_alloc();
  }
  return { memory, &std::free };
}

}
