#include "IgesWeights.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <vector>

namespace nurbs
{
namespace
{
/// Layout of an IGES line, counted from 0.
constexpr size_t ParameterWidth = 64;
constexpr size_t SectionColumn = 72;

/// OpenCASCADE takes what is below for no weight at all.
constexpr double SmallestWeight = 1e-9;

/// One record of the parameter section, divided at its delimiters.
std::vector<std::string> Divide(const std::string& record, char delimiter, char terminator)
{
  std::vector<std::string> fields;
  std::istringstream stream(record.substr(0, record.find(terminator)));
  for (std::string field; std::getline(stream, field, delimiter);)
  {
    // Fortran's exponents.
    std::replace(field.begin(), field.end(), 'D', 'E');
    std::replace(field.begin(), field.end(), 'd', 'e');
    fields.push_back(field);
  }
  return fields;
}

long Whole(const std::vector<std::string>& fields, size_t index)
{
  return index < fields.size() ? std::strtol(fields[index].c_str(), nullptr, 10) : -1;
}

/// Not strtod: a decimal point whatever the locale. What is no number is zero.
double Real(const std::string& field)
{
  const size_t first = std::min(field.find_first_not_of(" \t+"), field.size());
  double number = 0.0;
  std::from_chars(field.data() + first, field.data() + field.size(), number);
  return number;
}

/// Where the weights of a spline begin and how many there are; zero if it is no sound spline.
size_t LocateWeights(const std::vector<std::string>& fields, size_t& first)
{
  const long type = Whole(fields, 0);
  const bool surface = type == 128;
  const long limit = static_cast<long>(fields.size());
  if (!surface && type != 126)
  {
    return 0;
  }
  const long upper[2] = { Whole(fields, 1), surface ? Whole(fields, 2) : 0 };
  const long degree[2] = { Whole(fields, surface ? 3 : 2), surface ? Whole(fields, 4) : 0 };
  for (int axis : { 0, 1 })
  {
    if (upper[axis] < 0 || degree[axis] < 0 || upper[axis] > limit || degree[axis] > limit)
    {
      return 0;
    }
  }
  const long knots = upper[0] + degree[0] + 2 + (surface ? upper[1] + degree[1] + 2 : 0);
  first = static_cast<size_t>((surface ? 10 : 7) + knots);
  const size_t count = static_cast<size_t>((upper[0] + 1) * (upper[1] + 1));
  return first + count <= fields.size() ? count : 0;
}

std::string CheckRecord(
  const std::string& record, const std::string& owner, char delimiter, char terminator)
{
  const std::vector<std::string> fields = Divide(record, delimiter, terminator);
  size_t first = 0;
  const size_t count = LocateWeights(fields, first);
  for (size_t i = 0; i < count; ++i)
  {
    const double weight = Real(fields[first + i]);
    // Written so that NaN fails.
    if (!(weight > SmallestWeight))
    {
      std::ostringstream text;
      text << "weight " << i + 1 << " of the B-spline at directory line D"
           << std::atol(owner.c_str()) << " is " << weight << ", not positive";
      return text.str();
    }
  }
  return std::string();
}

/// Delimiters are the first two strings of the global section, each "1H" and the character.
void ReadDelimiters(const std::string& global, char& delimiter, char& terminator)
{
  if (global.size() > 3 && global.compare(0, 2, "1H") == 0)
  {
    delimiter = global[2];
  }
  const size_t second = global.find(delimiter, global.compare(0, 2, "1H") == 0 ? 3 : 0);
  if (second != std::string::npos && global.compare(second + 1, 2, "1H") == 0 &&
    second + 3 < global.size())
  {
    terminator = global[second + 3];
  }
}
}

//------------------------------------------------------------------------------
std::string FindBadIgesWeight(const std::string& path)
{
  std::ifstream stream(path, std::ios::binary);
  char delimiter = ',';
  char terminator = ';';
  bool globalSeen = false;
  std::string record;
  std::string owner;
  std::string defect;
  for (std::string line; defect.empty() && std::getline(stream, line);)
  {
    const char section = line.size() > SectionColumn ? line[SectionColumn] : ' ';
    if (section == 'G' && !globalSeen)
    {
      ReadDelimiters(line, delimiter, terminator);
      globalSeen = true;
    }
    if (section != 'P' && section != 'T')
    {
      continue;
    }
    const std::string newOwner = line.substr(ParameterWidth, SectionColumn - ParameterWidth);
    if (section == 'T' || newOwner != owner)
    {
      defect = CheckRecord(record, owner, delimiter, terminator);
      record.clear();
      owner = newOwner;
    }
    record += line.substr(0, ParameterWidth);
  }
  return defect;
}
}
