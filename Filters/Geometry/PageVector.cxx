#include "PageVector.h"

#include "PagePool.h"

#ifdef __linux__
#include <sys/mman.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>

namespace nurbs
{
namespace
{

constexpr std::size_t LargePage = std::size_t(1) << 21;
/// Small pages that take the kernel as long to hand over as a large one; measured.
constexpr std::size_t SmallForLarge = 120;

}

PageSize PagesForPlaces(std::size_t bytes, std::size_t places)
{
  return places / SmallForLarge > bytes / LargePage ? PageSize::Large : PageSize::Small;
}

#ifdef __linux__
namespace
{

void* Map(std::size_t bytes)
{
  void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return memory == MAP_FAILED ? nullptr : memory;
}

/// At a limit of large pages; what is whole of them is to be in such.
void* MapLarge(std::size_t size)
{
  auto* const memory = static_cast<char*>(Map(size + LargePage));
  if (!memory)
  {
    return nullptr;
  }
  const std::size_t before =
    (LargePage - reinterpret_cast<std::uintptr_t>(memory) % LargePage) % LargePage;
  if (before > 0)
  {
    munmap(memory, before);
  }
  munmap(memory + before + size, LargePage - before);
#ifdef MADV_HUGEPAGE
  madvise(memory + before, size / LargePage * LargePage, MADV_HUGEPAGE);
#endif
  return memory + before;
}

}
#endif

/// With the last large page if small ones would take longer.
std::size_t SizeOfMapping(std::size_t bytes)
{
  static const auto smallPage = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  const std::size_t rest = bytes % LargePage;
  return bytes - rest +
    (rest >= SmallForLarge * smallPage ? LargePage
                                       : (rest + smallPage - 1) / smallPage * smallPage);
}

bool IsMapped(std::size_t bytes)
{
#ifdef __linux__
  // What calloc takes from memory that was in use before it has to fill with zeros. Only large
  // pieces, as the kernel does not keep many.
  return bytes >= std::size_t(1) << 18;
#else
  (void)bytes;
  return false;
#endif
}

void* AllocateZeros(std::size_t bytes, PageSize pages)
{
  void* memory = nullptr;
#ifdef __linux__
  if (IsMapped(bytes))
  {
    const std::size_t size = SizeOfMapping(bytes);
    const auto map = [&]
    { return pages == PageSize::Large && size >= LargePage ? MapLarge(size) : Map(size); };
    memory = map();
    if (!memory)
    {
      PagePool::Get().Empty();
      memory = map();
    }
  }
#else
  (void)pages;
#endif
  if (!IsMapped(bytes))
  {
    const std::size_t size =
      (std::max<std::size_t>(bytes, 1) + CacheLine - 1) / CacheLine * CacheLine;
    memory = std::aligned_alloc(CacheLine, size);
    if (memory)
    {
      std::memset(memory, 0, size);
    }
  }
  if (!memory)
  {
    throw std::bad_alloc();
  }
  return memory;
}

void FreeZeros(void* memory, std::size_t bytes)
{
#ifdef __linux__
  if (IsMapped(bytes))
  {
    munmap(memory, SizeOfMapping(bytes));
    return;
  }
#else
  (void)bytes;
#endif
  std::free(memory);
}

}
