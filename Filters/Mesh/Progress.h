/**
 * @file Progress.h
 * @brief How long work tells how far it is, and learns that it is to end.
 */
#ifndef Progress_h
#define Progress_h

#include <functional>

namespace trim
{

/// Reports a fraction of the work, negative: none; returns true if the work is to end.
using Progress = std::function<bool(double)>;

/// Asked by any thread of long work: true if the work is to end, and its result is of no use then.
using AbortCheck = std::function<bool()>;
/// For work that nobody follows or ends.
inline bool NobodyAsks(double)
{
  return false;
}
/// Must not outlive the progress.
inline AbortCheck AbortOf(const Progress& progress)
{
  return [&progress] { return progress(-1.0); };
}

/// The progress of a part of the work, from one fraction of the whole to another.
inline Progress Part(const Progress& whole, double from, double to)
{
  return [whole, from, to](double done)
  { return whole(done < 0.0 ? done : from + (to - from) * done); };
}

}

#endif
