/**
 * @file TrimVerdict.h
 * @brief Runs the filter on damaged input: one error and nothing on the outputs, or a proper
 * result.
 */
#ifndef TrimVerdict_h
#define TrimVerdict_h

#include "Tally.h"

#include "RunTrim.h"

namespace fuzz
{
/// The small meshes that are trimmed.
const std::vector<judge::Mesh>& SmallMeshes();

/**
 * Trims, checks what comes out and counts it in `tally` under `kind`.
 *
 * A proper result has finite points, sound elements with the ids they came from, all arrays, and,
 * unless the filter says that some are beyond repair, valid elements wherever the input's are.
 * Where the surface runs is not judged: that is for the campaign.
 *
 * @return failures found; each is printed with `name`.
 */
int TrimAndJudge(const judge::Mesh& mesh, const judge::Surface& surface,
  const judge::TrimOptions& options, const std::string& kind, const std::string& name,
  Tally& tally);

/// Reads count, seed and first from the command line, for (i = first; i < count; i += step).
struct Series
{
  Series(int argc, char* argv[], int defaultCount);
  int Count = 0;
  unsigned Seed = 1;
  int First = 0;
  int Step = 1;
};
}

#endif
