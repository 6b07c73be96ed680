#include "PagePool.h"

#include "PageVector.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

#include <algorithm>
#include <atomic>
#include <cstring>
#include <iterator>
#include <new>

namespace nurbs
{
namespace
{

/// Runs of each user after which what is kept was of no use: a viewer may hold what the one before
/// gave it until the next.
constexpr int RunsToKeep = 2;
/// Bytes of memory at work that are kept: what 2M elements take.
constexpr std::size_t MostOfWork = std::size_t(1) << 27;

#ifdef __linux__

void Unmap(void* memory, std::size_t size)
{
  munmap(memory, size);
}

/// What is not needed before may be taken by the kernel where memory is short.
void OfferToKernel(void* memory, std::size_t size)
{
#ifdef MADV_FREE
  madvise(memory, size, MADV_FREE);
#else
  (void)memory;
  (void)size;
#endif
}

/// Maps what follows a mapping; false if something else is there.
bool Extend(void* memory, std::size_t from, std::size_t to)
{
#ifdef MAP_FIXED_NOREPLACE
  void* const end = static_cast<char*>(memory) + from;
  void* const more = mmap(end, to - from, PROT_READ | PROT_WRITE,
    MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED_NOREPLACE, -1, 0);
  if (more == end)
  {
    madvise(memory, to, MADV_HUGEPAGE);
    return true;
  }
  if (more != MAP_FAILED) // by a kernel that does not know the flag
  {
    munmap(more, to - from);
  }
#else
  (void)memory;
  (void)from;
  (void)to;
#endif
  return false;
}

#else

void Unmap(void*, std::size_t) {}
void OfferToKernel(void*, std::size_t) {}
bool Extend(void*, std::size_t, std::size_t)
{
  return false;
}

#endif

/// What has to be mapped or given back to make one size of the other.
std::size_t Difference(std::size_t size, std::size_t other)
{
  return size > other ? size - other : other - size;
}

}

PagePool& PagePool::Get()
{
  // Never destroyed: arrays may outlive what is static.
  static auto* const pool = new PagePool;
  return *pool;
}

void* PagePool::Take(std::size_t size)
{
  const std::lock_guard<std::mutex> locked(this->Lock);
  // The last that came are those that are in the caches.
  const auto nearest = std::min_element(this->Blocks.rbegin(), this->Blocks.rend(),
    [size](const Block& a, const Block& b)
    { return Difference(size, a.Size) < Difference(size, b.Size); });
  if (nearest == this->Blocks.rend() || Difference(size, nearest->Size) > size / 4 ||
    (nearest->Size < size && !Extend(nearest->Memory, nearest->Size, size)))
  {
    return nullptr;
  }
  void* const memory = nearest->Memory;
  if (nearest->Size > size)
  {
    Unmap(static_cast<char*>(memory) + size, nearest->Size - size);
  }
  this->Blocks.erase(std::next(nearest).base());
  return memory;
}

bool PagePool::Keep(void* memory, std::size_t size, PageUse use)
{
  const std::lock_guard<std::mutex> locked(this->Lock);
  if (this->Users == 0)
  {
    return false;
  }
  try
  {
    this->Blocks.push_back({ memory, size, use, 0 });
  }
  catch (const std::bad_alloc&) // those who free memory do not expect one
  {
    return false;
  }
  OfferToKernel(memory, size);
  std::size_t ofWork = 0;
  this->Drop(
    [&ofWork](const Block& block)
    {
      const std::size_t size = block.Use == PageUse::Work ? block.Size : 0;
      const bool isKept = ofWork + size <= MostOfWork;
      ofWork += isKept ? size : 0;
      return isKept;
    });
  return true;
}

template <typename IsKept>
void PagePool::Drop(const IsKept& isKept)
{
  // Memory is freed where there is none for a second list.
  for (std::size_t i = this->Blocks.size(); i-- > 0;)
  {
    const Block& block = this->Blocks[i];
    if (!isKept(block))
    {
      Unmap(block.Memory, block.Size);
      this->Blocks.erase(this->Blocks.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
}

void PagePool::Empty()
{
  const std::lock_guard<std::mutex> locked(this->Lock);
  this->Drop([](const Block&) { return false; });
}

void PagePool::Join()
{
  const std::lock_guard<std::mutex> locked(this->Lock);
  ++this->Users;
}

void PagePool::Leave()
{
  const std::lock_guard<std::mutex> locked(this->Lock);
  --this->Users;
  this->Drop([this](const Block&) { return this->Users > 0; });
}

void PagePool::EndRun()
{
  const std::lock_guard<std::mutex> locked(this->Lock);
  this->Drop([this](const Block& block) { return block.Age < RunsToKeep * this->Users; });
  for (Block& block : this->Blocks)
  {
    ++block.Age;
  }
}

namespace
{

void* TakeUsed(std::size_t bytes)
{
  return IsMapped(bytes) ? PagePool::Get().Take(SizeOfMapping(bytes)) : nullptr;
}

void FillZeros(void* memory, std::size_t bytes)
{
  std::memset(memory, 0, bytes);
}

std::atomic<void (*)(void*, std::size_t)> ZeroFill{ &FillZeros };

}

void* TakePages(std::size_t bytes)
{
  void* const used = TakeUsed(bytes);
  return used ? used : AllocateZeros(bytes, PageSize::Large);
}

void* TakeZeroPages(std::size_t bytes)
{
  void* const used = TakeUsed(bytes);
  if (!used)
  {
    return AllocateZeros(bytes, PageSize::Large);
  }
  ZeroFill.load()(used, bytes);
  return used;
}

void SetZeroFill(void (*fill)(void* memory, std::size_t bytes))
{
  ZeroFill = fill;
}

void GivePages(void* memory, std::size_t bytes, PageUse use)
{
  if (!IsMapped(bytes) || !PagePool::Get().Keep(memory, SizeOfMapping(bytes), use))
  {
    FreeZeros(memory, bytes);
  }
}

}
