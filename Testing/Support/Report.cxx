#include "Report.h"

#include <cstdio>

namespace judge
{
namespace
{
constexpr int PrintedOfEachKind = 3;
}

bool Report::Count(const std::string& check)
{
  ++this->Total;
  return ++this->Counts[check] <= PrintedOfEachKind && !this->Quiet;
}

int Report::Failures(const std::string& check) const
{
  const auto entry = this->Counts.find(check);
  return entry == this->Counts.end() ? 0 : entry->second;
}

void Report::Fail(const std::string& check, const std::string& place, double value, double limit)
{
  if (this->Count(check))
  {
    std::printf("FAIL %s: %s: %s: %.9g (limit %.9g)\n", this->Context.c_str(), check.c_str(),
      place.c_str(), value, limit);
  }
}

void Report::Fail(const std::string& check, const std::string& text)
{
  if (this->Count(check))
  {
    std::printf("FAIL %s: %s: %s\n", this->Context.c_str(), check.c_str(), text.c_str());
  }
}

}
