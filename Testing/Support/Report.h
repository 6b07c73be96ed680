/**
 * @file Report.h
 * @brief Counts the failures of checks, and prints the first ones of each kind, each on one line
 * with place, value and limit.
 */
#ifndef Report_h
#define Report_h

#include "Model.h"

#include <map>
#include <string>
#include <utility>

namespace judge
{
class Report
{
public:
  explicit Report(std::string context, bool quiet = false)
    : Context(std::move(context))
    , Quiet(quiet)
  {
  }
  /// Counts, and prints "FAIL context: check: place: value (limit)" for the first few.
  void Fail(const std::string& check, const std::string& place, double value, double limit);
  void Fail(const std::string& check, const std::string& text);
  /// Counts what the filter could not do and said so: no failure, but not silent either.
  void Note(const std::string& what) { ++this->NoteCounts[what]; }
  const std::map<std::string, int>& Notes() const { return this->NoteCounts; }
  int Failures() const { return this->Total; }
  int Failures(const std::string& check) const;
  const std::map<std::string, int>& ByCheck() const { return this->Counts; }

private:
  bool Count(const std::string& check);
  std::string Context;
  bool Quiet;
  int Total = 0;
  std::map<std::string, int> Counts, NoteCounts;
};

/// As reports name a cell and a point.
inline std::string Cell(Id c)
{
  return "cell " + std::to_string(c);
}
inline std::string Point(Id p)
{
  return "point " + std::to_string(p);
}

}

#endif
