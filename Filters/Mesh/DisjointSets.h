/**
 * @file DisjointSets.h
 * @brief Union-find with path halving; the root of a set is its smallest member, so that the
 * result does not depend on the order of the unions.
 */
#ifndef DisjointSets_h
#define DisjointSets_h

#include <numeric>
#include <vector>

namespace trim
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
    if (a < b)
    {
      this->Parent[b] = a;
    }
    else
    {
      this->Parent[a] = b;
    }
  }

private:
  std::vector<Index> Parent;
};

}

#endif
