/**
 * @file PageVector.h
 * @brief Memory for long arrays, as those with a value for every node or cell: in large pages, as
 * far from the cut most of a trim's time is the kernel's, to hand over memory that was never
 * touched before. What a run has freed the next one gets (PagePool.h).
 */
#ifndef PageVector_h
#define PageVector_h

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

/// Which pages take less time for memory that is written to at so many places here and there.
PageSize PagesForPlaces(std::size_t bytes, std::size_t places);

/// What the memory starts at a multiple of, at least.
constexpr std::size_t CacheLine = 64;

/// Memory that is zero, and if it is new not in use before it is written to. Throws if there is
/// none.
void* AllocateZeros(std::size_t bytes, PageSize pages);
/// Memory that holds anything, for what is written to throughout. Throws if there is none.
void* AllocatePages(std::size_t bytes);
/// Whether so much is taken from the kernel itself; else std::free frees it.
bool IsMapped(std::size_t bytes);
/// Frees what the two gave for so many bytes; AllocatePages gives large pages.
void FreePages(void* memory, std::size_t bytes, PageSize pages);

/// For std::vector: elements that no value is given for are left as they are, zero in new memory.
template <typename T, PageSize Pages>
struct PageAllocator
{
  using value_type = T;
  template <typename U>
  struct rebind
  {
    using other = PageAllocator<U, Pages>;
  };

  PageAllocator() = default;
  template <typename U>
  PageAllocator(const PageAllocator<U, Pages>&)
  {
  }
  T* allocate(std::size_t count)
  {
    static_assert(alignof(T) <= CacheLine, "of all pieces");
    return static_cast<T*>(AllocateZeros(count * sizeof(T), Pages));
  }
  void deallocate(T* memory, std::size_t count) { FreePages(memory, count * sizeof(T), Pages); }

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
  bool operator==(const PageAllocator<U, Pages>&) const
  {
    return true;
  }
  template <typename U>
  bool operator!=(const PageAllocator<U, Pages>&) const
  {
    return false;
  }
};

/// A long array of values. PageVector<T>(count) is zero, and so is resize() of an empty one.
template <typename T>
using PageVector = std::vector<T, PageAllocator<T, PageSize::Large>>;

/// The same for one of which few parts are written to: the rest takes no memory.
template <typename T>
using SparseVector = std::vector<T, PageAllocator<T, PageSize::Small>>;

}

#endif
