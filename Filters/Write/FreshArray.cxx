#include "FreshArray.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

#include <cstdint>
#include <cstdlib>
#include <new>

namespace trim
{
namespace
{

/// Before the zeros: the size of it all. As long as any value may have to be aligned to.
constexpr std::size_t Header = 64;

}

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

void* AllocateZeros(std::size_t bytes)
{
  // Not from calloc: memory that was in use before it has to fill with zeros.
  const std::size_t size = bytes + Header;
#ifdef __linux__
  void* memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  memory = memory == MAP_FAILED ? nullptr : memory;
#else
  void* memory = std::calloc(size, 1);
#endif
  if (!memory)
  {
    throw std::bad_alloc();
  }
  *static_cast<std::size_t*>(memory) = size;
  return static_cast<char*>(memory) + Header;
}

void FreeZeros(void* zeros)
{
  void* memory = static_cast<char*>(zeros) - Header;
#ifdef __linux__
  munmap(memory, *static_cast<std::size_t*>(memory));
#else
  std::free(memory);
#endif
}

}
