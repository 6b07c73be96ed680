#include "Mutation.h"

#include <algorithm>
#include <cctype>
#include <cstring>

namespace fuzz
{
namespace
{
using Change = void (*)(std::string&, bool, Random&);

/// Column of an IGES line from which on its section and number stand.
constexpr size_t SectionColumn = 72;

bool IsNumber(char c)
{
  return std::isdigit(static_cast<unsigned char>(c)) || c == '.' || c == '-' || c == '+';
}

/// A place in the text; in a file of columns mostly before those that number the lines.
size_t Place(const std::string& text, bool columns, Random& random)
{
  size_t at = random.Below(text.size());
  for (int tries = 0; columns && tries < 4; ++tries)
  {
    const size_t start = text.rfind('\n', at);
    if (at - (start == std::string::npos ? 0 : start + 1) < SectionColumn)
    {
      break;
    }
    at = random.Below(text.size());
  }
  return at;
}

/// Begin and end of a number at or after a random place; false if none was found nearby.
bool FindNumber(
  const std::string& text, bool columns, Random& random, char before, size_t& begin, size_t& end)
{
  for (int tries = 0; tries < 200; ++tries)
  {
    begin = Place(text, columns, random);
    while (begin > 0 && IsNumber(text[begin]) && IsNumber(text[begin - 1]))
    {
      --begin;
    }
    if (IsNumber(text[begin]) && (before == 0 || (begin > 0 && text[begin - 1] == before)))
    {
      end = begin;
      while (end < text.size() && (IsNumber(text[end]) || std::strchr("eEdD", text[end])))
      {
        ++end;
      }
      return true;
    }
  }
  return false;
}

/// Puts a value in place of a number; in columns the length of the line stays.
void Replace(std::string& text, bool columns, size_t begin, size_t end, std::string value)
{
  if (!columns)
  {
    text.replace(begin, end - begin, value);
    return;
  }
  // Blanks on either side may be used up as well.
  while (end < text.size() && text[end] == ' ' && end - begin < value.size())
  {
    ++end;
  }
  while (begin > 0 && text[begin - 1] == ' ' && end - begin < value.size())
  {
    --begin;
  }
  value.resize(end - begin, ' ');
  text.replace(begin, end - begin, value);
}

void ChangeBytes(std::string& text, bool columns, Random& random)
{
  const bool printable = !random.OneIn(4);
  text[Place(text, columns, random)] =
    static_cast<char>(printable ? 32 + random.Below(95) : random.Below(256));
}

void FlipBits(std::string& text, bool columns, Random& random)
{
  text[Place(text, columns, random)] ^= static_cast<char>(1 << random.Below(8));
}

/// One digit, sign, point or delimiter becomes another.
void ChangeDigits(std::string& text, bool columns, Random& random)
{
  size_t begin = 0;
  size_t end = 0;
  if (FindNumber(text, columns, random, 0, begin, end))
  {
    const char* characters = random.OneIn(5) ? "-+.,;)(E#$*'" : "0123456789";
    text[begin + random.Below(end - begin)] = characters[random.Below(std::strlen(characters))];
  }
}

/// A number becomes one that readers stumble over.
void ChangeValues(std::string& text, bool columns, Random& random)
{
  static const std::vector<const char*> values = { "0", "-1", "1", "2", "3", "0.", "-1.", "1.",
    "1.E308", "-1.E308", "1.E-308", "1.E300", "1.E20", "1.E-20", "NAN", "INF", "-0.", "2147483647",
    "-2147483648", "4294967296", "99999999999999999999", "1000000", "65536", "", "$", "*", "1E",
    "0.5", "1.E9" };
  size_t begin = 0;
  size_t end = 0;
  if (FindNumber(text, columns, random, 0, begin, end))
  {
    Replace(text, columns, begin, end, random.Pick(values));
  }
}

/// A number, of an entity if it is STEP, becomes another one of the file.
void ChangeReferences(std::string& text, bool columns, Random& random)
{
  const char before = columns ? 0 : '#';
  size_t begin = 0;
  size_t end = 0;
  if (FindNumber(text, columns, random, before, begin, end))
  {
    const std::string other = text.substr(begin, end - begin);
    if (FindNumber(text, columns, random, before, begin, end))
    {
      Replace(text, columns, begin, end, other);
    }
  }
}

/// A block is taken out, doubled, or copied over another place.
void MoveBlocks(std::string& text, bool, Random& random)
{
  const size_t from = random.Below(text.size());
  const size_t size = 1 + random.Below(random.OneIn(3) ? 2000 : 100);
  const std::string block = text.substr(from, size);
  const size_t to = random.Below(text.size());
  switch (random.Below(3))
  {
    case 0:
      text.erase(from, size);
      break;
    case 1:
      text.insert(to, block);
      break;
    default:
      text.replace(to, std::min(block.size(), text.size() - to), block);
  }
}

void AddNoise(std::string& text, bool, Random& random)
{
  const size_t from = random.Below(text.size());
  const size_t size = std::min(text.size() - from, 1 + random.Below(200));
  const bool zeros = random.OneIn(3);
  for (size_t i = 0; i < size; ++i)
  {
    text[from + i] = zeros ? '\0' : static_cast<char>(random.Below(256));
  }
}

std::vector<std::string> Lines(const std::string& text)
{
  std::vector<std::string> lines;
  for (size_t at = 0; at < text.size();)
  {
    const size_t end = std::min(text.size(), text.find('\n', at)) + 1;
    lines.push_back(text.substr(at, end - at));
    at = end;
  }
  return lines;
}

/// Two lines change places, or one is lost or doubled.
void MoveLines(std::string& text, bool, Random& random)
{
  std::vector<std::string> lines = Lines(text);
  const size_t a = random.Below(lines.size());
  const size_t b = random.Below(lines.size());
  switch (random.Below(4))
  {
    case 0:
      lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(a));
      break;
    case 1:
      lines.insert(lines.begin() + static_cast<std::ptrdiff_t>(b), std::string(lines[a]));
      break;
    default:
      std::swap(lines[a], lines[b]);
  }
  text.clear();
  for (const std::string& line : lines)
  {
    text += line;
  }
}

/// The end is lost; sometimes all but the very last line of it.
void Cut(std::string& text, bool, Random& random)
{
  const size_t length = random.Below(text.size());
  const std::vector<std::string> lines = Lines(text);
  const std::string last = lines.empty() ? std::string() : lines.back();
  text.resize(length);
  if (random.OneIn(2))
  {
    text += (random.OneIn(2) ? "\n" : "") + last;
  }
}

struct NamedChange
{
  const char* Name;
  Change Apply;
  size_t Most; ///< times in one file
};

const std::vector<NamedChange>& Changes()
{
  static const std::vector<NamedChange> changes = { { "bytes", ChangeBytes, 8 },
    { "bits", FlipBits, 8 }, { "digits", ChangeDigits, 6 }, { "values", ChangeValues, 4 },
    { "references", ChangeReferences, 4 }, { "blocks", MoveBlocks, 2 }, { "noise", AddNoise, 2 },
    { "lines", MoveLines, 3 }, { "cut", Cut, 1 } };
  return changes;
}
}

const std::vector<const char*>& MutationKinds()
{
  static const std::vector<const char*> kinds = []
  {
    std::vector<const char*> names;
    for (const NamedChange& change : Changes())
    {
      names.push_back(change.Name);
    }
    names.push_back("mixed");
    return names;
  }();
  return kinds;
}

Mutation Mutate(const std::string& text, bool columns, Random& random)
{
  const size_t kind = random.Below(MutationKinds().size());
  Mutation result{ MutationKinds()[kind], text };
  const bool mixed = kind == Changes().size();
  const size_t times = 1 + random.Below(mixed ? 4 : Changes()[kind].Most);
  for (size_t i = 0; i < times && !result.Text.empty(); ++i)
  {
    const NamedChange& change = mixed ? random.Pick(Changes()) : Changes()[kind];
    change.Apply(result.Text, columns, random);
  }
  return result;
}
}
