/**
 * @file FailedReturns.h
 * @brief Returns of nodes to the surface, and edges dropped for them, that failed although their
 * neighbours made room.
 *
 * A climb for both parts is repeated for a few more demands, and most of these trials, the dearest
 * of all, come to the same places and shapes again. They depend on nothing else, so that what
 * failed once need not be tried again.
 */
#ifndef FailedReturns_h
#define FailedReturns_h

#include "RelaxedMesh.h"

#include <mutex>
#include <string>
#include <unordered_set>
#include <vector>

namespace trim
{

/// Of one band and surface; for any number of threads.
class FailedReturns
{
public:
  /// All that a trial depends on, as bytes.
  using Key = std::string;

  bool Contain(const Key& key) const
  {
    const std::lock_guard<std::mutex> locked(this->Lock);
    return this->Failures.count(key) > 0;
  }
  void Add(const Key& key)
  {
    const std::lock_guard<std::mutex> locked(this->Lock);
    this->Failures.insert(key);
  }

private:
  mutable std::mutex Lock;
  std::unordered_set<Key> Failures;
};

/// What a relaxation of the nodes in rings round elements may ask for: how all elements at such
/// nodes are shaped, and where their nodes are and may go.
/// @param fixed by node: it must not move.
/// @param rings of nodes, as for RelaxedMesh::NodesRound.
FailedReturns::Key StateRound(const RelaxedMesh& mesh, const std::vector<char>& fixed,
  const std::vector<int>& elements, int rings);

/// Appends the bytes of a value that is nothing else.
template <typename Value>
void AppendBytes(const Value& value, FailedReturns::Key& key)
{
  key.append(reinterpret_cast<const char*>(&value), sizeof(Value));
}

}

#endif
