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

/// The progress of a part of the work, from one fraction of the whole to another.
inline Progress Part(const Progress& whole, double from, double to)
{
  return [whole, from, to](double done)
  { return whole(done < 0.0 ? done : from + (to - from) * done); };
}

}

#endif
