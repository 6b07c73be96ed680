/**
 * @file Mutation.h
 * @brief Damages the text of a CAD file in ways that reach different depths of its reader.
 */
#ifndef Mutation_h
#define Mutation_h

#include "Random.h"

#include <string>
#include <vector>

namespace fuzz
{
/// What was done to a text, for the table and for repeating it.
struct Mutation
{
  const char* Kind;
  std::string Text;
};

/// All kinds: bytes, bits, digits, values, references, blocks, noise, lines, cut, mixed.
const std::vector<const char*>& MutationKinds();

/**
 * Applies one kind a few times. `columns`: the file has fixed columns (IGES), which numbers and
 * references keep, so that the damage gets past the check of the lines.
 */
Mutation Mutate(const std::string& text, bool columns, Random& random);
}

#endif
