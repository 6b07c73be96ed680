/**
 * @file WarnedFindings.h
 * @brief What the arrays Feasibility, Shortfall, DistanceLeft and CornerLost tell, which the
 * warnings have to tell as well, with the same numbers.
 */
#ifndef WarnedFindings_h
#define WarnedFindings_h

#include "RunTrim.h"

#include <map>
#include <string>

class vtkDataArray;

namespace judge
{

enum Feasibility
{
  Curved = 1,
  Inclined = 2,
  Narrow = 3,
  CrossedTwice = 4,
  NotOpened = 5
};

// A phrase of each warning: of Shortfall by value.
inline constexpr const char* ShortfallPhrases[] = { "", "below MinimumScaledJacobian", "",
  "distorted beyond repair", "inside out or without volume already", "less than a twentieth",
  "nothing joins to the rest" };
inline constexpr const char* LeftPhrase = "left off the surface";
inline constexpr const char* TolerancePhrase = "Tolerance takes them for on it";
inline constexpr const char* CornerPhrase = "moved for the trimmed grid alone";

/// How often each value but 0 is in an array.
std::map<int, int> CountValues(vtkDataArray* array);

/// Whatever is in the arrays is in a warning, with the same number, and the other way round.
/// @return of Feasibility.
std::map<int, int> ExpectWarned(const std::string& name, const Outcome& outcome);

/// From either side.
void ExpectNothing(
  const std::string& name, const Mesh& mesh, const Surface& surface, TrimOptions options);

/// How many of the elements of the warning with a phrase have a graver Shortfall in the array.
int CountBesideGraver(const Outcome& outcome, const std::string& phrase);

/// Number that a warning gives after these words; 0 without it.
int NumberAfter(const std::string& words, const Outcome& outcome);

/// Of the whole less both parts, in elements as large as those that were cut; more: negative.
double MeasureMissing(const Mesh& mesh, const Outcome& outcome);

/// The same as a warning tells of it; 0 without one.
double ToldMissing(const Outcome& outcome);

/// Whether a warning has these words.
bool IsTold(const Outcome& outcome, const std::string& words);

/// Only the given value of Feasibility, in at least so many elements.
void ExpectOnly(const std::string& name, const Mesh& mesh, const Surface& surface, int value,
  int atLeast, const TrimOptions& options = {});

}

#endif
