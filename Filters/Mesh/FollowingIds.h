/**
 * @file FollowingIds.h
 * @brief Loops over ids that mostly follow each other, as those of what is left of a mesh do.
 */
#ifndef FollowingIds_h
#define FollowingIds_h

#include "Types.h"

#include <type_traits>

namespace trim
{

/// So many are looked at at once.
constexpr Id ManyIds = 16;

/// Whether so many ids are each the one before, plus one.
inline bool FollowEachOther(const Id* ids)
{
  if (ids[ManyIds - 1] - ids[0] != ManyIds - 1)
  {
    return false;
  }
  Id differ = 0;
  for (Id k = 0; k < ManyIds; ++k)
  {
    differ |= ids[k] ^ (ids[0] + k);
  }
  return differ == 0;
}

/// Calls action(i, id, count) for all of ids[begin] to ids[end]: `count` of them from i on follow
/// each other. One alone is told by its type, as it is copied without a call.
template <typename Action>
void ForFollowing(const Id* ids, Id begin, Id end, const Action& action)
{
  for (Id i = begin, next; i < end; i = next)
  {
    next = i;
    while (next + ManyIds <= end && ids[next] - next == ids[i] - i && FollowEachOther(ids + next))
    {
      next += ManyIds;
    }
    if (next > i)
    {
      action(i, ids[i], next - i);
    }
    else
    {
      action(i, ids[i], std::integral_constant<Id, 1>());
      ++next;
    }
  }
}

}

#endif
