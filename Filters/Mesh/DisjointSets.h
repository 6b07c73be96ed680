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

  Index Size() const { return static_cast<Index>(this->Parent.size()); }

  /// A set of one new member.
  Index Append()
  {
    this->Parent.push_back(this->Size());
    return this->Parent.back();
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
    // As most are when the links of a whole mesh are followed.
    if (this->Parent[a] != this->Parent[b])
    {
      this->UniteRoots(this->Find(a), this->Find(b));
    }
  }

  /// True if a member hangs directly on a root.
  bool HangsOn(Index member, Index root) const { return this->Parent[member] == root; }

  /**
   * Joins a member to the set of a root and returns the root of both. A member that hangs on the
   * root already, as most do when whole cells are joined one after the other, costs one look.
   */
  Index Attach(Index member, Index root)
  {
    return this->HangsOn(member, root) ? root : this->UniteRoots(this->Find(member), root);
  }

private:
  Index UniteRoots(Index a, Index b)
  {
    const Index root = std::min(a, b);
    this->Parent[std::max(a, b)] = root;
    return root;
  }

  std::vector<Index> Parent;
};

}

#endif
