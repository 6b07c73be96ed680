/**
 * @file TrimVerdict.h
 * @brief Runs the filter on damaged input: one error and nothing on the outputs, or a proper
 * result.
 */
#ifndef TrimVerdict_h
#define TrimVerdict_h

#include "Random.h"
#include "Tally.h"

#include "RunTrim.h"

#include <functional>

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

/// One trial of a series.
struct Trial
{
  judge::Mesh Mesh;
  judge::Surface Surface;
  std::string Kind; ///< what was damaged, as it is counted
  std::string What; ///< the same for a reader
};

/**
 * Trims what `make` makes, with random options, for (i = first; i < count; i += step); count,
 * seed, first and step are read from the command line.
 *
 * @param things what is damaged, in the singular.
 * @return exit status of the program.
 */
int RunSeries(int argc, char* argv[], int defaultCount, const std::string& things,
  const std::function<Trial(Random&)>& make);

/// Any sound surface over a mesh.
judge::Surface SoundSurface(const judge::Mesh& mesh, double mostLean, Random& random);
}

#endif
