/**
 * @file Selection.h
 * @brief Which points or cells of the input an output has, in its order; a view.
 */
#ifndef Selection_h
#define Selection_h

#include "FollowingIds.h"
#include "HexMesh.h"
#include "IdList.h"

#include <algorithm>
#include <cstring>
#include <vector>

namespace trim
{

class Selection
{
public:
  /// The whole input.
  static Selection All(Id count) { return Selection(nullptr, count, nullptr); }

  /// Ids in ascending order; one may come several times in a row.
  static Selection Ascending(const IdList& ids)
  {
    return Selection(ids.data(), ids.size(), nullptr);
  }

  /// Ids in any order; number[id] is the place of an id in the output, -1: it is not there.
  static Selection Numbered(const IdList& ids, const UnsetVector<int>& number)
  {
    return Selection(ids.data(), ids.size(), &number);
  }

  Id size() const { return this->Count; }
  Id operator[](Id i) const { return this->Ids ? this->Ids[i] : i; }

  /// Takes values[id] to the places from begin to end of the output.
  template <typename Value>
  void Gather(const Value* values, Id begin, Id end, Value* output) const
  {
    if (!this->Ids)
    {
      std::copy(values + begin, values + end, output + begin);
      return;
    }
    // Not member by member, which bytes that are written might change, for all it knows.
    ForFollowing(this->Ids, begin, end,
      [values, output](Id i, Id id, auto count)
      { std::memcpy(output + i, values + id, count * sizeof(Value)); });
  }

  /// Calls action(place) for each place of an id in the output.
  template <typename Action>
  void ForPlaces(Id id, const Action& action) const
  {
    // An empty list has no ids either, and no places.
    if (!this->Ids)
    {
      if (id < this->Count)
      {
        action(id);
      }
      return;
    }
    if (this->Number)
    {
      if ((*this->Number)[id] >= 0)
      {
        action(Id((*this->Number)[id]));
      }
      return;
    }
    const Id* end = this->Ids + this->Count;
    for (const Id* at = std::lower_bound(this->Ids, end, id); at != end && *at == id; ++at)
    {
      action(Id(at - this->Ids));
    }
  }

private:
  Selection(const Id* ids, Id count, const UnsetVector<int>* number)
    : Ids(ids)
    , Count(count)
    , Number(number)
  {
  }

  const Id* Ids;
  Id Count;
  const UnsetVector<int>* Number;
};

}

#endif
