#include "Tally.h"

#include <algorithm>
#include <cstdio>
#include <set>

namespace fuzz
{
void Tally::Add(const std::string& kind, const std::string& outcome, double seconds)
{
  ++this->Counts[outcome][kind];
  this->Slowest[outcome] = std::max(this->Slowest[outcome], seconds);
}

void Tally::Print() const
{
  std::set<std::string> kinds;
  for (const auto& row : this->Counts)
  {
    for (const auto& cell : row.second)
    {
      kinds.insert(cell.first);
    }
  }
  std::printf("%-34s", "");
  for (const std::string& kind : kinds)
  {
    std::printf(" %10s", kind.c_str());
  }
  std::printf(" %8s %9s\n", "all", "slowest s");
  for (const auto& [outcome, counts] : this->Counts)
  {
    std::printf("%-34s", outcome.c_str());
    int all = 0;
    for (const std::string& kind : kinds)
    {
      const auto cell = counts.find(kind);
      const int count = cell == counts.end() ? 0 : cell->second;
      std::printf(" %10d", count);
      all += count;
    }
    std::printf(" %8d %9.2f\n", all, this->Slowest.at(outcome));
  }
}
}
