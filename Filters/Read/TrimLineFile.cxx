#include "TrimLineFile.h"

#include <vtksys/FStream.hxx>
#include <vtksys/SystemTools.hxx>

#include <charconv>
#include <cmath>

namespace nurbs
{
namespace
{
std::vector<std::string> SplitLine(const std::string& line)
{
  std::vector<std::string> values;
  bool between = true;
  for (char c : line)
  {
    const bool blank = c == ' ' || c == '\t' || c == '\r' || c == ',' || c == ';';
    if (!blank && between)
    {
      values.emplace_back();
    }
    if (!blank)
    {
      values.back() += c;
    }
    between = blank;
  }
  return values;
}

/// The mark that spreadsheets put before UTF-8.
void SkipByteOrderMark(std::istream& stream)
{
  for (const char expected : { '\xEF', '\xBB', '\xBF' })
  {
    if (stream.peek() != std::istream::traits_type::to_int_type(expected))
    {
      return;
    }
    stream.get();
  }
}

/// Not strtod: a decimal point whatever the locale.
bool ReadNumber(const std::string& text, double& number)
{
  const size_t sign = text.size() > 1 && text[0] == '+' ? 1 : 0;
  const char* end = text.data() + text.size();
  const auto result = std::from_chars(text.data() + sign, end, number);
  return result.ec == std::errc() && result.ptr == end;
}

size_t CountNumbers(const std::vector<std::string>& values, Vec3& point)
{
  size_t count = 0;
  double number = 0.0;
  for (size_t i = 0; i < values.size(); ++i)
  {
    if (ReadNumber(values[i], number))
    {
      ++count;
      point[i < 3 ? i : 2] = number;
    }
  }
  return count;
}
}

//------------------------------------------------------------------------------
bool ReadTrimLineFile(const std::string& path, std::vector<Vec3>& points, std::string& error)
{
  points.clear();
  const std::string file = "The file of points \"" + path + "\"";
  vtksys::ifstream stream(path.c_str());
  if (!stream || vtksys::SystemTools::FileIsDirectory(path))
  {
    error = file + " cannot be read; give the path of an existing CSV, IGES or STEP file";
    return false;
  }
  SkipByteOrderMark(stream);
  std::string line;
  bool headerMayCome = true;
  for (size_t number = 1; std::getline(stream, line); ++number)
  {
    const std::vector<std::string> values = SplitLine(line);
    if (values.empty() || values[0][0] == '#')
    {
      continue;
    }
    Vec3 point = Vec3::Zero();
    const size_t count = CountNumbers(values, point);
    const bool header = headerMayCome && count == 0;
    headerMayCome = false;
    if (header)
    {
      continue;
    }
    if (values.size() != 3 || count != 3 || !point.allFinite())
    {
      error = file + ", line " + std::to_string(number) + " is \"" + line.substr(0, 60) +
        "\"; expected three finite numbers x, y, z";
      return false;
    }
    points.push_back(point);
  }
  return true;
}
}
