/**
 * @file TrimmedBand.h
 * @brief The band after decision, correction and treatment, and the final shape of its elements.
 */
#ifndef TrimmedBand_h
#define TrimmedBand_h

#include "Pentahedra.h"
#include "Runs.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace trim
{

/// The rung by which a column was saved.
enum class Rung : unsigned char
{
  None,
  FateFirst, ///< the eliminated elements round a node that has no place are kept
  Treatment,
  Correction,
  Fate,       ///< eliminated instead of kept
  FateAround, ///< kept, with its eliminated neighbours
  Left
};

/// The trimmed band.
struct TrimmedBand
{
  std::vector<char> Kept; ///< by element
  Moves NodeMoves;
  Moves Unrelaxed; ///< NodeMoves as corrected and treated
  Pentahedra Treated;
  std::vector<Rung> RescuedBy; ///< by column (smallest element)
  /// Columns that were kept or eliminated against their volume, mostly to save one beside them.
  std::vector<char> AgainstVolume;
  std::vector<char> Relaxed;   ///< elements that were below the floor before the relaxation
  std::vector<int> BelowFloor; ///< valid elements that stayed below the quality floor
  std::vector<int> Invalid;    ///< elements that no rung could save; empty as a rule
  std::vector<char> Moving;    ///< nodes that have to lie on the new boundary
  std::vector<char> OnCrease;  ///< nodes on sharp edges of the surface; empty: none are
  /// What FindCloser begins with; null: no nodes are left.
  std::shared_ptr<const TrimmedBand> Unpolished;
};

/// Nodes and positions of a band element as it is after the trim.
struct FinalElement
{
  int Count = 0;
  std::array<int, 8> Node;
  ElementPoints Points;
  bool Touched = false; ///< has a moved node or was replaced

  const int* begin() const { return this->Node.data(); }
  const int* end() const { return this->Node.data() + this->Count; }
};
FinalElement FinalShape(const Band& band, const TrimmedBand& trimmed, int element);

/// Kept elements that have a moved node or were replaced, ascending: a small part of the band.
std::vector<int> FindTouchedElements(const Band& band, const TrimmedBand& trimmed);

/// The touched elements that are asked and pass a test, ascending, asked by all threads.
template <typename Asked, typename Test>
std::vector<int> FindElements(
  const Band& band, const TrimmedBand& trimmed, const Asked& isAsked, const Test& test)
{
  std::vector<int> touched = FindTouchedElements(band, trimmed);
  touched.erase(std::remove_if(touched.begin(), touched.end(), [&](int e) { return !isAsked(e); }),
    touched.end());
  std::vector<char> passes(touched.size(), 0);
  ForAll(static_cast<int>(touched.size()),
    [&](int i) { passes[i] = test(touched[i], FinalShape(band, trimmed, touched[i])); });
  std::vector<int> found;
  for (std::size_t i = 0; i < touched.size(); ++i)
  {
    if (passes[i])
    {
      found.push_back(touched[i]);
    }
  }
  return found;
}
template <typename Test>
std::vector<int> FindElements(const Band& band, const TrimmedBand& trimmed, const Test& test)
{
  return FindElements(
    band, trimmed, [](int) { return true; }, test);
}

/// Nodes of the new boundary: of facets between kept and eliminated elements, and of those that
/// wedges have where they dropped an edge.
std::vector<char> FindBoundaryNodes(const Band& band, const TrimmedBand& trimmed);

/// Those of them that kept elements still have, ascending.
std::vector<int> ListBoundaryNodes(const Band& band, const TrimmedBand& trimmed);

/// How many kept elements use each band node, with the nodes that wedges dropped left out.
std::vector<int> CountUsers(const Band& band, const TrimmedBand& trimmed);

}

#endif
