/**
 * @file ConcurrentSets.h
 * @brief Union-find that several threads may unite in at the same time; the root of a set is its
 * smallest member, so that the sets do not depend on who came first.
 */
#ifndef ConcurrentSets_h
#define ConcurrentSets_h

#include "PageVector.h"

#include <vtkSMPTools.h>

#include <algorithm>
#include <atomic>

namespace trim
{

template <typename Index>
class ConcurrentSets
{
public:
  explicit ConcurrentSets(Index count)
    : Back(count)
    , Alone(vtkSMPTools::GetEstimatedNumberOfThreads() < 2)
  {
  }

  /// A smaller member of the set; of the root itself.
  Index Parent(Index i) const { return i - this->Back[i].load(std::memory_order_relaxed); }

  Index Find(Index i)
  {
    for (Index parent = this->Parent(i); parent != i; parent = this->Parent(i))
    {
      // Whoever halves the path meanwhile leads it to an ancestor as well.
      const Index next = this->Parent(parent);
      this->Back[i].store(i - next, std::memory_order_relaxed);
      i = next;
    }
    return i;
  }

  void Unite(Index a, Index b)
  {
    if (this->Parent(a) == this->Parent(b))
    {
      return; // most are united already
    }
    while ((a = this->Find(a)) != (b = this->Find(b)))
    {
      const Index large = std::max(a, b);
      const Index back = large - std::min(a, b);
      Index none = 0;
      if (this->Alone)
      {
        this->Back[large].store(back, std::memory_order_relaxed);
        return;
      }
      if (this->Back[large].compare_exchange_strong(none, back, std::memory_order_relaxed))
      {
        return;
      }
    }
  }

private:
  nurbs::PageVector<std::atomic<Index>> Back; ///< from a member to its parent; 0: a root
  bool Alone;                                 ///< one thread needs no locked instructions
};

}

#endif
