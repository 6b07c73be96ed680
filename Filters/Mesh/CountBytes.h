/**
 * @file CountBytes.h
 * @brief Counts values of one byte, of which long arrays have one for each node or cell.
 */
#ifndef CountBytes_h
#define CountBytes_h

#include "Types.h"

#include <algorithm>

namespace trim
{

/// As std::count, which counts in numbers of eight bytes, and eight times fewer at once.
template <typename Byte>
Id CountBytes(const Byte* begin, const Byte* end, Byte value)
{
  static_assert(sizeof(Byte) == 1, "others are counted by std::count");
  constexpr Id most = 240; // to be counted in a byte
  Id count = 0;
  for (; begin != end; begin += std::min<Id>(most, end - begin))
  {
    const Id length = std::min<Id>(most, end - begin);
    unsigned char some = 0;
    for (Id i = 0; i < length; ++i)
    {
      some += begin[i] == value;
    }
    count += some;
  }
  return count;
}

template <typename Bytes>
Id CountBytes(const Bytes& bytes, typename Bytes::value_type value)
{
  return CountBytes(bytes.data(), bytes.data() + bytes.size(), value);
}

}

#endif
