/**
 * @file StreamedCopy.h
 * @brief Writes to memory past the caches: what a long output takes up is not read from memory
 * before it is written to, and drives nothing else out of the caches.
 */
#ifndef StreamedCopy_h
#define StreamedCopy_h

#include <cstddef>
#include <cstdint>
#include <cstring>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace trim
{

/// As std::memcpy, of a multiple of 16 bytes; past the caches where the target is aligned to as
/// many. Other threads may read it after FinishStreaming.
inline void CopyStreamed(void* to, const void* from, std::size_t bytes)
{
#ifdef __SSE2__
  if (reinterpret_cast<std::uintptr_t>(to) % sizeof(__m128i) == 0)
  {
    auto* const target = static_cast<__m128i*>(to);
    const auto* const source = static_cast<const __m128i*>(from);
    for (std::size_t i = 0; i < bytes / sizeof(__m128i); ++i)
    {
      _mm_stream_si128(target + i, _mm_loadu_si128(source + i));
    }
    return;
  }
#endif
  std::memcpy(to, from, bytes);
}

/// To be called by the thread that has written.
inline void FinishStreaming()
{
#ifdef __SSE2__
  _mm_sfence();
#endif
}

}

#endif
