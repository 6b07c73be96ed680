/**
 * @file Tally.h
 * @brief Counts of what came out, by what was done to the input, as a table.
 */
#ifndef Tally_h
#define Tally_h

#include <map>
#include <string>

namespace fuzz
{
class Tally
{
public:
  void Add(const std::string& kind, const std::string& outcome, double seconds);
  /// One line an outcome, one column a kind, and the longest time of each outcome.
  void Print() const;

private:
  std::map<std::string, std::map<std::string, int>> Counts;
  std::map<std::string, double> Slowest;
};
}

#endif
