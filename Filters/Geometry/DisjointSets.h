/**
 * @file DisjointSets.h
 * @brief Union-find with path halving; the root of a set is its smallest member, so that the
 * result does not depend on the order of the unions.
 */
#ifndef DisjointSets_h
#define DisjointSets_h

#include <algorithm>
#include <numeric>
#include <vector>

namespace nurbs
{

template <typename Index>
class DisjointSets
{
public:
  explicit DisjointSets(Index count)
    : Parent(count)
  {
    std::iota(this->Parent.begin(), this->Parent.end(), Index(0));
  }

  Index Size() const { return static_cast<Index>(this->Parent.size()); }

  Index Find(Index i)
  {
    while (this->Parent[i] != i)
    {
      this->Parent[i] = this->Parent[this->Parent[i]];
      i = this->Parent[i];
    }
    return i;
  }

  void Unite(Index a, Index b)
  {
    a = this->Find(a);
    b = this->Find(b);
    this->Parent[std::max(a, b)] = std::min(a, b);
  }

private:
  std::vector<Index> Parent;
};

}

#endif
