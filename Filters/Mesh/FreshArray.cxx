#include "FreshArray.h"

#include "PagePool.h"

#include <cstdlib>
#include <mutex>
#include <unordered_map>

namespace trim
{
namespace
{

/// Memory of arrays that std::free cannot free.
struct InUse
{
  struct Piece
  {
    std::size_t Bytes = 0;
    nurbs::PageSize Pages = nurbs::PageSize::Large;
  };

  std::mutex Lock;
  std::unordered_map<void*, Piece> Pieces;

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
  InUse::Piece piece;
  {
    const std::lock_guard<std::mutex> locked(inUse.Lock);
    const auto found = inUse.Pieces.find(memory);
    if (found != inUse.Pieces.end())
    {
      piece = found->second;
      inUse.Pieces.erase(found);
    }
  }
  if (piece.Bytes > 0)
  {
    // Of what is written to here and there little is in use: not worth to be kept.
    piece.Pages == nurbs::PageSize::Large
      ? nurbs::GivePages(memory, piece.Bytes, nurbs::PageUse::Output)
      : nurbs::FreeZeros(memory, piece.Bytes);
  }
  else
  {
    std::free(memory);
  }
}

ArrayMemory ForArray(void* memory, std::size_t bytes, nurbs::PageSize pages)
{
  if (!nurbs::IsMapped(bytes))
  {
    return { memory, &std::free };
  }
  auto& inUse = InUse::Get();
  const std::lock_guard<std::mutex> locked(inUse.Lock);
  inUse.Pieces[memory] = { bytes, pages };
  return { memory, &FreeOfArray };
}

}

ArrayMemory AllocateZerosForArray(std::size_t bytes, nurbs::PageSize pages)
{
  void* const memory = pages == nurbs::PageSize::Large ? nurbs::TakeZeroPages(bytes)
                                                       : nurbs::AllocateZeros(bytes, pages);
  return ForArray(memory, bytes, pages);
}

ArrayMemory AllocatePagesForArray(std::size_t bytes)
{
  return ForArray(nurbs::TakePages(bytes), bytes, nurbs::PageSize::Large);
}

}
