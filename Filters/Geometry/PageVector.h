/**
 * @file PageVector.h
 * @brief Memory for long arrays, as those with a value for every node or cell: in large pages, as
 * far from the cut most of a trim's time is the kernel's, to hand over memory that was never
 * touched before.
 */
#ifndef PageVector_h
#define PageVector_h

#include "PagePool.h"

#include <cstddef>
#include <new>
#include <utility>
#include <vector>

namespace nurbs
{

enum class PageSize
{
  Small, ///< for what is written to here and there: the rest takes no memory
  Large  ///< for what is written to throughout; a hint
};

/// What memory holds that is to be used.
enum class PageContent
{
  Zeros,
  Anything ///< of what is filled throughout
};

/// Which pages take less time for memory that is written to at so many places here and there.
PageSize PagesForPlaces(std::size_t bytes, std::size_t places);

/// What the memory starts at a multiple of, at least.
constexpr std::size_t CacheLine = 64;

/// Memory that is zero, and not in use before it is written to. Throws if there is none.
void* AllocateZeros(std::size_t bytes, PageSize pages);
/// Whether AllocateZeros takes so much from the kernel itself; else std::free frees it.
bool IsMapped(std::size_t bytes);
/// How much that is, where it is mapped.
std::size_t SizeOfMapping(std::size_t bytes);
/// Frees what AllocateZeros gave for so many bytes.
void FreeZeros(void* memory, std::size_t bytes);

/// For std::vector: elements that no value is given for are left as they are, zero in new memory.
/// Large pages are kept for the next one.
template <typename T, PageSize Pages, PageContent Content = PageContent::Zeros>
struct PageAllocator
{
  using value_type = T;
  template <typename U>
  struct rebind
  {
    using other = PageAllocator<U, Pages, Content>;
  };

  PageAllocator() = default;
  template <typename U>
  PageAllocator(const PageAllocator<U, Pages, Content>&)
  {
  }
  T* allocate(std::size_t count)
  {
    static_assert(alignof(T) <= CacheLine, "of all pieces");
    const std::size_t bytes = count * sizeof(T);
    if (Pages == PageSize::Small)
    {
      return static_cast<T*>(AllocateZeros(bytes, Pages));
    }
    return static_cast<T*>(Content == PageContent::Zeros ? TakeZeroPages(bytes) : TakePages(bytes));
  }
  void deallocate(T* memory, std::size_t count)
  {
    Pages == PageSize::Large ? GivePages(memory, count * sizeof(T), PageUse::Work)
                             : FreeZeros(memory, count * sizeof(T));
  }

  template <typename U>
  void construct(U* item)
  {
    ::new (static_cast<void*>(item)) U;
  }
  template <typename U, typename... Arguments>
  void construct(U* item, Arguments&&... arguments)
  {
    ::new (static_cast<void*>(item)) U(std::forward<Arguments>(arguments)...);
  }
  template <typename U>
  bool operator==(const PageAllocator<U, Pages, Content>&) const
  {
    return true;
  }
  template <typename U>
  bool operator!=(const PageAllocator<U, Pages, Content>&) const
  {
    return false;
  }
};

/// A long array of values. PageVector<T>(count) is zero, and so is resize() of an empty one.
template <typename T>
using PageVector = std::vector<T, PageAllocator<T, PageSize::Large>>;

/// The same for one that is filled throughout: UnsetVector<T>(count) and resize() leave it as it
/// is, which may be anything.
template <typename T>
using UnsetVector = std::vector<T, PageAllocator<T, PageSize::Large, PageContent::Anything>>;

/// The same for one of which few parts are written to: the rest takes no memory.
template <typename T>
using SparseVector = std::vector<T, PageAllocator<T, PageSize::Small>>;

}

#endif
