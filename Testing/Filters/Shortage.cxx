#include "Shortage.h"

#include <atomic>
#include <cstdlib>
#include <new>

namespace
{
std::atomic<bool> Counts{ false };
std::atomic<long> Count{ 0 };
judge::Shortage::Refusal Planned;

bool IsRefused(std::size_t bytes)
{
  if (!Counts || bytes < Planned.Smallest)
  {
    return false;
  }
  const long number = Count++;
  return Planned.First >= 0 && (Planned.Lasts ? number >= Planned.First : number == Planned.First);
}
}

// All forms of them, as a sanitizer has its own of each.
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept
{
  return IsRefused(bytes) ? nullptr : std::malloc(bytes > 0 ? bytes : 1);
}
void* operator new(std::size_t bytes)
{
  void* const memory = operator new(bytes, std::nothrow);
  if (!memory)
  {
    throw std::bad_alloc();
  }
  return memory;
}
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept
{
  return operator new(bytes, std::nothrow);
}
void* operator new[](std::size_t bytes)
{
  return operator new(bytes);
}
void operator delete(void* memory) noexcept
{
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept
{
  std::free(memory);
}
void operator delete[](void* memory) noexcept
{
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept
{
  std::free(memory);
}

namespace judge
{
Shortage::Shortage()
{
  Counts = true;
}
Shortage::~Shortage()
{
  Counts = false;
}
void Shortage::Plan(const Refusal& refusal)
{
  Planned = refusal;
  Count = 0;
}
long Shortage::Seen()
{
  return Count;
}
}
