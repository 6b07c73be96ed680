/**
 * @file Samples.h
 * @brief Sound CAD files to be damaged: those of the project, of other programs, of
 * OpenCASCADE's writers, and one for each kind of IGES surface. Small, so that many can be read.
 */
#ifndef Samples_h
#define Samples_h

#include <string>
#include <vector>

namespace fuzz
{
struct Sample
{
  std::string Name;
  bool Iges; ///< else STEP
  std::string Text;
};

/// `directory`: where OpenCASCADE's writers may leave files for a moment.
std::vector<Sample> CadSamples(const std::string& directory);
}

#endif
